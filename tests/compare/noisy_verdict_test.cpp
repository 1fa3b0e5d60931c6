// Verdicts on pictures with noise: same, different, or undecided.
#include "compare/compare.hpp"
#include "compare/uncertainty/noise_draws.hpp"
#include "tests/compare/noisy_pictures.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

struct Pair {
  Image a, b;
};

/// A highlight that is too bright by a share, each value of `a` off by so much noise.
Pair pair(double brighter, float error, std::uint64_t seed = 0) {
  Pair result{fixtures::highlight(48, 48, 4, 1 + brighter), fixtures::highlight(48, 48, 4, 1)};
  for (std::size_t i = 0; i < result.a.values().size(); ++i)
    result.a.values()[i] += error * float(gaussian(seed, i));
  return result;
}

Comparison compare_noisy(double brighter, float error, ComparisonOptions options) {
  const auto [a, b] = pair(brighter, error);
  options.noise = NoiseOptions{.a = fixtures::even_noise(48, 48, error, 1e9), .bootstraps = 8};
  return compare(a, b, options);
}

TEST(NoisyVerdict, FollowsTheWholeErrorBar) {
  ComparisonOptions options;
  options.limits = {{"rmse", 0.01}};
  EXPECT_EQ(compare_noisy(0, 0.001f, options).verdict, Verdict::kSame);
  EXPECT_EQ(compare_noisy(0.1, 0.001f, options).verdict, Verdict::kDifferent);
  const Comparison open = compare_noisy(0, 0.02f, options);
  EXPECT_EQ(open.verdict, Verdict::kUndecided) << "its rmse is 0.02, and all of that may be noise";
  EXPECT_FALSE(open.limits[0].pass);
  // So many times the samples, and noise by their root weaker.
  const double times = open.limits[0].more_samples.value();
  EXPECT_GT(times, 3.5);
  EXPECT_LT(times, 6);
  EXPECT_EQ(compare_noisy(0, float(0.02 / std::sqrt(1.2 * times)), options).verdict,
            Verdict::kSame);
  options.limits = {{"ssim", 0.99}, {"psnr", 30}, {"drift", 0.001}};
  EXPECT_EQ(compare_noisy(0, 0.001f, options).verdict, Verdict::kSame);
  EXPECT_EQ(compare_noisy(0.3, 0.001f, options).verdict, Verdict::kDifferent);
}

TEST(NoisyVerdict, IsDifferentWithoutLimitsWhereAnythingIsFound) {
  EXPECT_EQ(compare_noisy(0, 2e-4f, {}).verdict, Verdict::kSame);
  const Comparison found = compare_noisy(0.003, 2e-4f, {});
  EXPECT_EQ(found.verdict, Verdict::kDifferent) << "within every limit, but no chance";
  EXPECT_EQ(compare_noisy(0, 1, {}).verdict, Verdict::kUndecided);
  EXPECT_EQ(compare_noisy(0.003, 1, {}).verdict, Verdict::kUndecided);
}

TEST(NoisyVerdict, IsSameByAToleranceOnlyIfPixelsSurelyLieWithinIt) {
  ComparisonOptions options;
  options.tolerance = Tolerance{0, 0.01, 0};
  EXPECT_EQ(compare_noisy(0, 1e-3f, options).verdict, Verdict::kSame);
  EXPECT_EQ(compare_noisy(0, 5e-3f, options).verdict, Verdict::kUndecided);
  EXPECT_EQ(compare_noisy(0.1, 1e-3f, options).verdict, Verdict::kDifferent);
  options.limits = {{"rmse", 0.1}};
  EXPECT_EQ(compare_noisy(0, 5e-3f, options).verdict, Verdict::kSame) << "the limit is fine enough";
  EXPECT_EQ(compare_noisy(0.1, 1e-3f, options).verdict, Verdict::kDifferent);
}

