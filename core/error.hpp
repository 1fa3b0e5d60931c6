// How a failure travels: libraries throw Error, main prints one line and exits with its code.
#pragma once

#include <stdexcept>
#include <string>

namespace lobelia {

/// Exit codes of the program, documented in README.md. A user's script may rely on them.
enum class ExitCode : int {
  kSuccess = 0,
  kDiffers =
      1,  ///< it ran, and the answer is no: over a threshold, non-finite pixels, cells that differ
  kUsage = 2,         ///< the command line is wrong
  kInput = 3,         ///< an input cannot be read, is invalid, or does not fit the other one
  kOutput = 4,        ///< an output is not there: it cannot be written, or a job of a farm failed
  kEngine = 5,        ///< a reference engine is missing or failed
  kInternal = 70,     ///< a bug of ours
  kInterrupted = 130  ///< Ctrl-C
};

/// A failure with the exit code it asks for. what() is complete: what, where, what was allowed.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

}  // namespace lobelia
