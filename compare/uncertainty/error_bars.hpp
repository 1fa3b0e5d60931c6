// How far each figure of a comparison is moved by the noise of the pictures.
//
// Source:       parametric bootstrap: B. Efron, R. Tibshirani, "An Introduction to the Bootstrap", 1993, chapter
//               6.5. The pictures get normal noise of their own standard errors once more, `count` times, from a
//               seed, each value by itself. Where pixels err together it is not known how: it is done again with
//               one number for all values of a picture, and of each result the worse of the two is taken.
// Formula:      standard_error is the spread of the figure over pairs (a + noise, b + noise). The noise floor is
//               the figure over pairs (b + noise of a, b + noise of b): what two pictures of one expectation
//               show; noise_floor is its mean and noise_floor_most what 97.5 % of them do not exceed (of a
//               likeness, the least).
// Interval:     [low, high] is to hold the figure of the expectations, which endless samples would give,
//               with 95 %. Noise makes most errors larger, so that a figure is not in the middle of it:
//               high is the figure and 97.5 % of its spread; low is the figure without 97.5 % of the noise
//               floor, because an error is a distance: d(a, b) <= d(a, A) + d(A, B) + d(B, b). Of squares
//               (MSE, 1 - SSIM) the roots are distances, of decibels the ratios of errors. drift has no
//               floor to lose: it is the figure and 97.5 % of its spread to either side.
// Exact for:    what is a norm: mae, rmse, mse, max_abs, psnr. For the others, which are near to one, it is
//               what tests/compare/uncertainty_test.cpp finds of their coverage.
// Factor:       97.5 % is Student's t for count - 1 degrees of freedom times sqrt(1 + 1 / count), the bound of
//               another draw; fewer degrees where the noise of whole pictures is known from fewer.
#pragma once

#include <cstdint>

#include "compare/metrics/metric.hpp"
#include "compare/uncertainty/noise.hpp"
#include "records/comparison.hpp"

namespace lobelia {

using ErrorBar = records::ErrorBar;
/// By the id of the figure, in the order of the metrics.
using ErrorBars = records::Named<ErrorBar>;

inline constexpr int kFewestBootstraps = 4, kMostBootstraps = 1000;

/// Error bars of all figures that are neither facts nor about noise, for an input with noise.
/// `count` as in kFewestBootstraps to kMostBootstraps. Holds two more pictures, and takes 2 * count
/// times what the metrics take, twice that where pixels err together.
ErrorBars error_bars(const MetricInput& input, const Viewing& viewing, int count,
                     std::uint64_t seed);

/// A figure as a distance, see above, and back; of signed errors themselves.
double as_distance(const MetricOutput& output, double value);
double from_distance(const MetricOutput& output, double distance);

}  // namespace lobelia
