#include "base/words/numbers.hpp"

#include "base/words/svg_chart.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST(Numbers, AreWrittenAsPeopleReadThem) {
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(2.7056), "2.71");
  EXPECT_EQ(number_text(2.7056, 5), "2.7056");
  EXPECT_EQ(number_text(0.0016), "0.0016");
  EXPECT_EQ(number_text(1234.5), "1234");
  EXPECT_EQ(number_text(-1.44), "−1.44");
  EXPECT_EQ(number_text(4.9e-4), "4.9 × 10⁻⁴");
  EXPECT_EQ(number_text(-1e12), "−1 × 10¹²");
  EXPECT_EQ(number_text(NAN), "–");
  EXPECT_EQ(number_text(-INFINITY), "minus infinite");
}

TEST(Numbers, WriteSharesInPerCent) {
  EXPECT_EQ(percent_text(4.9e-4), "0.049 %");
  EXPECT_EQ(percent_text(4e-4), "0.04 %");
  EXPECT_EQ(percent_text(4e-4, TrailingZeros::kKeep), "0.040 %");
  EXPECT_EQ(percent_text(1.1e-5), "0.0011 %");
  EXPECT_EQ(percent_text(1e-9), "1 × 10⁻⁷ %");
  EXPECT_EQ(percent_text(0), "0 %");
  EXPECT_EQ(percent_text(1), "100 %");
}

TEST(Numbers, HaveUnitsForSecondsCountsAndAngles) {
  EXPECT_EQ(seconds_text(0.0042), "4.2 ms");
  EXPECT_EQ(seconds_text(12.34), "12.3 s");
  EXPECT_EQ(seconds_text(200), "3 min 20 s");
  EXPECT_EQ(seconds_text(7260), "2 h 1 min");
  EXPECT_EQ(count_text(65536), "65\u202f536");
  EXPECT_EQ(count_text(-1234567), "−1\u202f234\u202f567");
  EXPECT_EQ(count_text(0.5), "0.5");
  EXPECT_EQ(degrees_text(17.1), "17.1°");
}

TEST(Ticks, AreRoundNumbersInsideALinearRange) {
  const auto ticks = linear_ticks(0, 62.4, 10);
  ASSERT_EQ(ticks.size(), 7u);
  EXPECT_EQ(ticks.back().value, 60);
  EXPECT_EQ(linear_ticks(0, 0.3, 3).back().label, "0.3");
  EXPECT_TRUE(linear_ticks(1, 1, 5).empty());
  EXPECT_TRUE(linear_ticks(0, NAN, 5).empty());
}

TEST(Ticks, LabelPowersOfTenOnALogScale) {
  const auto ticks = log_ticks(1e-3, 1e-1);
  ASSERT_EQ(ticks.size(), 19u);
  EXPECT_EQ(ticks.front().label, "10⁻³");
  EXPECT_EQ(ticks.back().label, "10⁻¹");
  EXPECT_LE(log_ticks(1e-200, 1e200).size(), 500u);
  EXPECT_TRUE(log_ticks(0, 1).empty());
}

TEST(Ticks, EndAnAxisAtARoundNumber) {
  EXPECT_DOUBLE_EQ(round_up(2.7), 3);
  EXPECT_DOUBLE_EQ(round_up(163), 200);
  EXPECT_DOUBLE_EQ(round_up(0), 1);
  EXPECT_DOUBLE_EQ(round_up(NAN), 1);
}

}  // namespace
}  // namespace lobelia
