// Error bars and verdicts of two pictures with noise.
#include <oneapi/tbb/global_control.h>

#include <boost/math/distributions/binomial.hpp>

#include "base/system/error.hpp"
#include "base/words/constants.hpp"
#include "compare/compare.hpp"
#include "compare/uncertainty/z_test.hpp"
#include "profile/critical.hpp"
#include "tests/compare/noisy_pictures.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using fixtures::NoiseKind;

ZTest test_of(const Image& a, const Image& b, NoiseOfPair noise,
              const Tolerance* tolerance = nullptr) {
  MetricInput input = fixtures::input(a, b, tolerance);
  input.noise = &noise;
  return z_test(input);
}

bool found(const ZTest& test) { return test.beyond > 0 || test.regions > 0; }

// ---- one number

TEST(Sidak, IsTheClosedFormAndKeepsItsDigitsForManyTests) {
  EXPECT_DOUBLE_EQ(sidak(0.05, 1), 0.05);
  // Abdi 2007, "Bonferroni and Sidak corrections for multiple comparisons": 4 tests at .05.
  EXPECT_NEAR(sidak(0.05, 4), 0.0127, 5e-5);
  EXPECT_NEAR(1 - std::pow(1 - sidak(0.05, 100), 100), 0.05, 1e-14);
  // ln(1 / 0.99) / m to first order; 1 - 0.99^(1/m) by itself has three digits left.
  EXPECT_NEAR(sidak(0.01, 1e13) * 1e13, 0.010050335853501441, 1e-14);
}

TEST(EquivalentZ, IsAsRareAsTheTable) {
  // Student's t, two-sided 5 %, 1 %: 12.706 (1), 2.131 (15), 63.657 (1); normal 1.960, 2.576.
  EXPECT_NEAR(equivalent_z(12.706, 1), 1.95996, 1e-4);
  EXPECT_NEAR(equivalent_z(-2.131, 15), -1.95996, 5e-4);
  EXPECT_NEAR(equivalent_z(63.657, 1), 2.57583, 1e-4);
  EXPECT_EQ(equivalent_z(7, kInfinity), 7);
  EXPECT_EQ(equivalent_z(kInfinity, 1), kInfinity);
  EXPECT_EQ(equivalent_z(0, 1), 0);
  // Half of two-sided 10 % is two-sided 5 %.
  EXPECT_NEAR(equivalent_z(1.64485, kInfinity, 0.5), 1.95996, 1e-4);
  EXPECT_NEAR(equivalent_z(-6.3138, 1, 0.5), -1.95996, 1e-4);
  EXPECT_GT(equivalent_z(1e6, 1e4), 38) << "rarer than a double holds, and still no less";
}

TEST(CriticalT, IsTheZOfItsLevelAndNeverLess) {
  for (const double each : {0.05, 1e-4, 1e-9}) {
    const CriticalT critical(each);
    for (const double freedom : {1.0, 1.01, 2.7, 15.0, 17.0, 300.0, 1e5, 1e12}) {
      const double z = equivalent_z(critical(freedom), freedom);
      EXPECT_GE(z, critical.normal() - 1e-9) << freedom;
      EXPECT_LE(z, 1.03 * critical.normal()) << freedom;
    }
    EXPECT_NEAR(critical(kInfinity), critical.normal(), 1e-3);
  }
}

// ---- noise

TEST(Noise, IsTheStandardErrorOfTheMeanOfReplicates) {
  std::vector<Image> replicates;
  for (const float value : {1.0f, 2.0f, 3.0f, 6.0f})
    replicates.push_back(fixtures::flat(3, 2, value, value, value));
  const NoisyPicture mean = mean_of_replicates(replicates, false);
  EXPECT_FLOAT_EQ(mean.image.pixel(0, 0)[0], 3);
  // (4 + 1 + 0 + 9) / (4 * 3)
  EXPECT_FLOAT_EQ(mean.noise.standard_error.pixel(0, 0)[0], std::sqrt(14.0f / 12));
  EXPECT_EQ(mean.noise.freedom, 3);
  EXPECT_EQ(mean.noise.pooled_freedom, 3) << "there is no window in so small a picture";
}

