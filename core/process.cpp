#include "core/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/peak_memory.hpp"
#include "core/spawn.hpp"
#include "core/text.hpp"
#include "core/write_limit.hpp"

extern char** environ;

namespace lobelia {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kTailBytes = 4096;
constexpr std::size_t kMaxLineBytes = 65536;  // a program that never ends its line is cut there

/// Ours, with `changes` ("NAME=value") in place of the variables of those names.
std::vector<std::string> environment_with(const std::vector<std::string>& changes) {
  std::vector<std::string> result = changes;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    const auto name = text.substr(0, text.find('=') + 1);
    const bool changed = std::any_of(
        changes.begin(), changes.end(),
        [&](const std::string& change) { return std::string_view(change).starts_with(name); });
    if (!changed) result.emplace_back(text);
  }
  return result;
}

/// Takes output in pieces of any size and hands on lines.
class OutputSink {
 public:
  explicit OutputSink(const ProcessOptions& options) : options_(options) {
    if (!options.log.empty()) log_.open(options.log, std::ios::binary | std::ios::app);
  }
  void take(std::string_view piece) {
    if (log_.is_open()) log_.write(piece.data(), std::streamsize(piece.size()));
    tail_.append(piece);
    if (tail_.size() > kTailBytes) tail_.erase(0, tail_.size() - kTailBytes);
    if (!options_.on_line) return;
    for (const char c : piece) {
      if (c != '\n' && line_.size() < kMaxLineBytes)
        line_ += c;
      else
        flush_line();
    }
  }
  void flush_line() {
    if (options_.on_line && !line_.empty()) options_.on_line(line_);
    line_.clear();
  }
  std::string tail() const { return tail_; }

 private:
  const ProcessOptions& options_;
  std::ofstream log_;
  std::string tail_, line_;
};

/// Changes whenever a file in the directory appears, goes, grows or is written. Times are only told apart,
/// never ordered: the clock may have been set.
std::uint64_t fingerprint(const fs::path& directory) {
  std::uint64_t sum = 0;
  std::error_code error;
  for (fs::recursive_directory_iterator file(directory, error), end; !error && file != end;
       file.increment(error)) {
    std::error_code gone;  // files come and go while we look
    const std::uint64_t size = file->is_regular_file(gone) ? file->file_size(gone) : 0;
    const auto written = file->last_write_time(gone).time_since_epoch().count();
    sum += std::hash<std::string>()(
        fmt::format("{} {} {}", file->path().native(), size, std::int64_t(written)));
  }
  return sum;
}

/// When the program last did something that can be seen from outside.
class Progress {
 public:
  explicit Progress(const ProcessOptions& options) : options_(options) { look(); }
  void seen() { last_ = Clock::now(); }
  bool is_over() {
    if (options_.no_progress_limit.count() <= 0) return false;
    const auto limit = options_.no_progress_limit;
    if (Clock::now() - looked_ >= std::min<std::chrono::duration<double>>(limit / 4, kLookEvery))
      look();
    return Clock::now() - last_ > limit;
  }

 private:
  static constexpr std::chrono::seconds kLookEvery{1};
  void look() {
    looked_ = Clock::now();
    if (options_.no_progress_limit.count() <= 0 || options_.progress_directory.empty()) return;
    const std::uint64_t now = fingerprint(options_.progress_directory);
    if (now != fingerprint_) seen();
    fingerprint_ = now;
  }
  const ProcessOptions& options_;
  Clock::time_point last_ = Clock::now(), looked_;
  std::uint64_t fingerprint_ = 0;
};

/// wait4 tells the peak of the program, but at least our own, which the program began with. So it is exact above that,
/// and below it there is what could be seen while the program ran.
class PeakMemory {
 public:
  explicit PeakMemory(pid_t pid) : pid_(pid) {
    rusage ours{};
    ::getrusage(RUSAGE_SELF, &ours);
    ours_ = bytes(ours);
  }
  void look() {
    if (Clock::now() < next_ || seen_ > ours_) return;
    seen_ = std::max(seen_, peak_memory_of_family(pid_));
    next_ = Clock::now() + std::chrono::milliseconds(50);
  }
  std::uint64_t at_end(const rusage& used) const {
    return bytes(used) > ours_ ? bytes(used) : seen_;
  }

