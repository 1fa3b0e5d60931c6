#include "gallery/pages/page_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <vector>

#include "base/words/numbers.hpp"

namespace lobelia::gallery {
namespace {

enum class Place { kLine, kRaised, kLowered };

struct Piece {
  Place place;
  std::string text;
};

bool is_alnum(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_word(char c) { return is_alnum(c) || c == '_'; }

/// Each character in the form that Unicode has for raised ones; empty if it lacks one.
std::string raised_text(std::string_view text) {
  static constexpr std::array<std::string_view, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                               "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string raised;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (is_digit(text[i]))
      raised += kDigits[text[i] - '0'];
    else if (text[i] == 'n')
      raised += "ⁿ";
    else if (text[i] == '+')
      raised += "⁺";
    else if (text.substr(i).starts_with("−"))
      raised += "⁻", i += 2;
    else
      return "";
  }
  return raised;
}

constexpr std::size_t kLongestBracket = 200;
constexpr int kDeepest = 4;  // a root in a power in a root

/// Where the bracket at text[open] closes; npos if it does not, or is long.
std::size_t closing(std::string_view text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < std::min(text.size(), open + kLongestBracket); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return i;
  }
  return std::string_view::npos;
}

/// Reads formulas from left to right.
class Typesetter {
 public:
  explicit Typesetter(std::string_view text, int depth = 0) : text_(text), depth_(depth) {}

  std::vector<Piece> pieces() {
    while (at_ < text_.size())
      if (depth_ > kDeepest || (!number() && !word() && !power() && !sign()))
        add(text_.substr(at_++, 1));
    return std::move(pieces_);
  }

 private:
  void add(std::string_view text, Place place = Place::kLine) {
    if (!pieces_.empty() && pieces_.back().place == place)
      pieces_.back().text += text;
    else
      pieces_.push_back({place, std::string(text)});
  }
  void add_formula(std::string_view text) {
    for (const Piece& piece : Typesetter(text, depth_ + 1).pieces()) add(piece.text, piece.place);
  }
  char before() const { return at_ == 0 ? ' ' : text_[at_ - 1]; }
  std::string_view rest() const { return text_.substr(at_); }

  /// "6.5e+08", "0.00 ns", "286 us", "2764247337825939 s", "16..1024"; other numbers are as they are.
  bool number() {
    if (!is_digit(text_[at_]) || is_word(before()) || before() == '.') return false;
    std::size_t end = at_;
    while (end < text_.size() && is_digit(text_[end])) ++end;
    if (end + 1 < text_.size() && text_[end] == '.' && is_digit(text_[end + 1]))
      for (++end; end < text_.size() && is_digit(text_[end]);) ++end;
    std::string mantissa(text_.substr(at_, end - at_));
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      std::size_t from = end + 1;
      if (from < text_.size() && text_[from] == '+') ++from;
      int exponent = 0;
      const auto [last, error] =
          std::from_chars(text_.data() + from, text_.data() + text_.size(), exponent);
      const std::size_t to = last - text_.data();
      if (error == std::errc() && (to == text_.size() || !is_word(text_[to]))) {
        if (mantissa != "1") add(mantissa + " × ");
        add(power_of_ten_text(exponent));
        at_ = to;
        return true;
      }
    }
    at_ = end;
    for (const std::string_view unit : {" ns", " us", " ms", " s"}) {
      const std::size_t after = at_ + unit.size();
      if (!rest().starts_with(unit) || (after < text_.size() && is_word(text_[after]))) continue;
      if (mantissa.find_first_not_of("0.") == std::string::npos)
        mantissa = "0", at_ = after;
      else if (unit == " us")
        mantissa += " µs", at_ = after;
      else if (mantissa.size() > 6 && unit == " s")
        mantissa = number_text(std::strtod(mantissa.c_str(), nullptr));
      break;
    }
    add(mantissa);
    if (rest().starts_with("..") && at_ + 2 < text_.size() && is_digit(text_[at_ + 2])) {
      add(" to ");
      at_ += 2;
      number_after_range();
    }
    return true;
  }
  void number_after_range() {
    while (at_ < text_.size() && (is_digit(text_[at_]) || text_[at_] == '.')) {
      if (text_[at_] == '.' && (at_ + 1 == text_.size() || !is_digit(text_[at_ + 1]))) break;
      add(text_.substr(at_++, 1));
    }
  }