TEST(NoisyVerdict, IsNotTurnedIntoSameByMoreNoise) {
  std::vector<ComparisonOptions> asked(3);
  asked[1].limits = {{"max_rel_peak", 0.02}, {"flip.ldr.mean", 0.02}};
  asked[2].tolerance = Tolerance{0, 0.02, 3};
  for (const ComparisonOptions& options : asked)
    for (const double brighter : {0.0, 0.01, 0.03}) {
      bool was_open = false;
      for (const float error : {1e-4f, 1e-3f, 1e-2f, 0.1f, 1.0f, 10.0f}) {
        const Verdict verdict = compare_noisy(brighter, error, options).verdict;
        EXPECT_FALSE(was_open && verdict == Verdict::kSame) << brighter << " " << error;
        was_open = was_open || verdict == Verdict::kUndecided;
      }
      EXPECT_TRUE(was_open) << "noise was not strong enough for this test";
    }
}

TEST(NoisyVerdict, IsStillNonFiniteForAPictureThatIsNotFinite) {
  auto [a, b] = pair(0, 0);
  a.pixel(1, 1)[0] = std::numeric_limits<float>::quiet_NaN();
  ComparisonOptions options;
  options.noise = NoiseOptions{.a = fixtures::even_noise(48, 48, 1)};
  const Comparison comparison = compare(a, b, options);
  EXPECT_EQ(comparison.verdict, Verdict::kNonFinite);
  EXPECT_FALSE(comparison.uncertainty);
  EXPECT_TRUE(comparison.metrics.empty());
  for (const LimitResult& limit : comparison.limits) EXPECT_FALSE(limit.pass);
  const Image halves[] = {a, b};
  EXPECT_EQ(compare(mean_of_replicates(halves, false).image, b, options).nonfinite.a, 1);
}

TEST(NoisyVerdict, IsUndecidedOnALimitThatCouldNotBeMeasured) {
  ComparisonOptions options;
  options.limits = {{"ssim", 0.5}};
  options.noise = NoiseOptions{.a = fixtures::even_noise(4, 4, 1)};
  const Image small = fixtures::flat(4, 4, 1, 1, 1), other = fixtures::flat(4, 4, 1, 1, 0.9f);
  EXPECT_EQ(compare(small, other, options).verdict, Verdict::kUndecided);
}

/// The standing of a limit of 0.001 on the drift of an even picture that is too bright by 6.2 standard errors of its mean.
std::string standing_of_drift(double significance, std::vector<MetricLimit> more = {}) {
  const Image b = fixtures::flat(48, 48, 0.5f, 0.5f, 0.5f),
              a = fixtures::flat(48, 48, 0.5062f, 0.5062f, 0.5062f);
  ComparisonOptions options;
  options.default_limits = false;
  options.limits = std::move(more);
  options.limits.insert(options.limits.begin(), {"drift", 0.001});
  options.noise = NoiseOptions{.a = fixtures::even_noise(48, 48, 0.048f, 1e9),
                               .significance = significance,
                               .bootstraps = 64};
  return compare(a, b, options).limits.front().standing;
}

TEST(NoisyVerdict, IsStricterAtASmallerSignificanceAndWithMoreLimits) {
  EXPECT_EQ(standing_of_drift(0.01), Standing::kBroken);
  EXPECT_EQ(standing_of_drift(1e-9), Standing::kOpen);
  // Limits that hold for certain take their part of the significance.
  std::vector<MetricLimit> many;
  for (const char* id :
       {"mae", "mse", "rmse", "max_abs", "relmse.eps=0.01", "max_rel_peak", "psnr"})
    many.push_back({id, std::string_view(id) == "psnr" ? 0.0 : 1.0});
  double alone = 1e-2, together = 1e-2;
  while (standing_of_drift(alone) == Standing::kBroken) alone /= 2;
  while (standing_of_drift(together, many) == Standing::kBroken) together /= 2;
  EXPECT_GT(together, 3 * alone);
}

