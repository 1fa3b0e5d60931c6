#include "base/system/process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "base/pictures/image_io_module.hpp"
#include "base/system/descriptor.hpp"
#include "base/system/error.hpp"
#include "base/system/host.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/keeper_protocol.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/write_limit.hpp"
#include "base/words/text.hpp"

extern char** environ;

namespace lobelia {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kTailBytes = 4096;
constexpr int kLookMilliseconds = 50;         // between looks whether it must stop
constexpr std::size_t kMaxLineBytes = 65536;  // longer lines are split

/// Our environment with `changes` ("NAME=value").
std::vector<std::string> environment_with(const std::vector<std::string>& changes) {
  std::vector<std::string> result = changes;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    const auto name = text.substr(0, text.find('=') + 1);
    if (std::ranges::none_of(changes, [&](const auto& change) { return change.starts_with(name); }))
      result.emplace_back(text);
  }
  return result;
}

/// Logs output that comes in pieces, and calls on_line for each line.
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
  const std::string& tail() const { return tail_; }

 private:
  const ProcessOptions& options_;
  std::ofstream log_;
  std::string tail_, line_;
};

struct DirectoryLook {
  /// Changes when a file in the directory is created, removed or written. Times are compared for equality only, because
  /// the clock may be set.
  std::uint64_t fingerprint = 0;
  std::uint64_t bytes = 0;  ///< on the disk
};

DirectoryLook look_at(const fs::path& directory) {
  DirectoryLook look;
  std::error_code error;
  for (fs::recursive_directory_iterator file(directory, error), end; !error && file != end;
       file.increment(error)) {
    std::error_code gone;  // files may vanish meanwhile
    const std::uint64_t size = file->is_regular_file(gone) ? file->file_size(gone) : 0;
    const auto written = file->last_write_time(gone).time_since_epoch().count();
    look.fingerprint += std::hash<std::string>()(
        fmt::format("{} {} {}", file->path().native(), size, std::int64_t(written)));
    constexpr std::uint64_t kBlock = 512;  // the unit of st_blocks on every file system
    if (struct stat status{}; ::lstat(file->path().c_str(), &status) == 0)
      look.bytes += std::uint64_t(status.st_blocks) * kBlock;
  }
  return look;
}

/// When the program last made visible progress, and how much disk it uses.
class Progress {
 public:
  explicit Progress(const ProcessOptions& options) : options_(options) { look(); }
  void seen() { last_ = Clock::now(); }
  /// Whether there was none for too long. Looks about once a second.
  bool is_stalled() {
    const auto limit = options_.no_progress_limit;
    const bool limited = limit.count() > 0;
    const std::chrono::duration<double> every =
        limited && limit < 4 * kLookEvery ? limit / 4 : kLookEvery;
    if (Clock::now() - looked_ >= every) look();
    return limited && Clock::now() - last_ > limit;
  }
  std::uint64_t bytes() const { return bytes_; }

 private:
  static constexpr std::chrono::duration<double> kLookEvery{1};
  void look() {
    looked_ = Clock::now();
    if (options_.no_progress_limit.count() <= 0 && options_.disk_limit == 0) return;
    if (options_.progress_directory.empty()) return;
    const DirectoryLook now = look_at(options_.progress_directory);
    if (now.fingerprint != fingerprint_) seen();
    fingerprint_ = now.fingerprint;
    bytes_ = now.bytes;
  }
  const ProcessOptions& options_;
  Clock::time_point last_ = Clock::now(), looked_;
  std::uint64_t fingerprint_ = 0, bytes_ = 0;
};

/// Resident memory of a keeper's processes, read more often near the limit.
class Memory {
 public:
  Memory(std::uint64_t limit, pid_t keeper) : limit_(limit), keeper_(keeper) {}
  /// The bytes in use if they are over the limit, else 0.
  std::uint64_t used_too_much() {
    if (limit_ == 0 || Clock::now() < next_) return 0;
    std::uint64_t used = memory_of_tree(keeper_);
    // Counting shared pages once is slow, so only where it decides.
    if (used > limit_)
      if (const std::uint64_t exactly = memory_of_tree(keeper_, true)) used = exactly;
    if (used > limit_) return used;
    const double seconds = double(limit_ - used) / kMostBytesPerSecond;
    next_ = Clock::now() + std::chrono::milliseconds(int(1000 * std::min(seconds, 1.0)));
    return 0;
  }

