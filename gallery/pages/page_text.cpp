#include "gallery/pages/page_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <regex>

#include "base/words/numbers.hpp"

namespace lobelia::gallery {
namespace {

// Repetitions are bounded, because std::regex takes stack for each character of a match.

/// Calls `other` with each text between two matches, and `match` with each match.
template <class Other, class Match>
void split(const std::string& text, const std::regex& pattern, const Other& other,
           const Match& match) {
  auto rest = text.begin();
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) {
    other(std::string(rest, (*at)[0].first));
    match(*at);
    rest = (*at)[0].second;
  }
  other(std::string(rest, text.end()));
}

/// With what `shown` makes of each match.
template <class Shown>
std::string replaced(const std::string& text, const std::regex& pattern, const Shown& shown) {
  std::string result;
  split(
      text, pattern, [&](const std::string& other) { result += other; },
      [&](const std::smatch& match) { result += shown(match); });
  return result;
}

/// "1.7e-2", "8e+08"
std::string with_powers_of_ten(const std::string& text) {
  static const std::regex kNumber(R"((^|[^\w.])(\d{1,20}(?:\.\d{1,20})?)[eE]\+?(-?\d{1,4})(?!\w))");
  return replaced(text, kNumber, [](const std::smatch& match) {
    const std::string mantissa = match[2], digits = match[3];
    int exponent = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    return match[1].str() + (mantissa == "1" ? "" : mantissa + " × ") + power_of_ten_text(exponent);
  });
}

/// Each character in the form that Unicode has for raised ones; empty if it lacks one.
std::string raised_text(const std::string& text) {
  static constexpr std::array<std::string_view, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                               "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string raised;
  for (const char c : text) {
    if (c >= '0' && c <= '9')
      raised += kDigits[std::size_t(c - '0')];
    else if (c == 'n')
      raised += "ⁿ";
    else if (c == '+')
      raised += "⁺";
    else if (c == '-')
      raised += "⁻";
    else
      return "";
  }
  return raised;
}

/// "cos^n", "2^(n+1)"; with brackets where Unicode lacks a raised character.
std::string with_raised(const std::string& text) {
  static const std::regex kPower(R"(([A-Za-z0-9)])\^(?:\(([^()]{1,200})\)|(-?[A-Za-z0-9]{1,40})))");
  return replaced(text, kPower, [](const std::smatch& match) {
    const std::string power = match[2].str() + match[3].str(), raised = raised_text(power);
    return match[1].str() + (raised.empty() ? "^(" + power + ")" : raised);
  });
}

struct Rule {
  std::regex pattern;
  const char* shown;
};

}  // namespace

std::string math_text(std::string_view text) {
  static const std::array<Rule, 15> kRules{{{std::regex(R"(\bsqrt\((\w{1,40})\))"), "√$1"},
                                            {std::regex(R"(\bsqrt\()"), "√("},
                                            {std::regex(R"(\bpi\b)"), "π"},
                                            {std::regex(R"(\btheta(_cr)?\b)"), "θ$1"},
                                            {std::regex(R"(\bdE00\b)"), "ΔE₀₀"},
                                            // A product of vectors.
                                            {std::regex(R"(\b([NLHVR])\.([NLHVR])\b)"), "$1·$2"},
                                            {std::regex(">="), "≥"},
                                            {std::regex("<="), "≤"},
                                            {std::regex(R"(\+-)"), "±"},
                                            {std::regex(R"((\d) x (?=\d))"), "$1 × "},
                                            {std::regex(R"((\d)\.\.(?=\d))"), "$1 to "},
                                            {std::regex(R"((\d) us\b)"), "$1 µs"},
                                            {std::regex(" - "), " − "},
                                            {std::regex(R"((^|[ /])-(?=\d))"), "$1−"},
                                            {std::regex(R"(\(-(?=\w))"), "(−"}}};
  constexpr std::size_t kLongest = 10'000;  // of a text that has formulas
  if (text.size() > kLongest) return std::string(text);
  std::string shown = with_raised(with_powers_of_ten(std::string(text)));
  for (const Rule& rule : kRules) shown = std::regex_replace(shown, rule.pattern, rule.shown);
  return shown;
}

void write_math(Html& html, std::string_view text) {
  static const std::regex kRaised(R"(\^\(([^()]{1,200})\))");
  split(
      math_text(text), kRaised, [&](const std::string& other) { html.text(other); },
      [&](const std::smatch& match) { html.element("sup", match[1].str()); });
}

void math_element(Html& html, std::string_view tag, const Attributes& attributes,
                  std::string_view text) {
  const Tag element(html, tag, attributes);
  write_math(html, text);
}
void math_element(Html& html, std::string_view tag, std::string_view text) {
  math_element(html, tag, {}, text);
}

std::string spoken_name(std::string_view name) {
  std::string spoken(name);
  std::ranges::replace(spoken, '_', ' ');
  return math_text(spoken);
}

}  // namespace lobelia::gallery
