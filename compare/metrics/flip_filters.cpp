// Source, agreement and the reason for float: see flip_ldr.cpp. Section numbers refer to Andersson et al.; the
// separation into rows and columns follows the tool's note "separatedConvolutions".
#include <cmath>
#include <numeric>

#include "compare/metrics/flip_error.hpp"

namespace lobelia {
namespace {

constexpr float kPi = 3.14159265358979f;
constexpr float kPiSquared = kPi * kPi;

// Section 4.1.1, Table 1: the contrast sensitivity functions as Gaussians a sqrt(pi/b) exp(-pi^2 x^2 / b), x in
// degrees. Blue-yellow is the sum of two. The others are normalised, which cancels their a.
constexpr float kLuminanceB = 0.0047f;
constexpr float kRedGreenB = 0.0053f;
constexpr float kBlueYellowA1 = 34.1f, kBlueYellowB1 = 0.04f;
constexpr float kBlueYellowA2 = 13.5f, kBlueYellowB2 = 0.025f;
constexpr float kWidestB = kBlueYellowB1;

// Section 4.2.1: width in degrees of features that attract the eye.
constexpr float kFeatureWidth = 0.082f;

// Both kinds of filter end three standard deviations out.
constexpr float kFilterSigmas = 3.0f;

float contrast_gaussian(float degrees_squared, float a, float b) {
  return a * std::sqrt(kPi / b) * std::exp(-kPiSquared * degrees_squared / b);
}

/// With the root of the amplitude: a plane is multiplied by it once in each direction.
float contrast_gaussian_root(float degrees_squared, float a, float b) {
  return std::sqrt(a * std::sqrt(kPi / b)) * std::exp(-kPiSquared * degrees_squared / b);
}

float sum_of(const std::vector<float>& taps) {
  return std::accumulate(taps.begin(), taps.end(), 0.0f);
}

void scale(std::vector<float>& taps, float factor) {
  for (float& tap : taps) tap *= factor;
}

/// Positive taps sum to 1 and negative ones to -1: a flat picture has no features.
void balance(std::vector<float>& taps) {
  float positive = 0, negative = 0;
  for (const float tap : taps) (tap > 0 ? positive : negative) += std::abs(tap);
  for (float& tap : taps) tap /= tap > 0 ? positive : negative;
}

}  // namespace

FlipFilters::FlipFilters(float pixels_per_degree) {
  contrast_radius =
      int(std::ceil(kFilterSigmas * std::sqrt(kWidestB / (2.0f * kPiSquared)) * pixels_per_degree));
  const float step = 1.0f / pixels_per_degree;
  for (int i = -contrast_radius; i <= contrast_radius; ++i) {
    const float x = float(i) * step, x2 = x * x;
    luminance.push_back(contrast_gaussian(x2, 1, kLuminanceB));
    red_green.push_back(contrast_gaussian(x2, 1, kRedGreenB));
    blue_yellow_1.push_back(contrast_gaussian_root(x2, kBlueYellowA1, kBlueYellowB1));
    blue_yellow_2.push_back(contrast_gaussian_root(x2, kBlueYellowA2, kBlueYellowB2));
  }
  scale(luminance, 1.0f / sum_of(luminance));
  scale(red_green, 1.0f / sum_of(red_green));
  // The two planes are added after both directions; all their taps together must sum to 1.
  const float sum_1 = sum_of(blue_yellow_1), sum_2 = sum_of(blue_yellow_2);
  const float norm = 1.0f / std::sqrt(sum_1 * sum_1 + sum_2 * sum_2);
  scale(blue_yellow_1, norm);
  scale(blue_yellow_2, norm);

  const float sigma = 0.5f * kFeatureWidth * pixels_per_degree;
  feature_radius = int(std::ceil(kFilterSigmas * sigma));
  for (int i = -feature_radius; i <= feature_radius; ++i) {
    const float x = float(i), g = std::exp(-(x * x) / (2.0f * sigma * sigma));
    gaussian.push_back(g);
    edge.push_back(-x * g);
    point.push_back((x * x / (sigma * sigma) - 1.0f) * g);
  }
  const float sum = sum_of(gaussian);
  for (float& tap : gaussian) tap /= sum;
  balance(edge);
  balance(point);
}

}  // namespace lobelia