 private:
  static constexpr double kMostBytesPerSecond = 8e9;  // fastest growth of a program
  const std::uint64_t limit_;
  const pid_t keeper_;
  Clock::time_point next_;
};

[[noreturn]] void cannot_start(const std::string& program, int error) {
  throw failure_of(program + ": cannot be started", error, ExitCode::kEngine);
}

/// A running program, with its keeper unless it is uninterruptible. The destructor ends everything that it started.
class Running {
 public:
  Running(const std::vector<std::string>& arguments, const ProcessOptions& options, int output)
      : uninterruptible_(options.uninterruptible) {
    SpawnRequest request{.arguments = arguments,
                         .environment = options.only_environment
                                            ? options.environment
                                            : environment_with(options.environment),
                         .working_directory = options.working_directory,
                         .input = options.input,
                         .output = output,
                         .largest_file = options.disk_limit};
    std::optional<WriteLimit> limit;
    if (!options.writable.empty()) request.limit = &limit.emplace(options.writable);
    if (uninterruptible_)
      start(std::move(request));
    else
      start_kept(std::move(request));
  }
  ~Running() {
    interruptible_.reset();
    line_.reset();
    // A keeper ends by itself once its line is closed.
    if (uninterruptible_) ::kill(-pid_, SIGKILL);
    if (!reaped_) wait();
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  const ProcessLimits& limits() const { return limits_; }
  pid_t pid() const { return pid_; }
  /// A descriptor that is readable once it has ended.
  int end() const { return line_ ? line_->get() : end_->get(); }
  void kill() {
    if (line_)
      ::shutdown(line_->get(), SHUT_WR);
    else
      ::kill(-pid_, SIGKILL);
  }
  /// Call it when it has ended: adds the exit code and what it used.
  void finish(ProcessResult& result) {
    KeeperReport report;
    const bool told = line_ && receive(report);
    rusage used{};
    const int own = wait(&used);
    if (lost_ != 0)
      throw failure_of("a program: cannot tell how it ended", lost_, ExitCode::kEngine);
    // A keeper without a report was killed itself.
    const int status = told ? report.status : own;
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.cpu_seconds = told ? 1e-6 * double(report.cpu_microseconds)
                              : seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
    if (told) result.peak_memory_bytes = std::uint64_t(report.peak_kibibytes) * 1024;
  }

 private:
  static double seconds_of(const timeval& time) {
    return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
  }
  void start(SpawnRequest request) {
    const Spawned spawned = spawn(request);
    pid_ = spawned.pid;
    limits_ = {spawned.writes_limited, spawned.contained};
    if (uninterruptible_) end_.emplace(int(::syscall(SYS_pidfd_open, pid_, 0)));
  }
  void start_kept(SpawnRequest request) {
    static const std::string keeper = companion_file(kKeeperFile).string();
    const std::string program = request.arguments.front();
    request.arguments.insert(request.arguments.begin(), keeper);
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
      cannot_start(program, errno);
    line_.emplace(ends[0]);
    Descriptor theirs(ends[1]);
    request.keeper_line = theirs.get();
    start(std::move(request));
    theirs.close();  // otherwise receive() would wait for a keeper that is gone
    // The end of a keeper that is killed before its first report is found later, like any other end.
    KeeperReport report;
    const bool told = receive(report);
    if (const int error = told ? report.start_error : lost_) {
      line_.reset();  // ends a keeper that still has something to do
      wait();
      cannot_start(program, error);
    }
    interruptible_.emplace(pid_);
  }
  /// False if the keeper is gone, and where the system failed.
  bool receive(KeeperReport& report) {
    const ssize_t n = retried([&] { return ::recv(line_->get(), &report, sizeof report, 0); });
    lost_ = n < 0 ? errno : 0;
    return n == sizeof report;
  }
  int wait(rusage* used = nullptr) {
    int status = 0;
    retried([&] { return ::wait4(pid_, &status, 0, used); });
    reaped_ = true;
    return status;
  }

  const bool uninterruptible_;
  pid_t pid_ = 0;
  bool reaped_ = false;
  ProcessLimits limits_;
  std::optional<Descriptor> line_;  ///< with a keeper
  int lost_ = 0;                    ///< errno, where its report could not be received
  std::optional<Descriptor> end_;   ///< without one: a pidfd
  std::optional<InterruptibleProcess> interruptible_;
};

}  // namespace

