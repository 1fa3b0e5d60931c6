// How far noise moves each figure of a comparison.
//
// Source:       bootstrap: B. Efron, R. Tibshirani, "An Introduction to the Bootstrap", 1993, chapter 6.5. The pictures
//               get more noise, `count` times, from a seed (noise_draws.hpp). What errs together may not be known: then
//               all is repeated for each possibility, and the worst result counts.
// Formula:      standard_error is the spread of the figure over pairs (a + noise, b + noise). The noise floor is the
//               figure over pairs (e + noise of a, e + noise of b) around the expectation e that both pictures would have
//               if they were equal. noise_floor is its mean. 97.5 % of the pairs do not exceed noise_floor_most (for a
//               similarity: are not below it).
// Interval:     [low, high] holds the figure of the expectations, which endless samples would give, with a
//               probability of 95 %. Noise increases most errors, so the figure is not in the middle. high is
//               the figure plus 97.5 % of its spread. low is the figure less 97.5 % of the noise floor, as an
//               error is a distance: d(a, b) <= d(a, A) + d(A, B) + d(B, b). The roots of squares (MSE,
//               1 - SSIM) are distances, as are the ratios of errors behind decibels. A signed figure, as drift, has no
//               floor but a bias, the mean of the pairs around e: its interval is the figure less the bias, and 97.5 %
//               of the larger of both spreads to either side.
//               The floor is known to kFloorBias.
// Largest:      the largest of single differences (max_abs, max_rel_peak) is moved by the tail of the noise, which few
//               replicates do not tell. Its low is the largest of |a - b| - c * error over the values, by the cautious
//               errors (noise.hpp) and the c that all values together exceed in so many pairs. So a firefly that a
//               replicate has is no difference.
// Heavy tails:  noise with fireflies, turned into dark spots by a draw, hardly shows on a dark surface, so its floor
//               would be
//               too low. Such a floor is not known: low is 0, but for signed figures and the largest of differences.
// Exact for:    norms: mae, rmse, mse, max_abs, psnr. The others are nearly norms;
//               tests/compare/uncertainty_test.cpp measures their coverage, and `lobelia verify verdicts` the verdicts.
// Factor:       97.5 % is Student's t times sqrt(1 + 1 / count), the bound of another draw. Its degrees of freedom are
//               those of `count` draws and of the noise together, as the variances of two means add up: f noisy pixels
//               with few replicates know their noise no better than f numbers. The few brightest pixels of a highlight,
//               or a few fireflies, count as few pixels (F. E. Satterthwaite, "An Approximate Distribution of Estimates
//               of Variance Components", Biometrics Bulletin 2, 1946). A floor is itself a sum of errors from n
//               replicates, and as uncertain as the figure times 1 / (n - 1): its factor has that under the root, too.
#pragma once

#include <cmath>
#include <memory>

#include "base/records/comparison.hpp"
#include "compare/metrics/metric.hpp"
#include "compare/uncertainty/noise_draws.hpp"

namespace lobelia {

using ErrorBar = records::ErrorBar;
/// By id, in the order of the metrics.
using ErrorBars = records::Named<ErrorBar>;

inline constexpr int kFewestBootstraps = 4, kMostBootstraps = 1000;
/// The chance of a figure beyond one end of its error bar.
inline constexpr double kBeyondOneEnd = 0.025;
/// How far a noise floor may be off, as a share: draws around a smoothed picture miss up to 3 % of CIEDE2000 around black.
inline constexpr double kFloorBias = 0.05;

struct DrawOptions {
  int count = 32;  ///< of pairs of each kind, from kFewestBootstraps to kMostBootstraps
  std::uint64_t seed = 0;
  std::span<const std::uint8_t> surfaces =
      {};  ///< where the highlight of a draw may lie, as in ComparisonOptions
};

/// All figures of the listed metrics that are neither facts nor about noise, under noise.
class NoisyFigures {
 public:
  /// Measures the draws of an input with noise, which has to outlive this. Holds three more pictures. Takes 2 * count
  /// times as long as the metrics, times the possibilities of what_may_err_together().
  NoisyFigures(std::span<const Metric* const> list, const MetricInput& input,
               const Viewing& viewing, const DrawOptions& options);
  ~NoisyFigures();

  /// The error bars of 95 %.
  ErrorBars bars() const;
  /// Those for limits: of equal pictures, a bar excludes 0 with this chance, in (0, 0.5]. A signed figure may be beyond
  /// either side. The other end, towards larger errors, is that of bars().
  ErrorBars bars_of_limits(double significance) const;

 private:
  struct Figures;
  std::unique_ptr<Figures> figures_;
};

/// A figure as a distance, see above, and back. A signed error stays as it is.
double as_distance(const MetricOutput& output, double value);
double from_distance(const MetricOutput& output, double distance);

}  // namespace lobelia
