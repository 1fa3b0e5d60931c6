// A name on the command line.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/text.hpp"

namespace lobelia::cli {

/// What `find` knows by the name `value`. Throws Error(kUsage) that says what is `allowed`, and which of
/// the `names` may have been meant.
template <class Find>
auto chosen(const std::string& value, std::string_view option,
            std::span<const std::string_view> names, const std::string& allowed, Find find) {
  const auto found = find(value);
  if (!found)
    throw Error(ExitCode::kUsage,
                fmt::format("{} '{}' is unknown; allowed: {}{}", option, printable(value), allowed,
                            did_you_mean(value, names)));
  return *found;
}

}  // namespace lobelia::cli
