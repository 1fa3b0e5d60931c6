// The hard cases of the table, by group, and that the table's contrast is a real one.
#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/precision.hpp"
#include "studies/stability/cases.hpp"
#include "studies/stability/naive.hpp"
#include "studies/stability/report.hpp"
#include "tests/json.hpp"
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

// The tables and the record, on a report made by hand.

Row row(const char* name, const char* lobe, double truth, double naive, double ours) {
  const Highlight h{*find_model("modified_phong"), *find_lobe(lobe), Normalisation::kExact, 16};
  return judged("vectors", name, Subject(h), truth, judge(naive, truth, 1), judge(ours, truth, 1),
                1e-6);
}

TEST(AnAnswer, IsJudgedInUnitsOfFloat32AtTheTruth) {
  EXPECT_EQ(judge(1 + 0x1p-23, 1, 2).ulp, 1);
  EXPECT_EQ(judge(1 + 0x1p-23, 1, 2).of_peak, 0x1p-24);
  EXPECT_EQ(judge(1 - 0x1p-23, 1 - 0x1p-24, 1).ulp, 1);
  // Nothing is nothing; something where there should be nothing is not.
  EXPECT_EQ(judge(0, 1e-39, 1).ulp, 0);
  EXPECT_GT(judge(1e-30, 0, 1).ulp, 1e6);
  for (const double value : {std::nan(""), kInfinity, -kInfinity}) {
    EXPECT_EQ(judge(value, 1, 1).ulp, kInfinity);
    EXPECT_EQ(judge(value, 1, 1).of_peak, kInfinity);
  }
}

TEST(ARow, IsOutsideOverItsBoundOrWithAWrongPixel) {
  EXPECT_EQ(row("", "cosine", 1, 1, 1 + 9e-7).outcome, kWithin);
  EXPECT_EQ(row("", "cosine", 1, 1, 1 + 2e-6).outcome, kOutside);
  EXPECT_EQ(row("", "cosine", 1, 1, std::nan("")).outcome, kOutside);
  EXPECT_EQ(row("", "cosine", 0, 0, 1e-310).outcome, kOutside);
  Row wrong = row("", "cosine", 1, 1, 1);
  wrong.ours.wrong_pixels = 1;
  EXPECT_EQ(outcome(wrong), kOutside);
}

TEST(ARow, IsNoPassWhereNothingIsBounded) {
  Row unbounded = row("", "cosine", 0.5, 0.5, 0.5);
  for (const double bound : {1.0, 1.05, kInfinity}) {
    unbounded.bound.of_peak = bound;
    EXPECT_EQ(outcome(unbounded), kNotCompared) << bound;
    unbounded.ours.value = std::nan("");
    EXPECT_EQ(outcome(unbounded), kOutside) << bound;
    unbounded.ours.value = 0.5;
  }
  unbounded.bound.ulp = 4;
  EXPECT_EQ(outcome(unbounded), kWithin);
  unbounded.truth = std::nan("");
  EXPECT_EQ(outcome(unbounded), kOutside);
}

TEST(AReport, CountsUncomparedRowsAsNoPass) {
  records::VerifyStability report;
  report.rows = {row("a", "cosine", 1, 1.5, 1), row("a", "cs16", 1, 1.25, 1)};
  report.rows[1].bound.of_peak = kInfinity;
  report.rows[1].outcome = outcome(report.rows[1]);
  summarise(report);
  const std::string text = report_text(report, false);
  EXPECT_THAT(text, HasSubstr("2 cases: 1 within their bounds, 0 outside, 1 not compared\n"));
  EXPECT_THAT(text, HasSubstr("0.00  1 not compared\n"));
  const Json record = as_json(report);
  EXPECT_EQ(record["notCompared"], 1);
  EXPECT_EQ(record["byCase"][0]["notCompared"], 1);
  EXPECT_EQ(record["rows"][1]["outcome"], "not compared");
}

TEST(ErrorCurves, AreSmallForUsAndForTheTextbookOnlyIfBroad) {
  for (const records::StabilityCurve& curve : error_curves()) {
    double ours = 0, naive = 0;
    ASSERT_EQ(curve.truth.size(), curve.degrees.size());
    for (std::size_t i = 0; i < curve.truth.size(); ++i) {
      ours = std::max(ours, std::abs(curve.ours[i] - curve.truth[i]));
      naive = std::max(naive, std::abs(curve.naive[i] - curve.truth[i]));
    }
    EXPECT_LT(ours, 1e-5) << curve.exponent;
    EXPECT_EQ(naive < 1e-4, curve.exponent < 100) << curve.exponent;
    EXPECT_LT(curve.truth.back(), 1.1e-3);
  }
}

TEST(AReport, ShowsTheWorstRows) {
  records::VerifyStability report;
  report.rows = {row("flank, oblique", "cosine", 1, 1.5, 1),
                 row("flank, oblique", "cs16", 1, 1.25, 1 + 5e-7), row("angle", "cs16", 1, 1, 1)};
  report.rows[2].exponent = 1e6;
  summarise(report);
  const auto& lobes = report.by_lobe;
  const auto& cases = report.by_case;
  const auto& exponents = report.by_exponent;
  ASSERT_EQ(lobes.size(), 2u);
  EXPECT_EQ(lobes[1].lobe, "cs16");
  EXPECT_EQ(lobes[1].cases, 2u);
  EXPECT_EQ(lobes[1].naive.of_peak, 0.25);
  EXPECT_NEAR(lobes[1].of_bound, 0.5, 1e-6);
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].naive.of_peak, 0.5);
  ASSERT_EQ(exponents.size(), 3u);
  EXPECT_EQ(exponents[0].exponent, 16);
  EXPECT_EQ(exponents[0].naive.of_peak, 0.5);
  EXPECT_EQ(exponents[2].exponent, 1e6);
  EXPECT_THAT(report_text(report, false), HasSubstr("3 cases: 3 within their bounds, 0 outside,"));

  report.rows.push_back(row("angle", "cs16", 1, 1, 2));
  summarise(report);
  EXPECT_EQ(report.outside, 1u);
  EXPECT_THAT(report_text(report, false), HasSubstr("4 cases: 3 within their bounds, 1 outside,"));
  EXPECT_EQ(as_json(report)["rows"].size(), 4u);
  keep_rows_outside(report);
  const Json record = as_json(report);
  EXPECT_EQ(record["outside"], 1);
  ASSERT_EQ(record["rows"].size(), 1u);  // what is outside is recorded in any case
  EXPECT_EQ(record["rows"][0]["ours"]["value"], 2);
  EXPECT_EQ(record["rows"][0]["outcome"], "outside");
  ASSERT_EQ(record["groups"].size(), 1u);
  EXPECT_THAT(record["groups"][0]["meaning"].get<std::string>(), HasSubstr("as vectors"));
  EXPECT_THAT(record["byCase"][0]["meaning"].get<std::string>(), HasSubstr("One width"));
  EXPECT_FALSE(record["byCase"][1].contains("meaning"));
  EXPECT_EQ(record["byExponent"][2]["exponent"], 1e6);
}

}  // namespace
}  // namespace lobelia::stability