// Draws of the noise that replicates or standard errors tell.

using fixtures::NoiseKind;

constexpr int kSide = 40;

/// Two values a pixel that err as `noise` draws them, over many draws: the variance of each, and their correlation.
struct Moments {
  double first = 0, second = 0, product = 0, mean = 0;
};

Moments moments(const PictureNoise& noise, Together together, int draws) {
  const Image black(noise.standard_error.width(), noise.standard_error.height());
  Moments sum;
  for (int k = 0; k < draws; ++k) {
    const Image drawn = with_noise(black, &noise, std::uint64_t(k), together);
    for (std::size_t i = 0; i < drawn.values().size(); i += 3) {
      const double r = double(drawn.values()[i]), g = double(drawn.values()[i + 1]);
      const double share = 1 / (double(draws) * double(drawn.pixel_count()));
      sum.first += r * r * share;
      sum.second += g * g * share;
      sum.product += r * g * share;
      sum.mean += r * share;
    }
  }
  return sum;
}

/// The mean of so many pictures of normal noise, of variance 1 in red and 4 in green, which err together or not.
NoisyPicture mean_of_normal(int count, bool grey) {
  std::vector<Image> replicates;
  for (int r = 0; r < count; ++r) {
    Image& image = replicates.emplace_back(kSide, kSide);
    for (std::size_t i = 0; i < image.values().size(); ++i)
      image.values()[i] =
          float((i % 3 == 1 ? 2 : 1) * gaussian(std::uint64_t(r), grey ? i / 3 : i));
  }
  return mean_of_replicates(replicates, false);
}

TEST(NoiseDraws, HaveTheVarianceOfTheMeanForAnyNumberOfReplicates) {
  for (const int count : {2, 3, 4, 5, 9, 12}) {
    const Moments drawn = moments(mean_of_normal(count, false).noise, Together::kChannels, 12);
    // The pictures themselves scatter by the root of 2 over 1600 pixels and the degrees of freedom.
    EXPECT_NEAR(drawn.first * count, 1, 0.13) << count;
    EXPECT_NEAR(drawn.second * count, 4, 0.52) << count;
    EXPECT_NEAR(drawn.product * count, 0, 0.2) << count;
    EXPECT_NEAR(drawn.mean, 0, 0.02) << count;
  }
}

TEST(NoiseDraws, KeepTheCorrelationOfChannels) {
  for (const int count : {2, 3, 9}) {
    const Moments drawn = moments(mean_of_normal(count, true).noise, Together::kNothing, 6);
    EXPECT_NEAR(drawn.product / std::sqrt(drawn.first * drawn.second), 1, 1e-6) << count;
  }
}

TEST(NoiseDraws, AreNormalForStandardErrorsWithChannelsTogetherOrApart) {
  const PictureNoise noise = fixtures::even_noise(kSide, kSide, 0.5f, 1e9);
  const Moments apart = moments(noise, Together::kNothing, 8),
                together = moments(noise, Together::kChannels, 8);
  EXPECT_NEAR(apart.first, 0.25, 0.02);
  EXPECT_NEAR(apart.product, 0, 0.02);
  EXPECT_NEAR(together.first, 0.25, 0.02);
  EXPECT_NEAR(together.product, together.first, 1e-6);
}

TEST(NoiseDraws, KeepTheTailsOfTheReplicates) {
  // One pixel in fifty has a value of 20 in one of the two: half of that is the largest error.
  std::vector<Image> pair{fixtures::noise(kSide, kSide, 1, 0.1f),
                          fixtures::noise(kSide, kSide, 2, 0.1f)};
  for (std::size_t i = 0; i < pair[0].pixel_count(); i += 50)
    for (std::size_t c = 0; c < 3; ++c) pair[i % 100 == 0 ? 0 : 1].values()[3 * i + c] = 20;
  const PictureNoise noise = mean_of_replicates(pair, false).noise;
  EXPECT_GT(noise.fireflies, kHeavyTails);
  const Image drawn = with_noise(Image(kSide, kSide), &noise, 7, Together::kChannels);
  int large = 0;
  for (std::size_t i = 0; i < drawn.values().size(); i += 3) {
    EXPECT_LT(std::abs(drawn.values()[i]), 10.1f);
    large += std::abs(drawn.values()[i]) > 9.8f;
  }
  EXPECT_NEAR(large, 32, 20);
}

