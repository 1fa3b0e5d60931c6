#include "base/system/interrupt.hpp"

#include <fmt/format.h>
#include <semaphore.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <mutex>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include "base/system/descriptor.hpp"
#include "base/system/removal.hpp"
#include "base/system/standard_streams.hpp"

namespace lobelia {
namespace {

/// The first signal that asked to stop; 0 before.
std::atomic<int> g_signal{0};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<pid_t>::is_always_lock_free,
              "a signal handler may not wait");

/// Running keepers, 0 in free places. More than any engine starts at once. A keeper without a place still ends after our
/// end.
std::array<std::atomic<pid_t>, 4096> g_keepers{};

/// timeout(1) and others signal both the process and its group: two signals within this time count as one.
constexpr std::int64_t kOneRequestNanoseconds = 300'000'000;
std::atomic<std::int64_t> g_first_time{0};
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

/// Two buffers in turn: the handler may run while one is written.
constexpr std::size_t kMaxLastWords = 1000;
struct LastWords {
  std::size_t size = 0;
  char text[kMaxLastWords];
};
LastWords g_last_words[2];
std::atomic<int> g_last_words_index{0};

std::int64_t now() {  // clock_gettime may be called in a signal handler
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

/// Time for the process to end by itself, which cleans up more than the watcher can.
constexpr std::chrono::milliseconds kGrace{250};
std::atomic<bool> g_ends_soon{false};
std::atomic<bool> g_too_late{false};
sem_t g_signalled;                          ///< posted at the first signal
thread_local int uninterrupted_scopes = 0;  ///< Uninterrupted objects of the thread

/// Never destroyed, because the watcher may run while the process exits.
struct Ending {
  std::recursive_mutex mutex;
  std::set<std::filesystem::path> temporary_paths;
};
Ending& ending() {
  static Ending* const one = new Ending;
  return *one;
}

void end_keepers() {
  for (auto& keeper : g_keepers)
    if (const pid_t pid = keeper) ::kill(pid, SIGTERM);
}

void remove_temporary_paths() {
  // A killed child may still write for a moment.
  constexpr int kAttempts = 20;
  for (const auto& path : ending().temporary_paths)
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      if (remove_temporary(path)) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

void end_after_first_signal() {
  retried([] { return ::sem_wait(&g_signalled); });
  std::this_thread::sleep_for(kGrace);
  if (!g_ends_soon) return;
  ending().mutex.lock();
  if (g_too_late) {  // time to print the results
    ending().mutex.unlock();
    std::this_thread::sleep_for(kGrace);
    ending().mutex.lock();
  }
  // Stays locked, so that no thread makes another temporary file.
  end_keepers();
  remove_temporary_paths();
  // A progress line may stand there.
  const std::string line =
      fmt::format("{}lobelia: {}\n", ::isatty(2) == 1 ? "\r\x1b[K" : "", interrupt_reason());
  write_message_if_room(line);
  ::_exit(int(interrupt_exit_code()));
}

void on_signal(int signal) {
  // Two threads may each be given a signal: the time tells which was first, so that none sees a first without a time.
  const std::int64_t time = now();
  std::int64_t first_time = 0;
  if (g_first_time.compare_exchange_strong(first_time, time)) {
    g_signal = signal;
    ::sem_post(&g_signalled);
    return;
  }
  if (time - first_time < kOneRequestNanoseconds) return;
  const LastWords& words = g_last_words[g_last_words_index];
  write_message_if_room({words.text, words.size});
  end_keepers();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void catch_interrupts() {
  ::sem_init(&g_signalled, 0, 0);
  struct sigaction action {};
  action.sa_handler = on_signal;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGALRM}) sigaction(signal, &action, nullptr);
}

void end_soon_when_interrupted() {
  g_ends_soon = true;
  try {
    std::thread(end_after_first_signal).detach();
  } catch (const std::system_error&) {  // without a thread, the process ends between its steps
  }
}

void end_by_ourselves_when_interrupted() { g_ends_soon = false; }

bool interrupted() { return g_signal != 0; }

void request_interrupt() {
  g_first_time = now();
  g_signal = SIGINT;
}

void forget_interrupt() {
  g_signal = 0;
  g_first_time = 0;
}

void end_after(double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = time_t(seconds);
  timer.it_value.tv_usec = std::max(1L, long(1e6 * (seconds - std::floor(seconds))));
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

ExitCode interrupt_exit_code() {
  return g_signal == 0         ? ExitCode::kInterrupted
         : g_signal == SIGALRM ? ExitCode::kTimedOut
                               : ExitCode(128 + g_signal);
}

std::string_view interrupt_reason() {
  return g_signal == SIGALRM ? "the time is over (--time-limit)" : "interrupted";
}

void throw_if_interrupted() {
  if (interrupted() && uninterrupted_scopes == 0)
    throw Error(ExitCode::kInterrupted, std::string(interrupt_reason()));
}

Uninterrupted::Uninterrupted() { ++uninterrupted_scopes; }

Uninterrupted::~Uninterrupted() { --uninterrupted_scopes; }

void interrupts_come_too_late() { g_too_late = true; }

bool interrupted_in_time() { return g_ends_soon && !g_too_late && interrupted(); }

void take_over_end() { ending().mutex.lock(); }

EndDelay::EndDelay() { ending().mutex.lock(); }

EndDelay::~EndDelay() { ending().mutex.unlock(); }

TemporaryPath::TemporaryPath(const std::function<std::filesystem::path()>& create) {
  const EndDelay delay;
  path_ = create();
  ending().temporary_paths.insert(path_);
}

TemporaryPath::~TemporaryPath() { forget(); }

TemporaryPath::TemporaryPath(TemporaryPath&& other) noexcept
    : path_(std::exchange(other.path_, {})) {}

void TemporaryPath::forget() {
  if (path_.empty()) return;
  const EndDelay delay;
  ending().temporary_paths.erase(path_);
  path_.clear();
}

void set_last_words(std::string_view text) {
  const int next = 1 - g_last_words_index;
  g_last_words[next].size = text.copy(g_last_words[next].text, kMaxLastWords);
  g_last_words_index = next;
}

InterruptibleProcess::InterruptibleProcess(pid_t keeper) {
  for (int i = 0; i < int(g_keepers.size()) && slot_ < 0; ++i) {
    pid_t free = 0;
    if (g_keepers[std::size_t(i)].compare_exchange_strong(free, keeper)) slot_ = i;
  }
}

InterruptibleProcess::~InterruptibleProcess() {
  if (slot_ >= 0) g_keepers[std::size_t(slot_)] = 0;
}

}  // namespace lobelia
