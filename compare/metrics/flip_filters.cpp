// Source, agreement and the reason for float64: see flip_ldr.cpp. Section numbers refer to Andersson et al.; the
// separation into rows and columns follows the tool's note "separatedConvolutions".
#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/metrics/flip_filters.hpp"

namespace lobelia {
namespace {

constexpr double kPi = std::numbers::pi, kPiSquared = kPi * kPi;

// Section 4.1.1, Table 1: the contrast sensitivity functions as Gaussians a sqrt(pi/b) exp(-pi^2 x^2 / b), x in
// degrees. Blue-yellow is the sum of two. The others are normalised, which cancels their a.
constexpr double kLuminanceB = 0.0047;
constexpr double kRedGreenB = 0.0053;
constexpr double kBlueYellowA1 = 34.1, kBlueYellowB1 = 0.04;
constexpr double kBlueYellowA2 = 13.5, kBlueYellowB2 = 0.025;
constexpr double kWidestB = kBlueYellowB1;

// Section 4.2.1: width in degrees of features that attract the eye.
constexpr double kFeatureWidth = 0.082;

// Both kinds of filter end three standard deviations out.
constexpr double kFilterSigmas = 3;

// The narrow Gaussians reach to seven and more of theirs. Taps below this share of the largest are left out: they
// move an error by less than 1e-7, also where it is the power of almost nothing.
constexpr double kLeastTap = 1e-12;

/// The sum of a whole filter.
double sum_of(const FlipTaps& taps) {
  double sum = -taps[0];
  for (const double tap : taps) sum += 2 * tap;
  return sum;
}

void scale(FlipTaps& taps, double factor) {
  for (double& tap : taps) tap *= factor;
}

/// Positive taps sum to 1 and negative ones to -1: a flat picture has no features. `middle` counts the middle tap,
/// the others stand for two of the filter.
void balance_even(FlipTaps& taps) {
  double positive = 0, negative = 0;
  for (std::size_t k = 0; k < taps.size(); ++k)
    (taps[k] > 0 ? positive : negative) += (k == 0 ? 1 : 2) * std::abs(taps[k]);
  for (double& tap : taps) tap /= tap > 0 ? positive : negative;
}

void drop_small(FlipTaps& taps) {
  while (taps.size() > 1 && taps.back() < kLeastTap * taps.front()) taps.pop_back();
}

}  // namespace

FlipFilters::FlipFilters(double pixels_per_degree) {
  contrast_radius =
      int(std::ceil(kFilterSigmas * std::sqrt(kWidestB / (2 * kPiSquared)) * pixels_per_degree));
  for (int i = 0; i <= contrast_radius; ++i) {
    const double x = i / pixels_per_degree;
    const auto gaussian_of = [x](double b) { return std::exp(-kPiSquared * x * x / b); };
    // With the root of the amplitude: a plane is multiplied by it once in each direction.
    const auto root = [](double a, double b) { return std::sqrt(a * std::sqrt(kPi / b)); };
    luminance.push_back(gaussian_of(kLuminanceB));
    red_green.push_back(gaussian_of(kRedGreenB));
    blue_yellow_1.push_back(root(kBlueYellowA1, kBlueYellowB1) * gaussian_of(kBlueYellowB1));
    blue_yellow_2.push_back(root(kBlueYellowA2, kBlueYellowB2) * gaussian_of(kBlueYellowB2));
  }
  scale(luminance, 1 / sum_of(luminance));
  scale(red_green, 1 / sum_of(red_green));
  // The two planes are added after both directions; all their taps together must sum to 1.
  const double sum_1 = sum_of(blue_yellow_1), sum_2 = sum_of(blue_yellow_2);
  const double norm = 1 / std::sqrt(sum_1 * sum_1 + sum_2 * sum_2);
  scale(blue_yellow_1, norm);
  scale(blue_yellow_2, norm);
  drop_small(luminance);
  drop_small(red_green);

  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  feature_radius = int(std::ceil(kFilterSigmas * sigma));
  for (int i = 0; i <= feature_radius; ++i) {
    const double x = i, g = std::exp(-(x * x) / (2 * sigma * sigma));
    gaussian.push_back(g);
    edge.push_back(x * g);
    point.push_back((x * x / (sigma * sigma) - 1) * g);
  }
  scale(gaussian, 1 / sum_of(gaussian));
  // Its taps on one side are the positive ones.
  scale(edge, 2 / sum_of(edge));
  balance_even(point);
  // As many as those of features, which are never fewer: one loop along a row adds all that filters y.
  luminance.resize(edge.size());
}

}  // namespace lobelia
