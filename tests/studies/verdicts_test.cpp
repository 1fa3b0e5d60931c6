// How often pictures with noise are called different, rightly and wrongly.
#include "studies/verdicts/verdicts.hpp"

#include <boost/math/distributions/binomial.hpp>

#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia::verdicts {
namespace {

const records::VerdictsOfChange& of(const records::VerdictCell& cell, std::string_view change) {
  return *std::ranges::find(cell.changes, change, &records::VerdictsOfChange::change);
}

/// A number of alarms at a chance of `level` that is exceeded once in a thousand tests.
int most_alarms(int pairs, double level) {
  const boost::math::binomial alarms(pairs, level);
  return int(boost::math::quantile(boost::math::complement(alarms, 1e-3)));
}

TEST(Verdicts, KeepThePromisedRateOfFalseAlarms) {
  Options options;
  options.small = true;
  options.seeds = 40 * more_samples();
  options.changed = 6;
  // Where one pair in ten may be a false alarm, few pairs tell more. False alarms are hardly ever those of figures, and the
  // tests of pixels and regions are not made of draws.
  options.significance = 0.1;
  options.bootstraps = 8;
  options.noises = {Noise::kColours, Noise::kGrey, Noise::kGamma, Noise::kFireflies};
  const records::VerifyVerdicts found = measure(options, [](double) {});
  ASSERT_EQ(found.cells.size(), 8u);
  int pairs = 0, false_alarms = 0;
  for (const records::VerdictCell& cell : found.cells) {
    EXPECT_TRUE(cell.holds) << cell.noise << " " << of(cell, "").different;
    pairs += of(cell, "").pairs;
    false_alarms += of(cell, "").different;
    for (const records::VerdictsOfChange& change : cell.changes) {
      EXPECT_EQ(change.pairs, change.change.empty() ? options.seeds : options.changed);
      EXPECT_EQ(change.same + change.undecided + change.different, change.pairs);
    }
    EXPECT_GE(of(cell, "30 % dimmer").different, options.changed - 1) << cell.noise;
  }
  // Half of the significance is that of the pixels and regions. So a significance that is five times as large fails here.
  EXPECT_LE(false_alarms, most_alarms(pairs, options.significance / 2));
}

TEST(Verdicts, UsePicturesWithOneExpectation) {
  for (const Noise noise : {Noise::kColours, Noise::kGamma, Noise::kFireflies, Noise::kRenders}) {
    const Cell cell{noise, 16, 4, 2};
    const Image one = picture_of(cell, 1, nullptr), again = picture_of(cell, 1, nullptr),
                other = picture_of(cell, 2, nullptr);
    EXPECT_TRUE(std::ranges::equal(one.values(), again.values()));
    EXPECT_FALSE(std::ranges::equal(one.values(), other.values()));
    // The means over many pictures of two sets of seeds agree within their error.
    double sum = 0, squares = 0;
    constexpr int kPictures = 200;
    for (int k = 0; k < kPictures; ++k) {
      double apart = 0;
      const Image a = picture_of(cell, std::uint64_t(10 + 2 * k), nullptr),
                  b = picture_of(cell, std::uint64_t(11 + 2 * k), nullptr);
      for (std::size_t i = 0; i < a.values().size(); ++i)
        apart += double(a.values()[i]) - double(b.values()[i]);
      sum += apart;
      squares += apart * apart;
    }
    EXPECT_LT(std::abs(sum), 4 * std::sqrt(squares)) << kNoiseNames[std::size_t(noise)];
  }
}

TEST(VerdictReport, NamesWhatIsOutsideAndDrawsCurves) {
  records::VerifyVerdicts verdicts;
  verdicts.significance = 0.01;
  verdicts.seeds = 100;
  verdicts.outside = 1;
  verdicts.left_out = "Blender is not installed";
  verdicts.cells = {
      {"grey", 48, 16, 2, {{"", 0, 100, 90, 9, 1}, {"5 % dimmer", 0.05, 100, 0, 30, 70}}, 6, true},
      {"grey",
       96,
       16,
       2,
       {{"", 0, 100, 0, 91, 9}, {"5 % dimmer", 0.05, 100, 0, 0, 100}},
       6,
       false}};
  const std::string text = report_text(verdicts);
  EXPECT_THAT(text, HasSubstr("OUTSIDE 9 of 100"));
  EXPECT_THAT(text, HasSubstr("70 of 100"));
  EXPECT_THAT(text, HasSubstr("10 false alarms in 200 pairs"));
  EXPECT_THAT(text, HasSubstr("cycles: left out, Blender is not installed"));
  const auto drawn = charts(verdicts);
  ASSERT_EQ(drawn.size(), 1u);
  ASSERT_EQ(drawn[0].series.size(), 2u);
  EXPECT_EQ(drawn[0].series[0].x, (std::vector{0.0, 0.05}));
  EXPECT_EQ(drawn[0].series[0].y, (std::vector{0.01, 0.7}));
}

}  // namespace
}  // namespace lobelia::verdicts
