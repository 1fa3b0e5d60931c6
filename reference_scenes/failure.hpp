// Classes of failures of an engine.
#pragma once

#include <string>
#include <string_view>

namespace lobelia {

enum class FailureClass {
  kNone,
  kCrash,          ///< ended by a signal, or does not start although it exists
  kTimedOut,       ///< over the time limit of a picture
  kNoProgress,     ///< neither output nor a written file for longer than allowed
  kNoOutput,       ///< exit code 0, but no picture
  kWrongSize,      ///< the picture has the wrong size
  kNonFinite,      ///< the picture has a NaN or an infinity
  kBadOutput,      ///< the picture cannot be read
  kEngineMissing,  ///< there is no such program
  kRefused,        ///< the engine cannot show this scene
  kExitCode,       ///< it reported an error
  kOutOfMemory,    ///< over the memory limit, or the machine had no more
  kDiskLimit,      ///< its files exceed the limit
  kGivenUp,        ///< not tried, because the engine had failed too often
};

/// In the order of FailureClass.
inline constexpr std::string_view kFailureNames[] = {
    "",           "crash",         "timed out",         "no progress",    "no output",
    "wrong size", "non-finite",    "unreadable output", "engine missing", "refused",
    "exit code",  "out of memory", "disk limit",        "engine given up"};
static_assert(std::size(kFailureNames) == std::size_t(FailureClass::kGivenUp) + 1);

constexpr std::string_view failure_name(FailureClass failure) {
  return kFailureNames[std::size_t(failure)];
}

/// Whether a retry may succeed; after kOutOfMemory only with more memory.
constexpr bool worth_retrying(FailureClass failure) {
  return failure != FailureClass::kNone && failure != FailureClass::kEngineMissing &&
         failure != FailureClass::kRefused && failure != FailureClass::kGivenUp;
}

/// Why a picture could not be made.
struct Failure {
  FailureClass kind = FailureClass::kNone;  ///< kNone on success
  std::string message;                      ///< one line
  explicit operator bool() const { return kind != FailureClass::kNone; }
};

}  // namespace lobelia
