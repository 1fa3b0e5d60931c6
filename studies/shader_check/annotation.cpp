#include "studies/shader_check/annotation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/words/github.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/program_text.hpp"

namespace lobelia::shader_check {
namespace {

bool is_in_words(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

/// Calls `use` with every name and number of a text, and the place of it.
template <class Use>
void for_each_word(std::string_view text, Use use) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (!is_in_words(text[at])) continue;
    const std::size_t begin = at;
    while (at < text.size() && (is_in_words(text[at]) || text[at] == '.')) ++at;
    use(text.substr(begin, at - begin), begin);
  }
}

bool names_pi(std::string_view word) {
  const std::string name = lower_case(word);
  constexpr std::string_view kMultiples[] = {"3.14", "6.28", "12.56", "25.13", "0.318", "0.159"};
  return name == "pi" || name.ends_with("_pi") || name.starts_with("pi_") ||
         std::ranges::any_of(kMultiples, [&](std::string_view m) { return name.starts_with(m); });
}

bool names_power(std::string_view word) { return word == "pow" || word == "exp" || word == "exp2"; }

/// How a line of the term is known that a mistake is about; null if it is not.
bool (*word_of_term(std::string_view mistake))(std::string_view) {
  const auto is_about = [&](std::initializer_list<std::string_view> names) {
    return std::ranges::any_of(names,
                               [&](std::string_view name) { return mistake.starts_with(name); });
  };
  if (is_about({"coefficient-missing"})) return nullptr;
  if (is_about({"coefficient", "pi-", "two-", "four-", "eight-"})) return names_pi;
  return is_about({"exponent", "lobe", "half-float", "float32-cosine"}) ? names_power : nullptr;
}

struct TextPart {
  std::size_t begin = 0, end = 0;
};

/// The body of the first definition of a function.
std::optional<TextPart> body_of(std::string_view plain, std::string_view function) {
  constexpr std::size_t kLongestHead = 4096;
  std::optional<TextPart> body;
  for_each_word(plain, [&](std::string_view word, std::size_t at) {
    if (body || word != function) return;
    std::size_t open = plain.find_first_not_of(" \t\n", at + word.size());
    if (open == plain.npos || plain[open] != '(') return;
    const std::string_view head = plain.substr(open, kLongestHead);
    const std::size_t end = head.find_first_of(";{");
    if (end == head.npos || head[end] == ';') return;
    body = TextPart{open + end, open + end};
    for (std::size_t depth = 0; body->end < plain.size(); ++body->end) {
      depth += plain[body->end] == '{';
      if (plain[body->end] == '}' && --depth == 0) break;
    }
  });
  return body;
}

std::size_t line_of_place(std::string_view text, std::size_t at) {
  return 1 + std::size_t(std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n'));
}

/// The line of the word in a part of the text, if all of it are in one.
std::size_t only_line(std::string_view plain, TextPart part, bool (*is_it)(std::string_view)) {
  std::size_t first = plain.npos, last = plain.npos;
  for_each_word(plain.substr(part.begin, part.end - part.begin),
                [&](std::string_view word, std::size_t at) {
                  if (!is_it(word)) return;
                  last = part.begin + at;
                  if (first == plain.npos) first = last;
                });
  if (first == plain.npos) return 0;
  const std::size_t line = line_of_place(plain, first);
  return line == line_of_place(plain, last) ? line : 0;
}

}  // namespace

std::size_t line_of_term(const ShaderSource& source, std::string_view function,
                         std::span<const std::string> mistakes) {
  const std::string plain = plain_text(source);
  const std::optional<TextPart> body = body_of(plain, function);
  if (!body) return 0;
  if (auto* const is_it = mistakes.empty() ? nullptr : word_of_term(mistakes.front()))
    for (const TextPart part : {*body, TextPart{0, plain.size()}})
      if (const std::size_t line = only_line(plain, part, is_it)) return line;
  std::size_t at = body->begin;
  for_each_word(std::string_view(plain).substr(body->begin, body->end - body->begin),
                [&](std::string_view word, std::size_t place) {
                  if (word == "return") at = body->begin + place;
                });
  return line_of_place(plain, at);
}

std::string annotation_text(const records::ShaderCheck& record, const ShaderSource& source) {
  if (!record.explanation) return "";
  return github_line({"error", source.name,
                      line_of_term(source, record.function, record.explanation->mistakes),
                      fmt::format("{} differs from {}", record.function, record.model),
                      record.explanation->sentence});
}

}  // namespace lobelia::shader_check
