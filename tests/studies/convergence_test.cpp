#include "studies/cost/convergence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lobelia::cost {
namespace {

std::vector<double> powers(const std::vector<double>& x, double factor, double exponent) {
  std::vector<double> y;
  for (const double v : x) y.push_back(factor * std::pow(v, exponent));
  return y;
}

TEST(SlopeFit, FindsThePowerOfAPowerLaw) {
  const std::vector<double> x{1, 3, 10, 50};
  const Slope slope = fit_slope(x, powers(x, 7, -0.75));
  EXPECT_NEAR(slope.value, -0.75, 1e-12);
  EXPECT_NEAR(slope.standard_error, 0, 1e-6);
}

TEST(SlopeFit, SaysThatAMonteCarloMeanConvergesAsTheSquareRoot) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> even(0, 1);
  std::vector<double> samples, errors;
  for (int n = 4; n <= 4096; n *= 4) {
    double squared = 0;
    constexpr int kMeans = 400;
    for (int i = 0; i < kMeans; ++i) {
      double mean = 0;
      for (int j = 0; j < n; ++j) mean += even(random) / n;
      squared += std::pow(mean - 0.5, 2) / kMeans;
    }
    samples.push_back(n);
    errors.push_back(std::sqrt(squared));
  }
  const Slope slope = fit_slope(samples, errors);
  EXPECT_NEAR(slope.value, -0.5, 3 * slope.standard_error);
  EXPECT_GT(slope.standard_error, 0);
  EXPECT_LT(slope.standard_error, 0.05);
}

TEST(SlopeFit, HasTheTextbooksStandardErrorOfThreePoints) {
  // y = x but for the middle, which is e^0.3 too high: residuals -0.1, 0.2, -0.1 around the line; 1 left.
  const Slope slope =
      fit_slope({std::exp(-1), 1, std::exp(1)}, {std::exp(-1), std::exp(0.3), std::exp(1)});
  EXPECT_NEAR(slope.value, 1, 1e-12);
  EXPECT_NEAR(slope.standard_error, std::sqrt(0.06 / 1 / 2), 1e-12);
}

TEST(SlopeFit, KnowsWhatItCannotTell) {
  EXPECT_TRUE(std::isnan(fit_slope({1}, {1}).value));
  EXPECT_NEAR(fit_slope({1, 4}, {1, 0.5}).value, -0.5, 1e-12);
  EXPECT_TRUE(std::isnan(fit_slope({1, 4}, {1, 0.5}).standard_error));
}

TEST(TimeToError, IsInterpolatedOnThePowerLawBetweenTwoPoints) {
  const std::vector<double> seconds{1, 4, 16};
  const auto errors = powers(seconds, 0.2, -0.5);
  const TimeTo time = time_to(seconds, seconds, errors, 0.2 / std::sqrt(8));
  EXPECT_NEAR(time.seconds, 8, 1e-12);
  EXPECT_EQ(time.reach, TimeTo::Reach::kWithin);
}

TEST(TimeToError, GoesOnBeyondTheLastPointWithoutTheStartAndSaysSo) {
  const std::vector<double> samples{1, 4, 16, 64},
      seconds{5.1, 5.4, 6.6, 11.4};  // 5 and 0.1 for each
  auto errors = powers(samples, 0.2, -0.5);
  errors[0] = 9;  // before the last three: it has no say
  const TimeTo time = time_to(samples, seconds, errors, 0.2 / 100);
  EXPECT_NEAR(time.seconds, 5 + 0.1 * 1e4, 1e-6);
  EXPECT_EQ(time.reach, TimeTo::Reach::kBeyond);
  EXPECT_TRUE(std::isinf(time_to({1, 2}, {1, 2}, {1, 1}, 0.5).seconds))
      << "the error does not fall";
  EXPECT_TRUE(std::isinf(time_to({1, 4}, {2, 2}, {1, 0.5}, 0.1).seconds)) << "no time to be seen";
}

TEST(TimeToError, IsThatOfTheFirstPointWhereItIsGoodEnough) {
  const TimeTo time = time_to({1, 4}, {3, 4}, {0.1, 0.05}, 0.2);
  EXPECT_EQ(time.seconds, 3);
  EXPECT_EQ(time.reach, TimeTo::Reach::kAtOnce);
}

}  // namespace
}  // namespace lobelia::cost
