// Verdicts on pictures with noise: same, different, or undecided.
#include "compare/compare.hpp"
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

}  // namespace
}  // namespace lobelia
