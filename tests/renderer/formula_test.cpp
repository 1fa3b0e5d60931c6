#include "renderer/formula.hpp"

#include <fmt/format.h>

#include "tests/renderer/infix.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// A random formula as people write them: with needless parentheses, signs and blanks.
class RandomFormula {
 public:
  explicit RandomFormula(std::uint64_t seed) : random_(seed) {}
  std::string text(int depth = 5) {
    if (depth == 0 || below(6) == 0) return leaf();
    switch (below(8)) {
      case 0:
        return "(" + blank() + text(depth - 1) + blank() + ")";
      case 1:
        return (below(4) == 0 ? "+" : "-") + text(depth - 1);
      case 2: {
        constexpr const char* kFunctions[] = {"exp", "log", "sqrt", "abs",  "sin",
                                              "cos", "tan", "asin", "acos", "atan"};
        return kFunctions[below(10)] + blank() + "(" + text(depth - 1) + ")";
      }
      case 3: {
        constexpr const char* kPairs[] = {"min", "max", "pow"};
        return fmt::format("{}({},{}{})", kPairs[below(3)], text(depth - 1), blank(),
                           text(depth - 1));
      }
      default:
        return text(depth - 1) + blank() + "+-*/^"[below(5)] + blank() + text(depth - 1);
    }
  }

 private:
  int below(int count) { return int(random_() % std::uint64_t(count)); }
  std::string blank() { return std::string(std::size_t(below(2)), ' '); }
  std::string leaf() {
    constexpr const char* kLeaves[] = {"s",  "n",   "c",   "x",  "pi",   "0",     "2",
                                       "16", "0.5", ".25", "3.", "1e-3", "2.5E+2"};
    return kLeaves[below(13)];
  }
  std::mt19937_64 random_;
};

/// Some are longer than is allowed.
std::vector<std::string> random_formulas(std::size_t count) {
  std::vector<std::string> texts;
  for (std::uint64_t seed = 1; texts.size() < count; ++seed) {
    std::string text = RandomFormula(seed).text();
    try {
      const Formula formula(text);
      if (formula.nodes().size() > 1) texts.push_back(std::move(text));
    } catch (const FormulaError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr("more than 200 numbers")) << text;
    }
  }
  return texts;
}

constexpr double kPlaces[] = {0, 1e-9, 0.01, 0.3, 0.7, 0.999};

Infix::Names names_at(double s, double n) {
  return {{"s", s},
          {"n", n},
          {"c", 1 - s},
          {"x", 2 * std::asin(std::sqrt(s / 2))},
          {"pi", std::acos(-1.0)}};
}

