// Runs another program, without a shell.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/spawn.hpp"

namespace lobelia {

/// The limits on a program that the kernel applies.
struct ProcessLimits {
  bool writes_limited = false;  ///< to ProcessOptions::writable (base/system/write_limit.hpp)
  Containment contained = Containment::kNone;
};

struct ProcessOptions {
  std::filesystem::path working_directory;  ///< empty: ours
  std::vector<std::string> environment;     ///< "NAME=value", changes to our environment
  bool only_environment = false;            ///< `environment` is all it gets
  /// It survives interruptions and our end, and its descendants may go on: for a short step that must be completed.
  bool uninterruptible = false;
  std::filesystem::path writable;  ///< the only directory it may write; empty: no limit
  std::filesystem::path log;       ///< receives stdout and stderr; empty: dropped
  int input = -1;                  ///< stdin, which the caller closes; -1: /dev/null
  std::chrono::duration<double> timeout = std::chrono::hours(1);
  /// Longest time without progress: output, or a change of a file in `progress_directory`, checked about once a second.
  /// 0: no limit.
  std::chrono::duration<double> no_progress_limit{0};
  std::filesystem::path progress_directory;  ///< empty: only output counts
  /// Resident bytes of it and all that it started, checked up to 20 times a second; 0: no limit.
  std::uint64_t memory_limit = 0;
  /// Bytes on the disk of all files in `progress_directory`, checked about once a second, and the largest size of each
  /// file; 0: no limit.
  std::uint64_t disk_limit = 0;
  const std::atomic<bool>* stop = nullptr;             ///< interrupts it once this is true
  std::function<void(std::string_view)> on_line;       ///< called with each line of output, if set
  std::function<void(const ProcessLimits&)> on_start;  ///< called once it runs, if set
};

struct ProcessResult {
  int exit_code = 0;             ///< of the program, or 128 + signal
  bool timed_out = false;        ///< killed for `timeout`
  bool no_progress = false;      ///< killed for `no_progress_limit`
  bool out_of_memory = false;    ///< killed for `memory_limit`, or by the kernel for lack of memory
  bool over_disk_limit = false;  ///< killed for `disk_limit`
  bool interrupted = false;      ///< killed because of interrupted() or ProcessOptions::stop
  double seconds = 0;            ///< wall time
  double cpu_seconds = 0;        ///< of it and all that it started: user and system
  std::uint64_t peak_memory_bytes = 0;  ///< resident, of the largest of them
  std::uint64_t used_bytes = 0;  ///< memory or disk when it was killed for a limit; 0: unknown
  std::string output_tail;       ///< the last 4 KiB of its output
};

/// Runs `arguments` (the first is the program's path) to the end. Then, and also on a timeout, without progress, on
/// interruption and when we are killed, everything ends that it started, even in other process groups and sessions
/// (Containment in spawn.hpp says how reliably). The clock may be set meanwhile. Throws Error(kEngine) if it cannot be
/// started, or its output cannot be read.
ProcessResult run_process(const std::vector<std::string>& arguments, const ProcessOptions& options);

/// The program's path if `name` is executable (as a path, or found in $PATH), else empty. Throws Error(kInput) where the
/// system cannot tell: the next one in $PATH may be another program.
std::filesystem::path find_program(const std::string& name);

}  // namespace lobelia
