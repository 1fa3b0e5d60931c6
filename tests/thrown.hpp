// The error that an action ends with.
#pragma once

#include "base/system/error.hpp"
#include "tests/test.hpp"

namespace lobelia {

/// The error that the action throws; one with the code of success and without words if it throws none.
inline Error thrown_by(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error;
  }
  return {ExitCode::kSuccess, std::string()};
}

/// The words of the error that the action throws. The test fails unless the error has this code.
inline std::string error_words(ExitCode code, const std::function<void()>& action) {
  const Error error = thrown_by(action);
  EXPECT_EQ(error.code(), code) << error.what();
  return error.what();
}

}  // namespace lobelia
