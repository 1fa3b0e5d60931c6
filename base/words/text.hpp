// Text: searching, splitting, parsing, quoting and escaping.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lobelia {

/// Letters inserted, dropped, changed, or swapped with their neighbour (Damerau's distance without edits inside a swap).
std::size_t edit_distance(std::string_view a, std::string_view b);
/// The candidate nearest to `word`, or "" if it takes more edits than a third of the length.
std::string closest(std::string_view word, std::span<const std::string_view> candidates);
/// "; did you mean 'x'?" or "", for the end of an error message.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates);
/// The position of `name` in `names`, as an Id.
template <class Id>
std::optional<Id> find_id(std::span<const std::string_view> names, std::string_view name) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return Id{std::uint8_t(i)};
  return std::nullopt;
}
/// ASCII letters in lower case.
std::string lower_case(std::string_view text);
/// "a, b, c"
std::string join(std::span<const std::string_view> items, std::string_view separator = ", ");
/// The parts between any of `separators`, without white space around them and without empty parts.
std::vector<std::string> split(std::string_view text, std::string_view separators);
/// Read exactly one finite decimal number, with nothing but white space around it.
bool parse_number(std::string_view text, double& value);
bool parse_integer(std::string_view text, long long& value);
/// Valid UTF-8 for HTML, XML text and quoted attributes: & < > " ' escaped, control characters dropped.
std::string escape_markup(std::string_view text);
/// An argument for a POSIX shell, quoted only if necessary.
std::string shell_quote(std::string_view argument);
std::string shell_join(std::span<const std::string> arguments);
/// A field of a CSV table (RFC 4180), quoted only if necessary. A text that spreadsheets would run as a formula begins with
/// an apostrophe; a number stays as it is.
std::string csv_field(std::string_view text);
/// Replaces each byte that is not UTF-8 by U+FFFD: a file name may hold any bytes.
std::string valid_utf8(std::string_view text);
/// Writes each such byte as \xNN, so that different names stay different.
std::string escape_invalid_utf8(std::string_view text);
/// One line of valid UTF-8 for a message or a table: hidden characters and bytes that are not UTF-8 become \n, \xNN or
/// \uNNNN. Cut off with "..." after `max_length` bytes.
std::string printable(std::string_view text, std::size_t max_length = 80);
/// printable() for the path of a file, in full.
inline std::string printable_path(std::string_view path) { return printable(path, 1 << 14); }

/// Whether `name` can only be a file in a directory: not empty, hidden or over 255 bytes, and without slashes, control
/// characters and backslashes (which browsers take for slashes).
bool is_plain_name(std::string_view name);

}  // namespace lobelia
