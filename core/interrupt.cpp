#include "core/interrupt.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

#include "core/error.hpp"

namespace lobelia {
namespace {

std::atomic<bool> g_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<pid_t>::is_always_lock_free,
              "a signal handler may not wait");

/// Running groups, 0 where none; more at once than any engine starts. One that finds no place is
/// still killed by whoever waits for it, only not by a second Ctrl-C.
std::array<std::atomic<pid_t>, 4096> g_groups{};

/// timeout(1) and others send a signal to the process and to its group: that is one wish, told twice.
constexpr std::int64_t kOneWishNanoseconds = 300'000'000;
std::atomic<std::int64_t> g_first_time{0};
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

/// Two places in turn: the handler may come while one is written.
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

void on_signal(int signal) {
  if (!g_interrupted.exchange(true)) {
    g_first_time = now();
    return;
  }
  if (now() - g_first_time < kOneWishNanoseconds) return;
  // Whoever presses Ctrl-C twice means it.
  const LastWords& words = g_last_words[g_last_words_index];
  if (words.size > 0 && ::write(2, words.text, words.size) < 0) {  // nothing to be done about it
  }
  for (auto& group : g_groups)
    if (const pid_t pid = group) ::kill(-pid, SIGKILL);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

bool interrupted() { return g_interrupted; }

void throw_if_interrupted() {
  if (interrupted()) throw Error(ExitCode::kInterrupted, "interrupted");
}

void set_last_words(std::string_view text) {
  const int next = 1 - g_last_words_index;
  g_last_words[next].size = text.copy(g_last_words[next].text, kMaxLastWords);
  g_last_words_index = next;
}

InterruptibleGroup::InterruptibleGroup(pid_t group) {
  for (int i = 0; i < int(g_groups.size()) && slot_ < 0; ++i) {
    pid_t free = 0;
    if (g_groups[std::size_t(i)].compare_exchange_strong(free, group)) slot_ = i;
  }
}

InterruptibleGroup::~InterruptibleGroup() {
  if (slot_ >= 0) g_groups[std::size_t(slot_)] = 0;
}

}  // namespace lobelia
