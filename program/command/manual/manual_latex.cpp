// Formulas of the catalogues, "(n + 1) / (2 pi)", as LaTeX. Factors stand side by side, and a slash divides all that is
// left of it in a product by one factor.
#include <fmt/format.h>

#include <cctype>

#include "program/command/manual/manual_tables.hpp"

namespace lobelia::cli {
namespace {

class LatexWriter {
 public:
  explicit LatexWriter(std::string_view text) : text_(text) {}

  std::string formula() {
    const std::string result = list();
    return at_ == text_.size() ? result : "";
  }

 private:
  /// A piece of LaTeX. Fractions and powers take `inside`, which is the text without the parentheses around it.
  struct Part {
    std::string text, inside;
    Part(std::string all) : text(all), inside(std::move(all)) {}
    Part(std::string all, std::string bare) : text(std::move(all)), inside(std::move(bare)) {}
  };

  std::string list() {
    std::string result = sum();
    while (at_ < text_.size() && (text_[at_] == ',' || text_[at_] == ';')) {
      const char separator = text_[at_++];
      result += fmt::format("{} {}", separator, sum());
    }
    return result;
  }

  std::string sum() {
    std::string result = take('-') ? "-" + product() : product();
    for (;;)
      if (take('+'))
        result += " + " + product();
      else if (take('-'))
        result += " - " + product();
      else
        return result;
  }

  std::string product() {
    Part result = power();
    for (;;)
      if (take('/')) {
        const Part below = power();
        result = Part(in_power_ ? result.text + " / " + below.text
                                : fmt::format(R"(\frac{{{}}}{{{}}})", result.inside, below.inside));
      } else if (begins_factor()) {
        result = Part(result.text + " " + power().text);
      } else {
        return result.text;
      }
  }

  Part power() {
    Part base = atom();
    if (!take('^')) return base;
    const bool outer = std::exchange(in_power_, true);
    const std::string sign = take('-') ? "-" : "";
    const std::string power = sign + atom().inside;
    in_power_ = outer;
    return Part(fmt::format("{}^{{{}}}", base.text, power));
  }

  Part atom() {
    if (take('(')) {
      const std::string inside = closed();
      return {inside.find_first_of(" {") == inside.npos ? inside : parentheses(inside), inside};
    }
    std::string word;
    skip_blanks();
    const auto is_word = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) || c == '.';
    };
    while (at_ < text_.size() && is_word(text_[at_])) word += text_[at_++];
    // A sign that is no part of a formula.
    if (word.empty() && at_ < text_.size()) at_ = text_.size() + 1;
    if (at_ < text_.size() && text_[at_] == '(' && !is_digit(word)) {
      ++at_;
      return function(word, closed());
    }
    return Part(name(word));
  }

  static bool is_digit(const std::string& word) {
    return !word.empty() && std::isdigit(static_cast<unsigned char>(word.front()));
  }
  static std::string parentheses(const std::string& inside) {
    return fmt::format(R"(\left({}\right))", inside);
  }

  static std::string function(const std::string& word, const std::string& inside) {
    if (word == "sqrt") return fmt::format(R"(\sqrt{{{}}})", inside);
    if (word == "exp") return fmt::format("e^{{{}}}", inside);
    return name(word) + parentheses(inside);
  }

  static std::string name(const std::string& word) {
    for (const std::string_view known :
         {"pi", "max", "min", "exp", "sin", "cos", "arccos", "gamma"})
      if (word == known) return "\\" + word;
    if (word == "lobe") return R"(\ell)";
    if (word == "B") return R"(\mathrm{B})";
    // "q1", "M0".
    if (word.size() == 2 && !is_digit(word)) return fmt::format("{}_{}", word[0], word[1]);
    return word;
  }

  std::string closed() {
    const std::string inside = list();
    take(')');
    return inside;
  }

  bool begins_factor() {
    skip_blanks();
    return at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '(');
  }
  bool take(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  bool in_power_ = false;  ///< where fractions are written in one line
};

}  // namespace

std::string latex(std::string_view formula) { return LatexWriter(formula).formula(); }

}  // namespace lobelia::cli