TEST(NoiseDraws, ErrInAWholePictureTogetherWherePixelsShareTheirPoints) {
  const Image a = fixtures::flat(4, 4, 1, 1, 1), b = fixtures::flat(4, 4, 2, 4, 8);
  const PictureNoise noise = mean_of_replicates(std::array{a, b}, true).noise;
  const Image drawn = with_noise(a, &noise, 3, Together::kPicture);
  for (std::size_t i = 3; i < drawn.values().size(); ++i)
    EXPECT_EQ(drawn.values()[i], drawn.values()[i % 3]);
  EXPECT_EQ(std::abs(drawn.values()[2] - 1), 3.5f);
}

TEST(NoiseDraws, LeavePixelsWithoutNoiseAsTheyAre) {
  std::vector<Image> pair{fixtures::flat(9, 9, 1, 1, 1), fixtures::flat(9, 9, 1, 1, 1)};
  pair[0].pixel(4, 4)[0] = 3;
  const PictureNoise noise = mean_of_replicates(pair, false).noise;
  const Image drawn = with_noise(Image(9, 9), &noise, 1, Together::kChannels);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x) EXPECT_EQ(std::abs(drawn.pixel(x, y)[0]), x == 4 && y == 4 ? 1 : 0);
}

TEST(CommonExpectation, LiesNearerTheTruthThanEitherPicture) {
  for (const NoiseKind kind : {NoiseKind::kEven, NoiseKind::kHighlight, NoiseKind::kEdge}) {
    const NoisyPicture a = fixtures::noisy_mean(kind, 1, 2, 8),
                       b = fixtures::noisy_mean(kind, 2, 4, 8);
    const Image expected = common_expectation(a.image, b.image, {&a.noise, &b.noise}),
                truth = fixtures::expectation(kind);
    const auto error = [&](const Image& image) {
      double sum = 0;
      for (std::size_t i = 0; i < image.values().size(); ++i)
        sum += std::pow(double(image.values()[i]) - double(truth.values()[i]), 2);
      return std::sqrt(sum);
    };
    EXPECT_LT(error(expected), 0.9 * error(b.image)) << fixtures::name(kind);
    EXPECT_LT(error(expected), error(a.image)) << fixtures::name(kind);
  }
}

TEST(CommonExpectation, IsThePictureWithoutNoiseWhereOneHasNone) {
  const NoisyPicture a = fixtures::noisy_mean(NoiseKind::kHighlight, 1, 2, 8);
  const Image truth = fixtures::expectation(NoiseKind::kHighlight);
  const auto is_truth = [&](const Image& image) {
    return std::ranges::equal(image.values(), truth.values());
  };
  EXPECT_TRUE(is_truth(common_expectation(a.image, truth, {&a.noise, nullptr})));
  EXPECT_TRUE(is_truth(common_expectation(truth, truth, {})));
}

TEST(Noise, ReportsOnlyTrueFireflies) {
  for (const NoiseKind kind : fixtures::kNoiseKinds)
    for (const int count : {2, 4}) {
      const double share = fixtures::noisy_mean(kind, 5, count, 8).noise.fireflies;
      if (kind == NoiseKind::kFireflies)
        EXPECT_GE(share, kHeavyTails) << count;
      else
        EXPECT_LT(share, kHeavyTails) << fixtures::name(kind) << count;
    }
}

}  // namespace
}  // namespace lobelia
