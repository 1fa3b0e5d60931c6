#include "studies/cost/benchmarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "core/error.hpp"
#include "studies/cost/lobe_errors.hpp"
#include "studies/cost/lobe_variants.hpp"

namespace lobelia::cost {
namespace {

using ::testing::Contains;
using ::testing::DoubleNear;
using ::testing::HasSubstr;

/// The one variant of that name; a test fails where there is none.
LobeVariant variant_named(const std::vector<LobeVariant>& variants, const std::string& name) {
  for (const LobeVariant& variant : variants)
    if (variant.name() == name) return variant;
  throw std::runtime_error("no variant is called " + name);
}

LobeVariantErrors errors_of(double exponent, const std::string& name) {
  return LobeTruth(exponent).errors(variant_named(lobe_variants(exponent), name));
}

TEST(LobeVariants, AreOfEveryLobeOfTheCatalogueInEveryPrecision) {
  const std::vector<LobeVariant> variants = lobe_variants(64);
  for (const LobeId& lobe : all_lobes()) {
    std::set<std::string> kinds;
    for (const LobeVariant& variant : variants)
      if (variant.lobe == lobe)
        kinds.insert(std::string(variant.wide ? "float64" : "float32") +
                     (variant.simd ? " SIMD" : ""));
    EXPECT_EQ(kinds.size(), 4u) << info(lobe).name;
  }
}

TEST(LobeVariants, HaveNamesOfTheirOwnAndSomethingToDo) {
  for (const double exponent : {1.0, 16.0, 64.5, 1e6}) {
    std::set<std::string> names;
    for (const LobeVariant& variant : lobe_variants(exponent)) {
      EXPECT_TRUE(names.insert(variant.name()).second) << variant.name();
      EXPECT_EQ(bool(variant.over64), variant.wide) << variant.name();
      EXPECT_EQ(bool(variant.over32), !variant.wide) << variant.name();
      const OperationCount& c = variant.operations;
      EXPECT_GT(c.multiply + c.add + c.divide + c.transcendental, 0) << variant.name();
    }
  }
}

TEST(LobeVariants, CountWhatTheyDo) {
  const std::vector<LobeVariant> variants = lobe_variants(1000);  // 0b1111101000
  EXPECT_EQ(variant_named(variants, "cosine, squaring, float32 SIMD").operations.multiply, 9 + 5);
  EXPECT_EQ(variant_named(variants, "cs16, stable, float32 SIMD").operations.multiply, 1 + 4);
  EXPECT_EQ(variant_named(variants, "cosine, std::pow, float64").operations.transcendental, 1);
  EXPECT_EQ(variant_named(variants, "gauss, textbook, float32").operations.transcendental, 2);
  EXPECT_EQ(variant_named(variants, "cosine, std::pow, float64").operations.add, 1);
  // c / (n - n c + c), and c = 1 - s
  EXPECT_EQ(variant_named(variants, "schlick, textbook, float32").operations.add, 3);
  EXPECT_EQ(variant_named(variants, "schlick, textbook, float32").operations.divide, 1);
}

TEST(LobeVariants, SquareOnlyWholeExponents) {
  for (const LobeVariant& variant : lobe_variants(64.5))
    EXPECT_FALSE(info(variant.lobe).name == "cosine" && variant.method == "squaring");
}

TEST(LobeTruth, LooksAcrossTheHighlightAndAtItsEndsAtNumbersOfEveryPrecision) {
  for (const double exponent : {1.0, 16.0, 1024.0, 1e6}) {
    const LobeTruth truth(exponent);
    EXPECT_THAT(truth.s(), Contains(0.0));
    EXPECT_THAT(truth.s(), Contains(1.0));
    EXPECT_THAT(truth.s(), Contains(1 - 0x1p-24));
    EXPECT_EQ(truth.s().size() % kLobeBlock, 0u);
    for (const double s : truth.s()) EXPECT_EQ(s, double(float(s)));
  }
}

TEST(LobeErrors, AreTheRoundingsOfOurCosine) {
  for (const double exponent : {1.0, 16.0, 64.5, 1024.0, 1e6}) {
    const LobeVariantErrors wide = errors_of(exponent, "cosine, exp(n log1p(-s)), float64");
    EXPECT_LT(wide.all.max, 1e-15) << exponent;
    EXPECT_LT(wide.all.energy, 1e-15) << exponent;
    EXPECT_GT(wide.all.max, 0) << exponent;
    EXPECT_EQ(wide.shape.max, 0) << exponent;
    const bool squares = exponent == std::floor(exponent) && exponent <= 1024;
    EXPECT_LT(errors_of(exponent, squares ? "cosine, squaring in float64, float32 SIMD"
                                          : "cosine, exp(n log1p(-s)), float32 SIMD")
                  .all.max,
              2e-7)
        << exponent;
  }
}

TEST(LobeErrors, OfCs16AreThePapersAndWhatItsIntegralSays) {
  for (const char* name : {"cs16, stable, float64", "cs16, stable, float64 SIMD",
                           "cs16, stable, float32 SIMD", "cs16, textbook, float32"}) {
    const LobeVariantErrors e = errors_of(1024, name);
    EXPECT_THAT(e.all.max, DoubleNear(1.70e-2, 5e-5)) << name;  // the claim cs16-largest-error
    // (k/n)/(k + 1) against 1/(n + 1)
    EXPECT_THAT(e.all.energy, DoubleNear(1 - 16.0 / 1024 / 17 * 1025, 1e-5)) << name;
    EXPECT_LT(e.rounding.max, e.shape.max) << name;
  }
}

TEST(LobeErrors, OfTheSphericalGaussianFallWithTheExponent) {
  // exp(-x) - (1 - x/n)^n = exp(-x) x^2 / (2 n) + O(1/n^2), largest at x = 2: 2 exp(-2) / n.
  for (const double n : {65536.0, 1e6}) {
    const LobeErrors e = errors_of(n, "spherical_gaussian, stable, float64").all;
    EXPECT_THAT(e.max * n, DoubleNear(2 * std::exp(-2), 1e-4));
    // The mean square over x = 0..16 of that, by the integral of x^4 exp(-2x): 24/32; and 1/n for 1/(n + 1).
    EXPECT_THAT(e.rms * n, DoubleNear(std::sqrt(0.75 / 4 / 16), 1e-4));
    EXPECT_THAT(e.energy * n, DoubleNear(1, 1e-3));
  }
}

TEST(LobeErrors, OfSchlickAreThatOfItsSlowTail) {
  const LobeErrors e = errors_of(1024, "schlick, stable, float64").all;
  double largest = 0;
  for (double s = 0; s < 0.02; s += 1e-6)
    largest = std::max(largest, (1 - s) / (1 - s + 1024 * s) - std::pow(1 - s, 1024));
  EXPECT_THAT(e.max, DoubleNear(largest, 1e-5));
  // With m = n - 1, the integral of (1 - s)/(1 + m s): ((1 + m) log(1 + m) / m - 1) / m.
  EXPECT_THAT(e.energy, DoubleNear((1024 * std::log(1024) / 1023 - 1) / 1023 * 1025 - 1, 1e-9));
}

TEST(LobeErrors, OfARoundedCosineGrowWithTheExponent) {
  // s below half a unit of 1 - s is lost: n 2^-25 of the peak where s is that.
  for (const double n : {1024.0, 65536.0})
    for (const char* name : {"cosine, std::pow, float32", "cosine, squaring, float32"}) {
      EXPECT_GT(errors_of(n, name).all.max, 0.9 * n * 0x1p-25) << name;
      EXPECT_LT(errors_of(n, name).all.max, 4 * n * 0x1p-25) << name;
    }
}

TEST(LobeErrors, SumWhatRoundingDriftsTo) {
  // A variant that is 1e-6 of its value too large has so much too much energy, and a rounding of as much.
  LobeVariant variant = variant_named(lobe_variants(64), "cosine, exp(n log1p(-s)), float64");
  variant.allowed = 1e-5;
  variant.over64 = [over = variant.over64](std::size_t count, const double* s, double* value) {
    over(count, s, value);
    for (std::size_t i = 0; i < count; ++i) value[i] *= 1 + 1e-6;
  };
  const LobeVariantErrors e = LobeTruth(64).errors(variant);
  EXPECT_THAT(e.all.energy, DoubleNear(1e-6, 2e-9));
  EXPECT_THAT(e.all.max, DoubleNear(1e-6, 1e-12));
}

TEST(LobeErrors, OfAVariantThatComputesSomethingElseAreABug) {
  LobeVariant variant = variant_named(lobe_variants(64), "cs16, stable, float32 SIMD");
  variant.over32 = variant_named(lobe_variants(64), "cs32, stable, float32 SIMD").over32;
  try {
    LobeTruth(64).errors(variant);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kInternal);
    EXPECT_THAT(e.what(), HasSubstr("cs16, stable, float32 SIMD is"));
  }
}

TEST(LobeTable, HasEveryVariantWithItsTimeErrorsAndOperations) {
  const Table table = lobe_table(64, 1, true);
  EXPECT_EQ(table.id, "lobe-n64");
  EXPECT_EQ(table.variants.size(), lobe_variants(64).size());
  EXPECT_TRUE(is_timed(table));
  for (const Variant& variant : table.variants) {
    EXPECT_GT(cost_of(variant).median, 0) << variant.name;
    EXPECT_EQ(variant.errors.size(), table.errors.size()) << variant.name;
    for (const auto& [kind, error] : variant.errors)
      EXPECT_TRUE(std::isfinite(error)) << variant.name << ", " << kind;
    EXPECT_TRUE(variant.facts->operations) << variant.name;
    EXPECT_EQ(variant.settings.size(), 4u) << variant.name;
  }
  EXPECT_THAT(table.remarks, Contains(HasSubstr("The shape limits")));
  EXPECT_THAT(table.remarks, Contains(HasSubstr("a bracket: the largest found")));
}

TEST(LobeTable, HasTheLargestErrorAndNotTheLargestOfItsPoints) {
  for (const Variant& variant : lobe_table(64, 1, true).variants)
    if (variant.name == "cosine, squaring, float32") {
      EXPECT_THAT(variant.errors[0].second, DoubleNear(3.24e-6, 5e-9));
      EXPECT_FALSE(variant.errors_at_most);
    }
}

TEST(LobeLevel, HasATableForEachExponentAndTheTwoAnglesInHalfFloats) {
  Options options;
  options.effort = Effort::kQuick;
  const std::vector<Table> tables = measure_lobes(options);
  ASSERT_EQ(tables.size(), 4u);
  EXPECT_EQ(tables[1].id, "lobe-n1024");
  EXPECT_EQ(tables[2].id, "lobe-float16-half");
  EXPECT_EQ(tables[3].id, "lobe-float16-mirror");
}

}  // namespace
}  // namespace lobelia::cost
