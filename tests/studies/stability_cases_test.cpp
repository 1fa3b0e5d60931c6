// The hard cases of the table, by group, and that the table's contrast is a real one.
#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/precision.hpp"
#include "studies/stability/cases.hpp"
#include "studies/stability/naive.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia::stability {
namespace {

/// Whether a bound is stated that a lobe, which is 0 to 1 of its peak, could be outside of.
bool can_be_outside(const Row& row) {
  return row.bound.of_peak < 1 || std::isfinite(row.bound.ulp);
}

/// Expects no row to be outside its bounds, and every row that passes to have one. Counts them.
std::size_t expect_within(const Rows& rows) {
  for (const Row& row : rows) {
    EXPECT_TRUE(std::isfinite(row.truth)) << row.group << ", " << row.name << ", " << row.lobe;
    EXPECT_EQ(row.outcome == kNotCompared, !can_be_outside(row))
        << row.group << ", " << row.name << ", " << row.model << ", " << row.lobe
        << ", n = " << row.exponent << ": " << row.bound.of_peak << " of the peak is stated";
    EXPECT_NE(row.outcome, kOutside)
        << row.group << ", " << row.name << ", " << row.model << ", " << row.lobe
        << ", n = " << row.exponent << ": " << row.ours.value << " for " << row.truth << ", "
        << row.ours.of_peak << " of the peak where " << row.bound.of_peak << " is stated, "
        << row.ours.wrong_pixels << " wrong pixels";
  }
  return rows.size();
}

std::vector<LobeId> some_lobes() { return some_of(lobes_under_test(), 6); }

std::size_t expect_within(Rows (*rows_of)(LobeId)) {
  std::size_t rows = 0;
  for (const LobeId& lobe : some_lobes()) rows += expect_within(rows_of(lobe));
  return rows;
}

TEST(HardCases, CoverEveryListedLobePlusTwoOthers) {
  const auto lobes = lobes_under_test();
  ASSERT_EQ(lobes.size(), all_lobes().size() + 2);
  for (const LobeId& lobe : all_lobes())
    EXPECT_NE(std::find(lobes.begin(), lobes.end(), lobe), lobes.end());
}

TEST(HardCases, CoefficientsAreRightWhereThePlainFormulaOverflows) {
  EXPECT_EQ(expect_within(coefficient_rows), some_lobes().size() * models().size() * 11);
}

TEST(HardCases, ShadeVectorsOfAnyLengthWithinTheBound) {
  EXPECT_GT(expect_within(vector_rows), some_lobes().size() * models().size() * 9 * 30);
}

TEST(HardCases, HaveRightDensitiesDownToTheirUnderflow) {
  for (const LobeId& lobe : some_lobes()) {
    int compared = 0, above_nothing = 0;
    const Rows rows = density_rows(lobe);
    EXPECT_EQ(expect_within(rows), 54u);
    for (const Row& row : rows) {
      compared += row.outcome == kWithin && row.bound.of_peak == kDensityBound;
      above_nothing += row.truth > 0;
    }
    EXPECT_EQ(compared, 54) << info(lobe).name;
    EXPECT_GE(above_nothing, 2 * 9) << info(lobe).name;
  }
}

TEST(HardCases, VectorsAreComparedUnlessUndimmedAlongTheHorizon) {
  const auto is_undimmed = [](std::string_view model) {
    const ModelInfo& about = info(*find_model(model));
    return about.angle == LobeAngle::kHalfVector && (!about.applies_cosine || about.has_shadowing);
  };
  int cases = 0, not_compared = 0;
  for (const LobeId& lobe : lobes_under_test())
    for (const Row& row : vector_rows(lobe)) {
      ++cases;
      if (row.outcome != kNotCompared) continue;
      ++not_compared;
      EXPECT_TRUE(row.name.starts_with("L = -V")) << row.name << ", " << row.model;
      EXPECT_TRUE(is_undimmed(row.model)) << row.name << ", " << row.model;
    }
  EXPECT_LT(not_compared, 0.03 * cases);
}

TEST(HardCases, HalfFloatsHoldTheirBoundWhereTheTextbookLosesTheHighlight) {
  EXPECT_EQ(expect_within(float16_rows),
            some_lobes().size() * models().size() * kHalfFloatExponents.size());
  for (const Row& row : float16_rows(*find_lobe("cosine"))) {
    EXPECT_EQ(row.outcome, kWithin) << row.model << " " << row.name;
    // From n = 256 on, the textbook is off by more than half of the peak, up to infinity; ours by 0.085 at most.
    if (row.exponent >= 256) {
      EXPECT_GT(row.naive.of_peak, 0.5) << row.model << " " << row.name;
    }
    EXPECT_LT(row.ours.of_peak, 0.1) << row.model << " " << row.name;
  }
}

TEST(HardCases, SpheresOfAnySizeAndDistanceAreRightToThePixel) {
  EXPECT_GT(expect_within(sphere_rows), some_lobes().size() * 600);
}

class RandomVectorsOf : public testing::TestWithParam<double> {};

TEST_P(RandomVectorsOf, AreShadedWithinTheBoundOfEachPrecision) {
  const Rows rows = precision_rows(lobes_under_test(), GetParam());
  EXPECT_GE(expect_within(rows), lobes_under_test().size() * models().size() * 4);
  double chosen = 0;
  // The largest part of a bound that is used: measured 0.09 to 0.7 wherever the bound says anything.
  std::map<std::string, double> used;
  for (const Row& row : rows) {
    if (row.name == "in the precision that is chosen") {
      EXPECT_LE(row.ours.of_peak, kAllowedShadingError);
      chosen = std::max(chosen, row.ours.of_peak);
    } else if (row.bound.of_peak < 0.1 && row.name.starts_with("all in")) {
      used[row.name] = std::max(used[row.name], row.ours.of_peak / row.bound.of_peak);
    }
  }
  // Below n = 0.35 cos^n rises so steeply from a right angle that not even float64 can promise it.
  EXPECT_GT(chosen, 0) << "no model at all was shaded within the bound";
  EXPECT_GE(used.size(), 2u);
  for (const auto& [name, part] : used) EXPECT_GT(part, 0.05) << name;
}

INSTANTIATE_TEST_SUITE_P(Exponents, RandomVectorsOf, testing::ValuesIn(kExponents));

TEST(TheNaiveFormula, MissesDistantSpheres) {
  int wrong = 0, infinite = 0;
  for (const Row& row : sphere_rows(*find_lobe("cosine")))
    if (row.name == "1e7 radii away") wrong = std::max(wrong, row.naive.wrong_pixels);
  EXPECT_GT(wrong, 500);
  for (const Row& row : coefficient_rows(*find_lobe("cosine")))
    infinite += std::isinf(row.naive.of_peak);
  EXPECT_GE(infinite, 1);
}

}  // namespace
}  // namespace lobelia::stability
