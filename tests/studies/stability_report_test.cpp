// The tables and the record, on a report made by hand.
#include "studies/stability/report.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia::stability {
namespace {

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