TEST(Noise, IsFreeOfTheBiasOfARootAndStaysWithItsPixel) {
  // The mean of the standard deviation of n normal values is 1 - 1 / (4 (n - 1)) of the true one.
  Image error = fixtures::flat(12, 12, 0, 0, 0);
  error.pixel(6, 6)[0] = 1;
  EXPECT_FLOAT_EQ(noise_of_standard_errors(error, 15, false).standard_error.pixel(6, 6)[0],
                  61.0f / 60);
  EXPECT_EQ(noise_of_standard_errors(error, 15, false).standard_error.pixel(6, 7)[0], 0);
  error.pixel(7, 6)[0] = 3;
  const Image pooled = noise_of_standard_errors(error, 1, false).standard_error;
  EXPECT_FLOAT_EQ(pooled.pixel(6, 6)[0], std::sqrt(5.0f));
  EXPECT_FLOAT_EQ(pooled.pixel(7, 6)[0], std::sqrt(5.0f)) << "the sum of variances is the same";
  EXPECT_EQ(pooled.pixel(6, 7)[0], 0);
}

TEST(Noise, FollowsThinLinesAndEdgesIfCautious) {
  // A pixel whose replicates happened to agree, on a noisy line, and on the noisy side of an edge.
  Image row = fixtures::flat(40, 40, 0, 0, 0), diagonal = row, edge = row;
  for (int k = 0; k < 40; ++k) row.pixel(k, 20)[0] = diagonal.pixel(k, 39 - k)[0] = 1;
  for (int y = 0; y < 40; ++y)
    for (int x = 20 + (y - 20) / 3; x < 40; ++x) edge.pixel(x, y)[0] = 1;
  row.pixel(20, 20)[0] = diagonal.pixel(20, 19)[0] = edge.pixel(20, 20)[0] = 0;
  const auto cautious = [](const Image& error, int x, int y) {
    return noise_of_standard_errors(error, 1, false).cautious.pixel(x, y)[0];
  };
  EXPECT_FLOAT_EQ(cautious(row, 20, 20), std::sqrt(16.0f / 17));
  EXPECT_FLOAT_EQ(cautious(diagonal, 20, 19), std::sqrt(16.0f / 17));
  EXPECT_GE(cautious(edge, 20, 20), 0.97f);
  EXPECT_EQ(cautious(row, 20, 30), 0) << "far from it there is none";
}

TEST(Noise, IsRefusedIfItIsNoErrorOrFitsNothing) {
  Image error = fixtures::flat(4, 4, 1, 1, 1);
  EXPECT_THROW(noise_of_standard_errors(error, 0.5, false), Error);
  EXPECT_THROW(noise_of_standard_errors(error, std::nan(""), false), Error);
  EXPECT_THROW(noise_of_standard_errors(Image(), 15, false), Error);
  error.pixel(1, 2)[0] = -1e-9f;
  EXPECT_THROW(noise_of_standard_errors(error, 15, false), Error);
  error.pixel(1, 2)[0] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(noise_of_standard_errors(error, 15, false), Error);
  const Image different[] = {fixtures::flat(4, 4, 1, 1, 1), fixtures::flat(4, 5, 1, 1, 1)};
  EXPECT_THROW(mean_of_replicates(different, false), Error);
  EXPECT_THROW(mean_of_replicates(std::span(different).first(1), false), Error);
  ComparisonOptions options;
  options.noise = NoiseOptions{.a = fixtures::even_noise(8, 9, 1)};
  EXPECT_THROW(compare(Image(8, 8), Image(8, 8), options), Error);
}

// ---- the level that is held

/// The most false alarms in so many trials that a test of that level has but once in a thousand such tests.
int most_alarms(int trials, double level) {
  return int(
      boost::math::quantile(boost::math::complement(boost::math::binomial(trials, level), 1e-3)));
}

