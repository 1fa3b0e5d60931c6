// A lobe that is given by its formula alone: the same as the catalogue's, where the catalogue has it.
#include "renderer/formula_lobe.hpp"

#include <memory>
#include <regex>

#include "base/system/error.hpp"
#include "renderer/operation_count.hpp"
#include "tests/renderer/laws/cases.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// A lobe of the catalogue as a formula: what `lobelia models` prints, with a sign for each product.
LobeId as_formula(const LobeId& lobe) {
  std::string text(info(lobe).formula);
  text = std::regex_replace(text, std::regex("arccos"), "acos");
  return formula_lobe(std::regex_replace(text, std::regex("([a-z0-9)]) (?=[a-z0-9(])"), "$1 * "));
}

constexpr double kSomeExponents[] = {0.1, 1, 15.9, 16, 64, 1024, 1e5};

/// A formula has the rounding of its base, which the power multiplies. Measured: 2.3e-16 times the larger one.
double rounding(const LobeId& lobe, double n) {
  return 1e-14 + 1e-15 * std::max<double>(n, lobe.order);
}

TEST(LobeByItsFormula, HasTheValuesOfTheCatalogues) {
  for (const LobeId& lobe : lobes())
    for (const double n : kSomeExponents) {
      const LobeId formula = as_formula(lobe);
      for (int i = 0; i <= 200; ++i) {
        const double s = 2 * std::pow(i / 200.0, 4);
        EXPECT_NEAR(lobe_value(formula, s, n), lobe_value(lobe, s, n), rounding(lobe, n))
            << info(lobe).name << " n = " << n << " s = " << s;
      }
    }
}

TEST(LobeByItsFormula, HasTheCoefficientsOfTheCatalogues) {
  for (const Highlight& h : highlights(every_model(), kSomeExponents)) {
    Highlight formula = h;
    formula.lobe = as_formula(h.lobe);
    // Measured: 2e-13 + 5e-17 n.
    EXPECT_NEAR(radiance_coefficient(formula) / radiance_coefficient(h), 1,
                1e-11 + rounding(h.lobe, h.exponent))
        << text(h);
  }
}

/// Lobes with corners, on their own scales, and one that ignores n.
struct Closed {
  const char* formula;
  double (*integral)(double n);  ///< over s = 0 to 1
};
constexpr Closed kClosed[] = {
    {"max(0, 1 - n*s)", [](double n) { return 0.5 / n; }},
    {"max(0, 1 - n^2*s)", [](double n) { return 0.5 / (n * n); }},
    {"max(0, 1 - abs(n*s))^1", [](double n) { return 0.5 / n; }},
    {"max(max(0, 1 - n*s), 0.25*max(0, 2 - n*s)/2)",
     // The second one is higher from n s = 6/7 on, where both are 1/7.
     [](double n) { return (6.0 / 7 - 18.0 / 49 + 0.125 * 32.0 / 49) / n; }},
    {"exp(-sqrt(s*n))",
     [](double n) {
       const double r = std::sqrt(n);
       return 2 * (1 - (r + 1) * std::exp(-r)) / n;
     }},
    {"1", [](double) { return 1.0; }},
    {"c", [](double) { return 0.5; }},
    {"cos(x)", [](double) { return 0.5; }},
};

TEST(LobeByItsFormula, HasTheIntegralThatAClosedFormHas) {
  for (const Closed& closed : kClosed)
    for (const double n : {1.0, 3.7, 64.0, 1e4, 1e6}) {
      if (std::string_view(closed.formula).starts_with("max(max") && n < 2) continue;  // cut off
      const FormulaLobe lobe(std::make_shared<const Formula>(closed.formula), n);
      ASSERT_EQ(lobe.why_not(), "");
      const double truth = closed.integral(n);
      EXPECT_NEAR(lobe.moment(0, 1) / truth, 1, 1e-9) << closed.formula << " n = " << n;
    }
}

TEST(LobeByItsFormula, DrawsSamplesAsItsDensitySays) {
  for (const Closed& closed : kClosed)
    for (const double n : {1.0, 64.0, 1e6}) {
      const FormulaLobe lobe(std::make_shared<const Formula>(closed.formula), n);
      // The share of samples below s is the integral of the density: both are exact, so equal steps of xi will do.
      double before = -1, sum = 0;
      constexpr int kDraws = 20000;
      for (int i = 0; i < kDraws; ++i) {
        const double s = lobe.sample((i + 0.5) / kDraws);
        ASSERT_TRUE(s >= 0 && s <= 1 && s > before) << closed.formula;
        if (lobe.value(s) > 1e-6) {
          ASSERT_GT(lobe.density(s), 0) << closed.formula << " n = " << n << " s = " << s;
        }
        // The mean of value/density is the integral of the value.
        sum += lobe.value(s) / lobe.density(s) / kDraws;
        before = s;
      }
      EXPECT_NEAR(sum / lobe.moment(0, 1), 1, 2e-4) << closed.formula << " n = " << n;
    }
}

TEST(LobeByItsFormula, CountsTheOperationsOfItsTree) {
  EXPECT_EQ(operations(formula_lobe("max(0, 1 - n*s/16)^16")), (OperationCount{0, 1, 1, 1, 0, 1, 1}));
  EXPECT_EQ(operations(formula_lobe("exp(-n*x^2/2)/sqrt(c)")), (OperationCount{0, 3, 1, 2, 2, 3, 1}));
}

TEST(LobeByItsFormula, IsRefusedWhereItIsNoLobe) {
  const std::tuple<const char*, double, const char*> cases[] = {
      {"2*c", 8, "the formula 2 * c is no lobe: at s = 0 and n = 8 it is 2; it has to be 1"},
      {"sin(x)/x", 8, "at s = 0 and n = 8 it is not a finite number; it has to be 1"},
      {"1 - 2*s", 8, "it has to be 0 or more"},
      {"1 + s", 8, "it has to fall"},
      {"cos(20*x)^2", 8, "it has to fall"},
      {"(0.3 - s)^0.5/0.3^0.5", 8, "is not a finite number"},
      {"1/(1 - 2*s)", 8, "it has to be 0 or more"},
      {"max(0, 1 - 1e30*s)", 8, "it has to fall more slowly"},
      {"n*c/8", 9, "is 1.125; it has to be 1"},
  };
  for (const auto& [formula, n, why] : cases) {
    const Highlight h{*find_model("phong_rdf"), formula_lobe(formula), {}, n};
    EXPECT_THAT(why_not_a_lobe(h), testing::HasSubstr(why)) << formula;
    EXPECT_THROW(radiance_coefficient(h), Error) << formula;
  }
  EXPECT_EQ(why_not_a_lobe({*find_model("phong_rdf"), formula_lobe("n*c/8"), {}, 8}), "");
  EXPECT_EQ(why_not_a_lobe({*find_model("phong_rdf"), *find_lobe("gauss"), {}, 8}), "");
}

}  // namespace
}  // namespace lobelia
