#include "base/words/text.hpp"

#include <fmt/format.h>
#include <utf8.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

namespace lobelia {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

struct Character {
  std::uint32_t code = 0;  ///< the byte itself where it is not UTF-8
  std::string_view bytes;
  bool is_valid = false;
};

/// Takes the first character off `text` (RFC 3629: the shortest form, no surrogates, up to U+10FFFF). Where it is not
/// UTF-8 takes one byte.
Character take_character(std::string_view& text) {
  constexpr std::size_t kLongest = 4;
  Character first{static_cast<unsigned char>(text[0]), text.substr(0, 1)};
  for (std::size_t n = 1; !first.is_valid && n <= std::min(kLongest, text.size()); ++n) {
    const std::string_view bytes = text.substr(0, n);
    if (utf8::is_valid(bytes.begin(), bytes.end()))
      first = {utf8::peek_next(bytes.begin(), bytes.end()), bytes, true};
  }
  text.remove_prefix(first.bytes.size());
  return first;
}

/// Control characters, marks that change the direction of writing, line separators, and characters that XML forbids.
bool is_hidden(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x061C ||
         (code >= 0x200B && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2060 && code <= 0x206F) || code == 0xFEFF || (code & 0xFFFE) == 0xFFFE;
}

std::string escaped(const Character& character) {
  if (character.code == '\t') return "\\t";
  if (character.code == '\n') return "\\n";
  if (character.code == '\r') return "\\r";
  const bool one_byte = character.code < 0x80 || !character.is_valid;
  return one_byte ? fmt::format("\\x{:02x}", character.code)
                  : fmt::format("\\u{:04x}", character.code);
}

/// Words of other programs, and ours for the same.
constexpr std::pair<std::string_view, std::string_view> kOtherWords[] = {
    {"phong", "phong_rdf"},
    {"phong", "modified_phong"},
    {"blinn", "blinn_phong_rdf"},
    {"blinn", "modified_blinn_phong"},
    {"blinn_phong", "blinn_phong_rdf"},
    {"blinn_phong", "modified_blinn_phong"},
    {"blinn-phong", "modified_blinn_phong"},
    {"ggx", "microfacet_smith"},
    {"cos", "cosine"},
    {"gaussian", "gauss"},
    {"camera", "sensor"},
    {"light", "emitter"},
    {"material", "bsdf"},
    {"brdf", "bsdf"},
    {"sphere", "shape"},
    {"plane", "shape"},
    {"object", "shape"},
    {"color", "rgb"},
    {"colour", "rgb"},
    {"spectrum", "rgb"},
    {"int", "integer"},
    {"double", "float"},
    {"shininess", "exponent"},
    {"glossiness", "exponent"},
    {"spp", "samples"},
};

template <class Number>
bool parse_whole(std::string_view text, Number& value) {
  text = trim(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, above(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = std::exchange(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

std::string closest(std::string_view word, std::span<const std::string_view> candidates) {
  if (word.size() > 64) return "";  // bounds the work on hostile input
  std::string_view best;
  std::size_t best_distance = 0;
  for (const auto candidate : candidates) {
    const std::size_t distance = edit_distance(lower_case(word), lower_case(candidate));
    if (best.empty() || distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  const std::size_t allowed = std::max<std::size_t>(1, std::max(word.size(), best.size()) / 3);
  return best.empty() || best_distance > allowed ? "" : std::string(best);
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates) {
  if (const std::string near = closest(word, candidates); !near.empty())
    return "; did you mean '" + near + "'?";
  std::string ours;
  for (const auto& [other, name] : kOtherWords)
    if (other == word && std::ranges::count(candidates, name) > 0)
      ours += (ours.empty() ? "'" : " or '") + std::string(name) + "'";
  return ours.empty() ? "" : "; did you mean " + ours + "?";
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return result;
}

std::string join(std::span<const std::string_view> items, std::string_view separator) {
  return fmt::format("{}", fmt::join(items, separator));
}

std::vector<std::string> split(std::string_view text, std::string_view separators) {
  std::vector<std::string> parts;
  std::size_t at = 0;
  while (at <= text.size()) {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    if (const auto part = trim(text.substr(at, end - at)); !part.empty()) parts.emplace_back(part);
    at = end + 1;
  }
  return parts;
}

bool parse_number(std::string_view text, double& value) {
  return parse_whole(text, value) && std::isfinite(value);
}

bool parse_integer(std::string_view text, long long& value) { return parse_whole(text, value); }

std::string escape_markup(std::string_view text) {
  constexpr std::pair<char, std::string_view> kEscapes[] = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
  std::string result;
  result.reserve(text.size());
  for (const char c : valid_utf8(text)) {
    const auto* escape = std::ranges::find(kEscapes, c, &std::pair<char, std::string_view>::first);
    if (escape != std::end(kEscapes))
      result += escape->second;
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
      result += c;
  }
  return result;
}

std::string shell_quote(std::string_view argument) {
  constexpr std::string_view kSafe =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!argument.empty() && argument.find_first_not_of(kSafe) == argument.npos)
    return std::string(argument);
  std::string result = "'";
  for (const char c : argument) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string shell_join(std::span<const std::string> arguments) {
  std::vector<std::string> quoted;
  for (const std::string& argument : arguments) quoted.push_back(shell_quote(argument));
  return fmt::format("{}", fmt::join(quoted, " "));
}

std::string csv_field(std::string_view text) {
  double number = 0;
  const bool is_formula =
      text.size() > 1 && text.find_first_of("=+-@\t\r\n") == 0 && !parse_whole(text, number);
  const std::string field = (is_formula ? "'" : "") + std::string(text);
  if (field.find_first_of(",\"\r\n") == field.npos) return field;
  std::string quoted = "\"";
  for (const char c : field) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string valid_utf8(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const Character next = take_character(text);
    result += next.is_valid ? next.bytes : "\xEF\xBF\xBD";
  }
  return result;
}

std::string escape_invalid_utf8(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const Character next = take_character(text);
    result += next.is_valid ? std::string(next.bytes) : escaped(next);
  }
  return result;
}

std::string printable(std::string_view text, std::size_t max_length) {
  std::string result;
  while (!text.empty()) {
    const Character next = take_character(text);
    const std::string shown =
        next.is_valid && !is_hidden(next.code) ? std::string(next.bytes) : escaped(next);
    if (result.size() + shown.size() > max_length) return result + "...";
    result += shown;
  }
  return result;
}

bool is_plain_name(std::string_view name) {
  constexpr std::size_t kMaxBytes = 255;
  return !name.empty() && name.size() <= kMaxBytes && name.front() != '.' &&
         std::ranges::all_of(name, [](char c) {
           const auto byte = static_cast<unsigned char>(c);
           return c != '/' && c != '\\' && byte >= 0x20 && byte != 0x7f;
         });
}

}  // namespace lobelia