TEST(ZTest, FindsNothingInNoiseBeyondItsSignificance) {
  // Two half-sample pictures of 8 samples a pixel each, and four, against the truth and against another pair.
  // The nearest to the level, of 300 trials at 0.05: silhouettes, 0.03 from two and 0.017 from four; all
  // others 0.004 and less.
  constexpr double kSignificance = 0.05;
  constexpr Tolerance kRounding{1e-6, 1e-7, 0};
  for (const int count : {2, 4})
    for (const NoiseKind kind : fixtures::kNoiseKinds) {
      const Image truth = fixtures::expectation(kind);
      const int trials = (kind == NoiseKind::kSilhouette ? 20 : 7) * more_samples();
      int against_truth = 0, against_another = 0;
      for (int trial = 0; trial < trials; ++trial) {
        const auto seed = std::uint64_t(trial);
        const NoisyPicture a = fixtures::noisy_mean(kind, 1000 + seed, count, 8);
        const NoisyPicture b = fixtures::noisy_mean(kind, 9000 + seed, count, 8);
        against_truth +=
            found(test_of(a.image, truth, {&a.noise, nullptr, kSignificance}, &kRounding));
        against_another +=
            found(test_of(a.image, b.image, {&a.noise, &b.noise, kSignificance}, &kRounding));
      }
      EXPECT_LE(against_truth, most_alarms(trials, kSignificance)) << fixtures::name(kind) << count;
      EXPECT_LE(against_another, most_alarms(trials, kSignificance))
          << fixtures::name(kind) << count;
    }
}

// ---- what is found

TEST(ZTest, FindsASinglePixelThatIsOffByManyErrors) {
  int found_at = 0;
  constexpr int kTrials = 20;
  const Image truth = fixtures::expectation(NoiseKind::kEven);
  for (int trial = 0; trial < kTrials; ++trial) {
    NoisyPicture a = fixtures::noisy_mean(NoiseKind::kEven, 50 + std::uint64_t(trial), 16, 4);
    // The true error is 0.03. One and a half of that, said of its noise at the most, and Student's
    // quantile for 17 degrees of freedom, 8 where a normal one is 5, are 12.
    a.image.pixel(20, 30)[1] += 16 * 0.03f;
    const ZTest test = test_of(a.image, truth, {&a.noise});
    found_at += test.beyond == 1 && test.x <= 20 && 20 < test.x + test.size && test.y <= 30 &&
                30 < test.y + test.size;
  }
  EXPECT_GE(found_at, kTrials - 1);
}

TEST(ZTest, FindsADriftOfAPercentThatNoPixelShows) {
  // Two half-sample pictures with noise of 10 % of each value: 0.01 is a seventh of the error of a pixel's mean,
  // and 13 errors of the mean of all.
  constexpr int kSide = 96;
  const Image truth = fixtures::flat(kSide, kSide, 0.5f, 0.4f, 0.3f);
  for (int trial = 0; trial < 10; ++trial) {
    Image halves[] = {truth, truth};
    for (int half = 0; half < 2; ++half)
      for (std::size_t i = 0; i < truth.values().size(); ++i)
        halves[half].values()[i] *=
            1.01f + 0.1f * float(gaussian(std::uint64_t(10 * trial + half), i / 3));
    const NoisyPicture a = mean_of_replicates(halves, false);
    const ZTest test = test_of(a.image, truth, {&a.noise});
    EXPECT_EQ(test.beyond, 0);
    EXPECT_GT(test.regions, 0);
    EXPECT_GT(test.size, 8);
  }
}

TEST(ZTest, FindsHighlightChangesHiddenFromRegions) {
  // In each value noise of a tenth of the peak, two pictures a side. A score test finds what is 4 to 8 errors of its sum.
  constexpr int kSide = 48, kTrials = 10;
  const auto highlight = [](double u, double v, double width) {
    return std::exp(-20 / (width * width) * (u * u + v * v));
  };
  const auto found_of = [&](const auto& changed) {
    int found_of_all = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
      std::vector<Image> replicates[2];
      for (std::size_t side = 0; side < 2; ++side)
        for (std::size_t r = 0; r < 2; ++r) {
          Image image = fixtures::reddish(kSide, kSide, [&](double u, double v) {
            return side == 0 ? changed(u, v) : highlight(u, v, 1);
          });
          const auto values = image.values();
          for (std::size_t i = 0; i < values.size(); ++i)
            values[i] += 0.1f * float(gaussian(4 * std::uint64_t(trial) + 2 * side + r, i));
          replicates[side].push_back(std::move(image));
        }
      const NoisyPicture a = mean_of_replicates(replicates[0], false),
                         b = mean_of_replicates(replicates[1], false);
      found_of_all += found(test_of(a.image, b.image, {&a.noise, &b.noise}));
    }
    return found_of_all;
  };
  EXPECT_LE(found_of([&](double u, double v) { return highlight(u, v, 1); }), 1);
  EXPECT_GE(found_of([&](double u, double v) { return 0.92 * highlight(u, v, 1); }), kTrials - 1);
  EXPECT_GE(found_of([&](double u, double v) { return highlight(u + 0.02, v, 1); }), kTrials - 1);
  EXPECT_GE(found_of([&](double u, double v) { return highlight(u, v - 0.02, 1); }), kTrials - 1);
  EXPECT_GE(found_of([&](double u, double v) { return highlight(u, v, 1.06); }), kTrials - 1);
}

