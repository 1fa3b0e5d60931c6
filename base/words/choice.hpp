// Choices by name and by number, with the sentences for those that are not allowed.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>

#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia {

/// Looks up `value` with `find`. Throws Error(kUsage) that lists the `allowed` values and suggests the nearest of
/// `names`.
template <class Find>
auto chosen(const std::string& value, std::string_view option,
            std::span<const std::string_view> names, const std::string& allowed, Find find) {
  const auto found = find(value);
  if (!found)
    throw Error(ExitCode::kUsage, "{} '{}' is unknown; allowed: {}{}", option, printable(value),
                allowed, did_you_mean(value, names));
  return *found;
}

/// The same where all names are allowed.
template <class Find>
auto chosen(const std::string& value, std::string_view option,
            std::span<const std::string_view> names, Find find) {
  return chosen(value, option, names, join(names), find);
}

/// "'x' is not a number; allowed: 2 to 5"; empty for a number in this range, which a NaN is not.
inline std::string number_problem(const std::string& text, double least, double most) {
  double value = 0;
  if (parse_number(text, value) && value >= least && value <= most) return "";
  const bool is_number = parse_number(text, value) || text == "nan";
  return fmt::format("'{}' is {}; allowed: {:g} to {:g}", printable(text),
                     is_number ? "out of range" : "not a number", least, most);
}

}  // namespace lobelia
