#include "gallery/byte_range.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <optional>

namespace lobelia::gallery {
namespace {

using Kind = ByteRange::Kind;

std::string_view trimmed(std::string_view text) {
  const auto first = std::min(text.find_first_not_of(" \t"), text.size());
  text.remove_prefix(first);
  return text.substr(0, text.find_last_not_of(" \t") + 1);
}

/// Nothing but digits; a number that is too large becomes the largest.
std::optional<std::uint64_t> number(std::string_view digits) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || end != digits.data() + digits.size()) return std::nullopt;
  return error == std::errc::result_out_of_range ? std::numeric_limits<std::uint64_t>::max()
                                                 : value;
}

}  // namespace

ByteRange byte_range(std::string_view range, std::uint64_t file_size) {
  constexpr std::string_view kUnit = "bytes=";
  range = trimmed(range);
  if (range.size() < kUnit.size() ||
      !std::equal(kUnit.begin(), kUnit.end(), range.begin(),
                  [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); }))
    return {};
  const std::string_view one = trimmed(range.substr(kUnit.size()));
  const auto dash = one.find('-');
  if (dash == one.npos) return {};
  const std::string_view before = one.substr(0, dash), after = one.substr(dash + 1);
  if (before.empty()) {  // the last bytes
    const auto wanted = number(after);
    if (!wanted) return {};
    if (*wanted == 0) return {Kind::kUnsatisfiable};
    if (file_size == 0) return {};  // satisfiable, but no Content-Range can describe it
    const std::uint64_t size = std::min(*wanted, file_size);
    return {Kind::kPart, file_size - size, size};
  }
  const auto first = number(before);
  const auto last =
      after.empty() ? std::optional(std::numeric_limits<std::uint64_t>::max()) : number(after);
  if (!first || !last || *last < *first) return {};
  if (*first >= file_size) return {Kind::kUnsatisfiable};
  return {Kind::kPart, *first, std::min(*last, file_size - 1) - *first + 1};
}

}  // namespace lobelia::gallery