TEST(ZTest, TrustsAQuietSquareLessUnderHeavyTails) {
  constexpr int kSide = 16;
  const Image b = fixtures::flat(kSide, kSide, 5, 5, 5);
  Image a = b;
  for (int y = 0; y < kSide / 2; ++y)
    for (int x = 0; x < kSide / 2; ++x) a.pixel(x, y)[0] += 0.9f;
  PictureNoise noise = fixtures::even_noise(kSide, kSide, 1);
  noise.cautious = fixtures::flat(kSide, kSide, 3, 3, 3);
  // 64 times 0.9 is 7.2 errors of the replicates, and 3.2 of what is halfway to the cautious ones.
  const ZTest light = test_of(a, b, {&noise, nullptr});
  EXPECT_EQ(light.regions, 1);
  EXPECT_EQ(light.size, kSide / 2);
  noise.fireflies = 2 * kHeavyTails;
  EXPECT_FALSE(found(test_of(a, b, {&noise, nullptr})));
}

TEST(ZTest, WithoutNoiseFindsEveryDifferenceAndNothingElse) {
  const Image b = fixtures::highlight(20, 13, 3, 1);
  const PictureNoise none = fixtures::even_noise(20, 13, 0);
  EXPECT_EQ(test_of(b, b, {&none, &none}).largest, 0);
  EXPECT_FALSE(found(test_of(b, b, {&none, &none})));
  Image a = b;
  a.pixel(7, 5)[2] = std::nextafter(a.pixel(7, 5)[2], 2.0f);
  const ZTest test = test_of(a, b, {&none, &none});
  EXPECT_EQ(test.largest, kInfinity);
  EXPECT_EQ(test.beyond, 1);
  EXPECT_EQ(test.x, 7);
  EXPECT_EQ(test.y, 5);
  EXPECT_EQ(test.regions, 9) << "10 x 7, 5 x 4, 3 x 2, 2 x 1, 1 x 1, and four patterns";
}

TEST(ZTest, SubtractsTheTolerance) {
  const Image b = fixtures::flat(16, 16, 1, 1, 1);
  Image a = b;
  for (float& value : a.values()) value += 0.0009f;  // rounding, all to one side
  a.pixel(3, 3)[0] = 2;
  const PictureNoise noise = fixtures::even_noise(16, 16, 1e-5f);
  Tolerance tolerance{1e-3, 0, 1};
  ZTest test = test_of(a, b, {&noise}, &tolerance);
  EXPECT_EQ(test.beyond, 1);
  EXPECT_EQ(test.regions, 0)
      << "an outlier that is allowed is not found again in what is around it";
  EXPECT_EQ(test.open, 1);
  EXPECT_EQ(test.off_edge, 0);
  tolerance.edges.assign(256, 1);
  tolerance.edges[3 * 16 + 3] = 0;
  EXPECT_EQ(test_of(a, b, {&noise}, &tolerance).off_edge, 1);
  tolerance.allowed_outliers = 0;
  EXPECT_GT(test_of(a, b, {&noise}, &tolerance).regions, 0);
  tolerance = {0, 1e-4, 1};
  EXPECT_EQ(test_of(a, b, {&noise}, &tolerance).beyond, 256);
  const PictureNoise strong = fixtures::even_noise(16, 16, 1e-3f);
  EXPECT_EQ(test_of(a, b, {&strong}, &tolerance).open, 256) << "most are within, none surely";
}

// ---- error bars

const ErrorBar& bar_of(const Comparison& comparison, std::string_view id) {
  return *records::find(comparison.error_bars, id);
}

