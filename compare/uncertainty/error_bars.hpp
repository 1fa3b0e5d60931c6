// How far noise moves each figure of a comparison.
//
// Source:       parametric bootstrap: B. Efron, R. Tibshirani, "An Introduction to the Bootstrap", 1993, chapter
//               6.5. The pictures get more normal noise with their own standard errors, `count` times, from a
//               seed, independently for each value. How pixels err together is not known. For such pictures
//               all is repeated with one number for all values of a picture, and the worse result counts.
// Formula:      standard_error is the spread of the figure over pairs (a + noise, b + noise). The noise floor is
//               the figure over pairs (b + noise of a, b + noise of b), which have one expectation.
//               noise_floor is its mean. 97.5 % of the pairs do not exceed noise_floor_most (for a
//               similarity: are not below it).
// Interval:     [low, high] holds the figure of the expectations, which endless samples would give, with a
//               probability of 95 %. Noise increases most errors, so the figure is not in the middle. high is
//               the figure plus 97.5 % of its spread. low is the figure less 97.5 % of the noise floor, as an
//               error is a distance: d(a, b) <= d(a, A) + d(A, B) + d(B, b). The roots of squares (MSE,
//               1 - SSIM) are distances, as are the ratios of errors behind decibels. drift has no floor: its
//               interval is the figure and 97.5 % of its spread to either side.
// Exact for:    norms: mae, rmse, mse, max_abs, psnr. The others are nearly norms;
//               tests/compare/uncertainty_test.cpp measures their coverage.
// Factor:       97.5 % is Student's t for count - 1 degrees of freedom times sqrt(1 + 1 / count), the bound of
//               another draw. If pixels err together, the noise may have fewer degrees of freedom; they apply.
#pragma once

#include <cmath>

#include "compare/metrics/metric.hpp"
#include "compare/uncertainty/noise.hpp"
#include "records/comparison.hpp"

namespace lobelia {

using ErrorBar = records::ErrorBar;
/// By id, in the order of the metrics.
using ErrorBars = records::Named<ErrorBar>;

inline constexpr int kFewestBootstraps = 4, kMostBootstraps = 1000;

/// Error bars of all figures of the listed metrics that are neither facts nor about noise, for an input with noise.
/// `count` is from kFewestBootstraps to kMostBootstraps. Holds two more pictures. Takes 2 * count times as long as the
/// metrics, twice that if pixels err together.
ErrorBars error_bars(std::span<const Metric* const> list, const MetricInput& input,
                     const Viewing& viewing, int count, std::uint64_t seed);

/// A figure as a distance, see above, and back. A signed error stays as it is.
double as_distance(const MetricOutput& output, double value);
double from_distance(const MetricOutput& output, double distance);

/// Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators": splitmix64's output function.
constexpr std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Number `index` of a stream, of mean 0 and variance 1 (Box and Muller 1958). Without state, so that the number of
/// threads does not matter.
inline double gaussian(std::uint64_t stream, std::uint64_t index) {
  const std::uint64_t bits = mix(mix(stream) ^ index);
  const double u = (double(bits >> 32) + 0.5) * 0x1p-32, v = double(bits & 0xffffffffu) * 0x1p-32;
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

}  // namespace lobelia
