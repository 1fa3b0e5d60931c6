// Running another program: arguments are never seen by a shell, its output goes to a log.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/spawn.hpp"

namespace lobelia {

/// The limits on a program that the kernel could set.
struct ProcessLimits {
  bool writes_limited = false;  ///< to ProcessOptions::writable (core/write_limit.hpp)
  Containment contained = Containment::kNone;
};

struct ProcessOptions {
  std::filesystem::path working_directory;  ///< empty: ours
  std::vector<std::string> environment;     ///< "NAME=value", in place of ours or besides
  bool only_environment = false;            ///< it gets nothing of ours besides
  /// Neither the first interruption ends it nor the second, nor that we are killed, and what it leaves behind may go
  /// on: for a short step that must not be cut in two.
  bool uninterruptible = false;
  std::filesystem::path writable;  ///< the only place where it may write; empty: wherever we may
  std::filesystem::path log;       ///< receives stdout and stderr; empty: dropped
  int input = -1;  ///< a file descriptor for its stdin, which stays the caller's; -1: /dev/null
  std::chrono::duration<double> timeout = std::chrono::hours(1);
  /// Longest time without a sign of progress: output, or any change of a file in `progress_directory`,
  /// looked at about once a second. 0: none.
  std::chrono::duration<double> no_progress_limit{0};
  std::filesystem::path progress_directory;  ///< empty: only output counts
  /// Bytes that it and all that it started may have resident together, looked at up to 20 times a second; 0: any number.
  std::uint64_t memory_limit = 0;
  /// Bytes that its files in `progress_directory` may take on the disk together, looked at about once a second, and the
  /// largest size of each; 0: any number.
  std::uint64_t disk_limit = 0;
  const std::atomic<bool>* stop = nullptr;        ///< killed, as interrupted, once this is true
  std::function<void(std::string_view)> on_line;  ///< called with each line of output, if set
  std::function<void(const ProcessLimits&)> on_start;  ///< called once it runs, if set
};

struct ProcessResult {
  int exit_code = 0;         ///< of the program, or 128 + signal
  bool timed_out = false;    ///< it was killed, with all its children
  bool no_progress = false;  ///< likewise
  /// It was killed for `memory_limit`, or by the kernel when the machine had no more memory.
  bool out_of_memory = false;
  bool over_disk_limit = false;  ///< it was killed for `disk_limit`
  bool interrupted = false;  ///< killed because interrupted() or ProcessOptions::stop became true
  double seconds = 0;        ///< wall time
  double cpu_seconds = 0;    ///< of it and all that it started: user and system
  std::uint64_t peak_memory_bytes = 0;  ///< resident, of the largest of them
  /// Bytes of memory or of disk it used when it was killed for a limit; 0 if not known.
  std::uint64_t used_bytes = 0;
  std::string output_tail;  ///< the last 4 KiB of its output
};

/// Runs `arguments` (the first is the program's path) to its end. With it ends all that it started, whatever process
/// groups and sessions of their own that has; so it does on time-out, for want of progress, on interruption, and when we
/// are killed ourselves (spawn.hpp says how surely). The clock may be set meanwhile. Throws Error(kEngine) if it
/// cannot be started.
ProcessResult run_process(const std::vector<std::string>& arguments, const ProcessOptions& options);

/// The program's path if `name` is executable (as a path, or found in $PATH), else empty.
std::filesystem::path find_program(const std::string& name);

}  // namespace lobelia
