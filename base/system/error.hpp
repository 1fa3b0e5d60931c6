// Libraries throw Error; main prints its lines and exits with its code.
#pragma once

#include <fmt/core.h>

#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace lobelia {

/// Exit codes of the program, documented in README.md. A user's script may rely on them.
enum class ExitCode : int {
  kSuccess = 0,
  /// It ran, and the answer is no: over a threshold, non-finite pixels, cells that differ.
  kDiffers = 1,
  kUsage = 2,          ///< the command line is wrong
  kInput = 3,          ///< an input cannot be read, is invalid, or does not match the other one
  kOutput = 4,         ///< an output is missing: it cannot be written, or a job of a farm failed
  kEngine = 5,         ///< a reference engine is missing or failed
  kUndecided = 6,      ///< no difference was found, and the noise of the pictures could hide one
  kInternal = 70,      ///< a bug of ours
  kNoResources = 71,   ///< the system gives no more memory, threads, processes or open files
  kTimedOut = 124,     ///< --time-limit is over, as timeout(1) has it
  kHungUp = 129,       ///< SIGHUP: the terminal was closed
  kInterrupted = 130,  ///< Ctrl-C; also thrown for SIGHUP and SIGTERM, see interrupt_exit_code()
  kBrokenPipe = 141,   ///< nobody reads stdout any more, as in `lobelia models | head`
  kTerminated = 143    ///< SIGTERM
};

/// A failure with an exit code. Its message is complete: what is wrong, where, and what is allowed.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message)
      : Error(code, std::vector<std::string>{message}) {}
  /// With a message by fmt::format.
  template <class First, class... More>
  Error(ExitCode code, fmt::format_string<First, More...> text, First&& first, More&&... more)
      : Error(code, fmt::format(text, std::forward<First>(first), std::forward<More>(more)...)) {}
  /// Several failures at once, such as those of a scene file; at least one.
  Error(ExitCode code, std::vector<std::string> lines)
      : std::runtime_error(std::accumulate(
            lines.begin() + 1, lines.end(), lines.front(),
            [](const std::string& all, const std::string& line) { return all + "\n" + line; })),
        code_(code),
        lines_(std::move(lines)) {}
  ExitCode code() const { return code_; }
  /// Whether the system failed, so that nothing is known of the file that was asked for. See tells_of_file().
  bool is_fault() const { return is_fault_; }
  Error& set_fault(bool is_fault) {
    is_fault_ = is_fault;
    return *this;
  }
  /// Each is printed on a line of its own. A line break inside one comes from a file's name.
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  ExitCode code_;
  std::vector<std::string> lines_;
  bool is_fault_ = false;
};

}  // namespace lobelia
