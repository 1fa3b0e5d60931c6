// A choice by name, with the sentence for a name that is unknown.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "core/text.hpp"

namespace lobelia {

/// Looks up `value` with `find`. Throws Error(kUsage) that lists the `allowed` values and suggests the nearest of
/// `names`.
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

}  // namespace lobelia
