// Small things about text.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lobelia {

/// The candidate within a third of its length in edits of `word`, or "" if none is near.
std::string closest(std::string_view word, std::span<const std::string_view> candidates);
/// "; did you mean 'x'?" or "", to end an error message with.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);
/// The id, a position in `names`, of the entry that is `name`.
template <class Id>
std::optional<Id> find_id(std::span<const std::string_view> names, std::string_view name) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return Id{std::uint8_t(i)};
  return std::nullopt;
}
/// Letters of ASCII in lower case.
std::string lower_case(std::string_view text);
/// "a, b, c"
std::string join(std::span<const std::string_view> items, std::string_view separator = ", ");
/// Parts between any of `separators`, trimmed of white space, empty ones dropped.
std::vector<std::string> split(std::string_view text, std::string_view separators);
/// Reads exactly one finite decimal number, nothing before or after it.
bool parse_number(std::string_view text, double& value);
bool parse_integer(std::string_view text, long long& value);
/// & < > " ' escaped; control characters dropped; valid UTF-8: safe inside HTML, XML text and quoted attributes.
std::string escape_markup(std::string_view text);
/// The argument as a POSIX shell reads it back: quoted only where it has to be.
std::string shell_quote(std::string_view argument);
std::string shell_join(std::span<const std::string> arguments);
/// A field of a CSV table (RFC 4180): in quotes where it has to be.
std::string csv_field(std::string_view text);
/// Each byte that is not part of valid UTF-8 replaced by U+FFFD: a file name may hold any bytes.
std::string valid_utf8(std::string_view text);
/// The same with each such byte as \xNN, so that two names stay two.
std::string escape_invalid_utf8(std::string_view text);
/// One line of valid UTF-8 for a message or a table: control characters, marks that turn the direction of
/// writing and bytes that are no UTF-8 as \n, \xNN or \uNNNN. Cut off with "..." beyond `max_length` bytes.
std::string printable(std::string_view text, std::size_t max_length = 80);
/// printable() for a file's name, of which nothing is cut off.
inline std::string printable_path(std::string_view path) { return printable(path, 1 << 14); }

/// Whether a name is that of a file in a directory, and nothing else: not empty, hidden or over kMaxNameBytes, without
/// slashes, backslashes (which browsers take for slashes) and control characters.
inline constexpr std::size_t kMaxNameBytes = 255;
bool is_plain_name(std::string_view name);

}  // namespace lobelia