ProcessResult run_process(const std::vector<std::string>& arguments,
                          const ProcessOptions& options) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw failure_of("no pipe", errno, ExitCode::kEngine);
  const Descriptor output(ends[0]);
  Descriptor theirs(ends[1]);
  const auto started = Clock::now();
  OutputSink sink(options);
  // Started by this thread, which waits for the end: a keeper dies with the thread that started it.
  Running running(arguments, options, theirs.get());
  theirs.close();
  if (options.on_start) options.on_start(running.limits());
  ProcessResult result;
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - started); };
  Progress progress(options);
  Memory memory(options.memory_limit, running.pid());
  const auto oom_kills = count_of_oom_kills();
  bool ended = false, stopped = false, open = true;
  const auto stop = [&](bool& why) {
    why = stopped = true;
    running.kill();
  };
  char buffer[16384];
  // Until it has ended. Without a keeper its descendants may still hold the pipe open; they are not waited for.
  while (!ended || open) {
    pollfd waits[] = {{ended ? -1 : running.end(), POLLIN, 0},
                      {open ? output.get() : -1, POLLIN, 0}};
    ::poll(waits, 2, ended ? 0 : kLookMilliseconds);
    if (waits[1].revents != 0) {
      const ssize_t n = ::read(output.get(), buffer, sizeof buffer);
      if (n > 0) {
        progress.seen();
        sink.take({buffer, std::size_t(n)});
      } else if (n == 0) {
        open = false;
      } else if (errno != EINTR) {
        // A part of the output could look like all of it.
        throw failure_of(arguments.front() + ": its output cannot be read", errno,
                         ExitCode::kEngine);
      }
    } else if (ended) {
      break;
    }
    if (waits[0].revents != 0) ended = true;
    if (ended || stopped) continue;
    if ((interrupted() && !options.uninterruptible) || (options.stop && *options.stop))
      stop(result.interrupted);
    else if (seconds() > options.timeout)
      stop(result.timed_out);
    else if (progress.is_stalled())
      stop(result.no_progress);
    else if (options.disk_limit > 0 && progress.bytes() > options.disk_limit) {
      result.used_bytes = progress.bytes();
      stop(result.over_disk_limit);
    } else if (const std::uint64_t used = memory.used_too_much()) {
      result.used_bytes = used;
      stop(result.out_of_memory);
    }
  }
  sink.flush_line();
  running.finish(result);
  if (!stopped && options.disk_limit > 0 && result.exit_code == 128 + SIGXFSZ)
    result.over_disk_limit = true;
  // The kernel does not tell whether it killed this program or another at the same time.
  if (!stopped && result.exit_code == 128 + SIGKILL && oom_kills &&
      count_of_oom_kills() > oom_kills)
    result.out_of_memory = true;
  result.seconds = seconds().count();
  result.output_tail = sink.tail();
  return result;
}

fs::path find_program(const std::string& name) {
  const auto executable = [](const fs::path& path) {
    std::error_code error;  // for example a directory that we may not search
    const bool is_file = fs::is_regular_file(path, error);
    if (error && !tells_of_file(error.value()))
      throw failure_of(path.string() + ": cannot read", error.value(), ExitCode::kInput);
    return is_file && ::access(path.c_str(), X_OK) == 0;
  };
  if (name.find('/') != name.npos) return executable(name) ? fs::absolute(name) : fs::path();
  const char* path = std::getenv("PATH");
  for (const auto& directory : split(path ? path : "", ":"))
    if (const fs::path candidate = fs::path(directory) / name; executable(candidate))
      return fs::absolute(candidate);
  return {};
}

}  // namespace lobelia