TEST(ErrorBars, HoldTheFigureOfTheExpectationsAsOftenAsTheySay) {
  // A highlight that is 2 % too bright, under noise of 5 % of the peak in four replicates of a.
  constexpr int kTrials = 60;
  const Image b = fixtures::highlight(48, 48, 6, 1),
              expected = fixtures::highlight(48, 48, 6, 1.02);
  ComparisonOptions options;
  options.noise = NoiseOptions{};
  const Comparison truth = compare(expected, b, {});
  std::map<std::string, int> missed;
  std::map<std::string, std::vector<double>> values, errors;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<Image> replicates(4, expected);
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t i = 0; i < expected.values().size(); ++i)
        replicates[k].values()[i] += 0.1f * float(gaussian(4 * std::uint64_t(trial) + k, i));
    NoisyPicture a = mean_of_replicates(replicates, false);
    options.noise->a = a.noise;
    options.noise->seed = std::uint64_t(trial);
    const Comparison comparison = compare(a.image, b, options);
    for (const auto& [id, bar] : comparison.error_bars) {
      const double expectation = truth.value(id);
      missed[id] += !(bar.low <= expectation && expectation <= bar.high);
      values[id].push_back(comparison.value(id));
      errors[id].push_back(bar.standard_error);
    }
  }
  EXPECT_GT(missed.size(), 15u);
  for (const auto& [id, count] : missed) EXPECT_LE(count, most_alarms(kTrials, 0.05)) << id;
  // And the standard error is what the figure really scatters by. Of figures with noise twice over, so that
  // it is right where a figure is no sum of squares near its floor.
  for (const char* id : {"drift", "rmse", "mae"}) {
    double mean = 0, squares = 0, said = 0;
    for (const double value : values[id]) mean += value / kTrials;
    for (const double value : values[id])
      squares += (value - mean) * (value - mean) / (kTrials - 1);
    for (const double error : errors[id]) said += error / kTrials;
    EXPECT_GT(said, 0.75 * std::sqrt(squares)) << id;
    EXPECT_LT(said, 1.5 * std::sqrt(squares)) << id;
  }
}

TEST(ErrorBars, HaveTheNoiseFloorOfTheTextbook) {
  const Image b = fixtures::flat(40, 40, 0.5f, 0.5f, 0.5f);
  ComparisonOptions options;
  options.noise = NoiseOptions{.a = fixtures::even_noise(40, 40, 0.03f, 1e9),
                               .b = fixtures::even_noise(40, 40, 0.04f, 1e9)};
  const Comparison comparison = compare(b, b, options);
  EXPECT_NEAR(bar_of(comparison, "rmse").noise_floor, 0.05, 0.05 * 0.01);
  EXPECT_NEAR(bar_of(comparison, "mae").noise_floor, 0.05 * std::sqrt(2 / 3.14159265), 0.0005);
  EXPECT_NEAR(bar_of(comparison, "mse").noise_floor, 0.0025, 5e-5);
  // Standard errors do not say whether the channels of a pixel err together: the worse counts.
  const ErrorBar& drift = bar_of(comparison, "drift");
  EXPECT_NEAR(drift.standard_error, 0.05 / std::sqrt(1600), 4e-4);
  // Student's t at 97.5 % for 31 degrees of freedom is 2.04, and the spread is the larger one of two kinds of draws.
  const double half = (drift.high - drift.low) / 2 / drift.standard_error;
  EXPECT_GT(half, 1.95);
  EXPECT_LT(half, 2.04 * 1.5);
  EXPECT_EQ(bar_of(comparison, "rmse").low, 0);
  EXPECT_EQ(records::find(comparison.error_bars, "max_abs.x"), nullptr) << "a fact has none";
}

TEST(ErrorBars, DependOnTheSeedAndNotOnTheNumberOfThreads) {
  const Image b = fixtures::highlight(64, 64, 5, 1), a = fixtures::highlight(64, 64, 5, 1.1);
  ComparisonOptions options;
  options.noise = NoiseOptions{.a = fixtures::even_noise(64, 64, 0.1f), .bootstraps = 5};
  const auto error = [&] { return bar_of(compare(a, b, options), "rmse").standard_error; };
  const double many = error();
  {
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(error(), many);
  }
  options.noise->seed = 1;
  EXPECT_NE(error(), many);
}

}  // namespace
}  // namespace lobelia
