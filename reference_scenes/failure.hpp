// The ways in which an engine fails to make a picture.
#pragma once

#include <string>
#include <string_view>

namespace lobelia {

enum class FailureClass {
  kNone,
  kCrash,          ///< ended by a signal, or it could not be started though it is there
  kTimedOut,       ///< over the time limit of a picture
  kNoProgress,     ///< no output and no file written for longer than was allowed
  kNoOutput,       ///< ended as if all were well, and there is no picture
  kWrongSize,      ///< a picture of another size than was asked for
  kNonFinite,      ///< a picture with values that are infinite or no numbers
  kBadOutput,      ///< what should be a picture cannot be read
  kEngineMissing,  ///< there is no such program
  kRefused,        ///< the engine cannot show this scene
  kExitCode,       ///< it said itself that it failed
  kOutOfMemory,    ///< it used more than was allowed, or the machine had no more
  kDiskLimit,      ///< its files came to more than was allowed
  kGivenUp,        ///< not tried: the engine had failed too often
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

/// Whether the same again may end otherwise; for want of memory only with more of it.
constexpr bool worth_retrying(FailureClass failure) {
  return failure != FailureClass::kNone && failure != FailureClass::kEngineMissing &&
         failure != FailureClass::kRefused && failure != FailureClass::kGivenUp;
}

/// Why a picture could not be made. `kind` is kNone on success.
struct Failure {
  FailureClass kind = FailureClass::kNone;
  std::string message;  ///< one line
  explicit operator bool() const { return kind != FailureClass::kNone; }
};

}  // namespace lobelia