bool same(double a, double b, double tolerance = 0) {
  return a == b || (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= tolerance * std::abs(a);
}

TEST(Formula, HasTheValueOfASecondEvaluator) {
  int finite = 0;
  for (const std::string& text : random_formulas(3000)) {
    const Formula formula(text);
    for (const double s : kPlaces) {
      const double value = formula.evaluate(s, 3.0);
      EXPECT_TRUE(same(value, Infix::value(text, names_at(s, 3)))) << text << " at " << s;
      finite += std::isfinite(value);
    }
  }
  EXPECT_GT(finite, 3000);
}

TEST(Formula, IsReadBackAsItIsWritten) {
  for (const std::string& text : random_formulas(3000)) {
    const Formula formula(text), back(formula.text());
    EXPECT_TRUE(std::ranges::equal(formula.nodes(), back.nodes()))
        << text << " -> " << formula.text();
    EXPECT_EQ(back.text(), formula.text());
  }
  EXPECT_EQ(Formula("((1-s))^(n)").text(), "(1 - s)^n");
  EXPECT_EQ(Formula("pow(max(0,1-n*s/16),16)").text(), "max(0, 1 - n * s / 16)^16");
  EXPECT_EQ(Formula("1-(2-3)-(4*(5/s))").text(), "1 - (2 - 3) - 4 * (5 / s)");
  EXPECT_EQ(Formula("-2^-2^2").text(), "-2^-2^2");
  EXPECT_EQ(Formula("(-2)^2*--c").text(), "(-2)^2 * --c");
}

TEST(Formula, IsReadBackAtTheLargestSize) {
  std::string deep, wide = "1.2345678901234567e-29", signs;
  for (int i = 0; i < kMaxFormulaDepth - 2; ++i) signs += "-";
  for (int i = 0; i < 19; ++i) deep += "sin(";
  deep += "s" + std::string(19, ')');
  for (int i = 1; i < 100; ++i) wide += "-1.2345678901234567e-29";
  for (const std::string& text : {deep, wide, signs + "s"}) {
    const Formula formula(text);
    EXPECT_TRUE(std::ranges::equal(formula.nodes(), Formula(formula.text()).nodes())) << text;
  }
}

std::string complaint_of(const std::string& text) {
  try {
    const Formula formula(text);
    return "it was read";
  } catch (const FormulaError& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.what();
  }
}

TEST(Formula, LocatesAMistakeInOneLine) {
  const std::string names =
      "; allowed: s, n, c, x, pi and the functions exp, log, sqrt, abs, sin, cos, tan, asin, acos, atan, pow, min, max";
  const std::pair<std::string, std::string> cases[] = {
      {"", "column 1: the formula ends where a value is expected"},
      {"1 +", "column 4: the formula ends where a value is expected"},
      {"1 + * 2", "column 5: '*' where a value is expected"},
      {"(1 - s", "column 7: the formula ends before a ')'"},
      {"1 s", "column 3: expected an operator or the end"},
      {"exp(1 2)", "column 7: expected an operator or ')'"},
      {"exp s", "column 5: expected '(' after exp"},
      {"exp(s, 2)", "column 6: exp takes one value"},
      {"max(s)", "column 1: max takes two values"},
      {"1 - pow(s, 2, 3)", "column 13: pow takes two values"},
      {"1 - m", "column 5: unknown name 'm'" + names},
      {"expp(s)", "column 1: unknown name 'expp'" + names + "; did you mean 'exp'?"},
      {"nan", "column 1: unknown name 'nan'" + names + "; did you mean 'tan'?"},
      {"1 - inf*s", "column 5: unknown name 'inf'" + names},
      {"1e999", "column 1: number '1e999'; allowed: 0, or 1e-30 to 1e+30"},
      {"1 - 1e-31", "column 5: number '1e-31'; allowed: 0, or 1e-30 to 1e+30"},
      {".", "column 1: number '.'; allowed: 0, or 1e-30 to 1e+30"},
      {"\"s\"", "column 1: '\"' where a value is expected"},
      {std::string("1\0+s", 4), "column 2: expected an operator or the end"},
      {"1 \xc3\x97 s", "column 3: expected an operator or the end"},
  };
  for (const auto& [text, message] : cases)
    EXPECT_EQ(complaint_of(text), "formula, " + message) << text;
}

TEST(Formula, IsBounded) {
  EXPECT_THAT(complaint_of(std::string(100000, '(')),
              testing::HasSubstr("the formula has 100000 bytes; allowed: 4000"));
  EXPECT_EQ(complaint_of(std::string(1000, '(')),
            "formula, column 41: nested too deeply; allowed: 40 levels");
  EXPECT_EQ(complaint_of(std::string(1000, '-') + "s"),
            "formula, column 41: nested too deeply; allowed: 40 levels");
  std::string tower = "s", sum = "s", nested = "s";
  for (int i = 0; i < 100; ++i) tower += "^s", sum += "+s", nested = "abs(" + nested + ")";
  EXPECT_THAT(complaint_of(tower), testing::HasSubstr("nested too deeply"));
  EXPECT_THAT(complaint_of(nested), testing::HasSubstr("nested too deeply"));
  EXPECT_THAT(complaint_of(sum), testing::HasSubstr("more than 200 numbers, names and operations"));
}

}  // namespace
}  // namespace lobelia