 private:
  static std::uint64_t bytes(const rusage& usage) { return std::uint64_t(usage.ru_maxrss) * 1024; }
  pid_t pid_;
  std::uint64_t ours_ = 0, seen_ = 0;
  Clock::time_point next_;
};

double seconds_of(const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); }

}  // namespace

ProcessResult run_process(const std::vector<std::string>& arguments,
                          const ProcessOptions& options) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw Error(ExitCode::kEngine, fmt::format("no pipe: {}", std::strerror(errno)));
  const auto started = Clock::now();
  OutputSink sink(options);
  Spawned spawned;
  try {
    std::optional<WriteLimit> limit;
    if (!options.writable.empty()) limit.emplace(options.writable);
    // From this thread, which waits for its end: a program that dies with us dies with the thread that started it.
    spawned =
        spawn({.arguments = arguments,
               .environment = options.only_environment ? options.environment
                                                       : environment_with(options.environment),
               .working_directory = options.working_directory,
               .input = options.input,
               .output = ends[1],
               .limit = limit ? &*limit : nullptr,
               .dies_with_us = !options.uninterruptible});
  } catch (...) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw;
  }
  const pid_t pid = spawned.pid;
  ::close(ends[1]);
  // Whatever way this function is left, also by an exception of on_line: nothing keeps running.
  struct Guard {
    pid_t pid;
    int output;
    bool reaped = false;
    ~Guard() {
      ::close(output);
      ::kill(-pid, SIGKILL);  // with whatever it left behind in its group
      if (!reaped) ::waitpid(pid, nullptr, 0);
    }
  } guard{pid, ends[0]};
  std::optional<InterruptibleGroup> interruptible;
  if (!options.uninterruptible) interruptible.emplace(pid);

  if (options.on_start) options.on_start(spawned.writes_limited);
  ProcessResult result;
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - started); };
  const auto stop = [&](bool& flag) {
    flag = true;
    ::kill(-pid, SIGKILL);
  };
  Progress progress(options);
  PeakMemory memory(pid);
  rusage used{};
  int status = 0;
  bool ended = false, open = true;
  char buffer[16384];
  // Until the program has ended; what a grandchild still holds open is not waited for.
  while (!ended || open) {
    pollfd wait{ends[0], POLLIN, 0};
    const int ready = open ? ::poll(&wait, 1, ended ? 0 : 50) : (::usleep(10000), 0);
    if (ready > 0) {
      const ssize_t n = ::read(ends[0], buffer, sizeof buffer);
      if (n > 0) {
        progress.seen();
        sink.take({buffer, std::size_t(n)});
      } else if (n == 0 || errno != EINTR) {
        open = false;
      }
    } else if (ended) {
      break;
    }
    memory.look();
    if (!ended) guard.reaped = ended = ::wait4(pid, &status, WNOHANG, &used) == pid;
    if (!ended && !result.timed_out && !result.no_progress && !result.interrupted) {
      if ((interrupted() && !options.uninterruptible) || (options.stop && *options.stop))
        stop(result.interrupted);
      else if (seconds() > options.timeout)
        stop(result.timed_out);
      else if (progress.is_over())
        stop(result.no_progress);
    }
  }
  sink.flush_line();
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.seconds = seconds().count();
  result.cpu_seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  result.peak_memory_bytes = memory.at_end(used);
  result.output_tail = sink.tail();
  return result;
}

fs::path find_program(const std::string& name) {
  const auto executable = [](const fs::path& path) {
    std::error_code ignored;  // a directory that may not be searched has no program for us
    return fs::is_regular_file(path, ignored) && ::access(path.c_str(), X_OK) == 0;
  };
  if (name.find('/') != name.npos) return executable(name) ? fs::absolute(name) : fs::path();
  const char* path = std::getenv("PATH");
  for (const auto& directory : split(path ? path : "", ":"))
    if (const fs::path candidate = fs::path(directory) / name; executable(candidate))
      return fs::absolute(candidate);
  return {};
}

}  // namespace lobelia
