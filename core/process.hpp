// Running another program: arguments are never seen by a shell, its output goes to a log.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lobelia {

struct ProcessOptions {
  std::filesystem::path working_directory;  ///< empty: ours
  std::vector<std::string> environment;     ///< "NAME=value", in place of ours or besides
  bool only_environment = false;            ///< it gets nothing of ours besides
  /// Neither the first interruption ends it nor the second: for a short step that must not be cut in two.
  bool uninterruptible = false;
  std::filesystem::path writable;  ///< the only place where it may write; empty: wherever we may
  std::filesystem::path log;       ///< receives stdout and stderr; empty: dropped
  std::chrono::duration<double> timeout = std::chrono::hours(1);
  std::function<void(std::string_view)> on_line;  ///< called with each line of output, if set
  /// Called once it runs, if set: whether the kernel holds it to `writable` (core/write_limit.hpp).
  std::function<void(bool writes_limited)> on_start;
};

struct ProcessResult {
  int exit_code = 0;         ///< of the program, or 128 + signal
  bool timed_out = false;    ///< it was killed, with all its children
  bool interrupted = false;  ///< killed because interrupted() became true
  double seconds = 0;        ///< wall time
  std::string output_tail;   ///< the last 4 KiB of its output
};

/// Runs `arguments` (the first is the program's path) to its end. Its process group is killed on
/// time-out and on interruption. Throws Error(kEngine) if it cannot be started.
ProcessResult run_process(const std::vector<std::string>& arguments, const ProcessOptions& options);

/// The program's path if `name` is executable (as a path, or found in $PATH), else empty.
std::filesystem::path find_program(const std::string& name);

}  // namespace lobelia
