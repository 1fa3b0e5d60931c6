// The errors of every lobe in every way to compute it.
#include "studies/cost/lobe_errors.hpp"

#include <stdexcept>

#include "base/system/error.hpp"
#include "studies/cost/benchmarks.hpp"
#include "studies/cost/lobe_variants.hpp"
#include "tests/test.hpp"

namespace lobelia::cost {
namespace {

using ::testing::Contains;
using ::testing::DoubleNear;

/// The one variant of that name; a test fails where there is none.
LobeVariant variant_named(const std::vector<LobeVariant>& variants, const std::string& name) {
  for (const LobeVariant& variant : variants)
    if (variant.name() == name) return variant;
  throw std::runtime_error("no variant is called " + name);
}

LobeVariantErrors errors_of(double exponent, const std::string& name) {
  return LobeTruth(exponent).errors(variant_named(lobe_variants(exponent), name));
}

TEST(LobeVariants, CoverEveryLobeInEveryPrecision) {
  for (const double exponent : {1.0, 16.0, 64.5, 1e6}) {
    std::set<std::string> names;
    std::map<std::string_view, std::set<std::pair<bool, bool>>> kinds;
    for (const LobeVariant& variant : lobe_variants(exponent)) {
      EXPECT_TRUE(names.insert(variant.name()).second) << variant.name();
      EXPECT_EQ(bool(variant.over64), variant.wide) << variant.name();
      EXPECT_EQ(bool(variant.over32), !variant.wide) << variant.name();
      const OperationCount& c = variant.operations;
      EXPECT_GT(c.multiply + c.add + c.divide + c.transcendental, 0) << variant.name();
      kinds[info(variant.lobe).name].insert({variant.wide, variant.simd});
    }
    for (const LobeId& lobe : all_lobes())
      EXPECT_EQ(kinds[info(lobe).name].size(), 4u) << info(lobe).name << " " << exponent;
  }
}

TEST(LobeVariants, StayWithinTheirAllowedRounding) {
  for (const double exponent : {16.0, 1e6}) {
    const LobeTruth truth(exponent);
    for (const LobeVariant& variant : lobe_variants(exponent))
      EXPECT_NO_THROW(truth.errors(variant)) << variant.name();
  }
}

TEST(LobeErrors, AreThePapersAndTheIntegralsForCs16) {
  for (const char* name : {"cs16, stable, float64", "cs16, stable, float64 SIMD",
                           "cs16, stable, float32 SIMD", "cs16, textbook, float32"}) {
    const LobeVariantErrors e = errors_of(1024, name);
    EXPECT_THAT(e.all.max, DoubleNear(1.70e-2, 5e-5)) << name;  // the claim cs16-largest-error
    // (k/n)/(k + 1) against 1/(n + 1)
    EXPECT_THAT(e.all.energy, DoubleNear(1 - 16.0 / 1024 / 17 * 1025, 1e-5)) << name;
    EXPECT_LT(e.rounding.max, e.shape.max) << name;
  }
}

TEST(LobeErrors, FallWithTheExponentForTheSphericalGaussian) {
  // exp(-x) - (1 - x/n)^n = exp(-x) x^2 / (2 n) + O(1/n^2), largest at x = 2: 2 exp(-2) / n.
  for (const double n : {65536.0, 1e6}) {
    const LobeErrors e = errors_of(n, "spherical_gaussian, stable, float64").all;
    EXPECT_THAT(e.max * n, DoubleNear(2 * std::exp(-2), 1e-4));
    // The mean square over x = 0..16 of that, by the integral of x^4 exp(-2x): 24/32; and 1/n for 1/(n + 1).
    EXPECT_THAT(e.rms * n, DoubleNear(std::sqrt(0.75 / 4 / 16), 1e-4));
    EXPECT_THAT(e.energy * n, DoubleNear(1, 1e-3));
  }
}

TEST(LobeErrors, IncludeTheDriftOfRounding) {
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

TEST(LobeErrors, AreABugForAVariantThatComputesSomethingElse) {
  LobeVariant variant = variant_named(lobe_variants(64), "cs16, stable, float32 SIMD");
  variant.over32 = variant_named(lobe_variants(64), "cs8, stable, float32 SIMD").over32;
  EXPECT_THROW(LobeTruth(64).errors(variant), Error);
}

TEST(LobeTable, HasEveryVariantWithItsTimeErrorsAndOperations) {
  const Table table = lobe_table(64, 1);
  EXPECT_EQ(table.id, "lobe-n64");
  EXPECT_EQ(table.variants.size(), lobe_variants(64).size());
  for (const Variant& variant : table.variants) {
    EXPECT_GT(variant.seconds.median, 0) << variant.name;
    EXPECT_EQ(variant.errors.size(), table.errors.size()) << variant.name;
    for (const auto& [kind, error] : variant.errors)
      EXPECT_TRUE(std::isfinite(error)) << variant.name << ", " << kind;
    EXPECT_TRUE(variant.facts->operations) << variant.name;
    EXPECT_EQ(variant.settings.size(), 4u) << variant.name;
  }
  EXPECT_THAT(table.remarks, Contains(HasSubstr("The shape limits")));
}

TEST(LobeLevel, HasATableForEachExponent) {
  Options options;
  options.effort = Effort::kQuick;
  const std::vector<Table> tables = measure_lobes(options);
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[1].id, "lobe-n1024");
}

}  // namespace
}  // namespace lobelia::cost