  /// Roots, Greek letters and indices.
  bool word() {
    if (!is_alnum(text_[at_]) || is_word(before())) return false;
    std::size_t end = at_;
    while (end < text_.size() && is_word(text_[end])) ++end;
    const std::string_view name = text_.substr(at_, end - at_);
    const bool is_call = end < text_.size() && text_[end] == '(';
    if (const std::size_t close = is_call ? closing(text_, end) : std::string_view::npos;
        name == "sqrt" && close != std::string_view::npos) {
      const std::string_view inner = text_.substr(end + 1, close - end - 1);
      const bool is_short = std::ranges::all_of(inner, is_alnum);
      add(is_short ? "√" : "√(");
      add_formula(inner);
      if (!is_short) add(")");
      at_ = close + 1;
      return true;
    }
    static constexpr std::array<std::array<std::string_view, 3>, 7> kNames = {
        {{"pi", "π", ""},
         {"theta", "θ", ""},
         {"theta_cr", "θ", "cr"},
         {"f_r", "f", "r"},
         {"R_V", "R", "V"},
         {"R_L", "R", "L"},
         {"dE00", "ΔE", "00"}}};
    const auto* known = std::ranges::find(kNames, name, [](const auto& n) { return n[0]; });
    if (known != kNames.end()) {
      add((*known)[1]);
      if (!(*known)[2].empty()) add((*known)[2], Place::kLowered);
    } else {
      add(name);
    }
    at_ = end;
    // N.L is a product of vectors.
    constexpr std::string_view kVectors = "NLHVR";
    if (name.size() == 1 && kVectors.find(name[0]) != kVectors.npos && at_ + 1 < text_.size() &&
        text_[at_] == '.' && kVectors.find(text_[at_ + 1]) != kVectors.npos &&
        (at_ + 2 == text_.size() || !is_alnum(text_[at_ + 2]))) {
      add("·");
      ++at_;
    }
    return true;
  }

  bool power() {
    if (text_[at_] != '^' || at_ + 1 >= text_.size() || !(is_alnum(before()) || before() == ')'))
      return false;
    std::size_t from = at_ + 1, end = from;
    if (text_[from] == '(') {
      end = closing(text_, from);
      if (end == std::string_view::npos) return false;
      ++from;
    } else {
      if (text_[end] == '-') ++end;
      while (end < text_.size() && is_alnum(text_[end])) ++end;
    }
    std::string raised;
    for (const Piece& piece : Typesetter(text_.substr(from, end - from), depth_ + 1).pieces())
      raised += piece.text;
    if (raised.starts_with('-')) raised.replace(0, 1, "−");
    if (raised.empty()) return false;
    add(raised, Place::kRaised);
    at_ = end + (text_[at_ + 1] == '(' ? 1 : 0);
    return true;
  }

  bool sign() {
    const char next = at_ + 1 < text_.size() ? text_[at_ + 1] : ' ';
    if (text_[at_] == '-' &&
        ((before() == ' ' && next == ' ' && at_ > 0) || (before() == '(' && is_alnum(next)) ||
         ((before() == ' ' || before() == '/') && is_digit(next))))
      return replace(1, "−");
    if (rest().starts_with(">=")) return replace(2, "≥");
    if (rest().starts_with("<=")) return replace(2, "≤");
    if (rest().starts_with("+-")) return replace(2, "±");
    if (rest().starts_with(" x ") && is_digit(before()) && at_ + 3 < text_.size() &&
        is_digit(text_[at_ + 3]))
      return replace(3, " × ");
    return false;
  }
  bool replace(std::size_t length, std::string_view by) {
    add(by);
    at_ += length;
    return true;
  }

  std::string_view text_;
  int depth_;
  std::size_t at_ = 0;
  std::vector<Piece> pieces_;
};

}  // namespace

std::string math_text(std::string_view text) {
  std::string shown;
  for (const Piece& piece : Typesetter(text).pieces()) {
    if (piece.place == Place::kLine)
      shown += piece.text;
    else if (piece.place == Place::kLowered)
      shown += (piece.text == "00" ? "₀₀" : "_" + piece.text);
    else if (const std::string raised = raised_text(piece.text); !raised.empty())
      shown += raised;
    else
      shown += "^(" + piece.text + ")";
  }
  return shown;
}

void write_math(Html& html, std::string_view text) {
  for (const Piece& piece : Typesetter(text).pieces()) {
    const std::string raised = piece.place == Place::kRaised ? raised_text(piece.text) : "";
    if (piece.place == Place::kLine)
      html.text(piece.text);
    else if (!raised.empty())
      html.text(raised);
    else
      html.element(piece.place == Place::kRaised ? "sup" : "sub", piece.text);
  }
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
