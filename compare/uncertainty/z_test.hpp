// Tests whether two pictures differ by more than their noise, in any pixel or any region.
//
// Source:       W. S. Gosset's t with the degrees of freedom of B. L. Welch, "The Generalization of 'Student's'
//               Problem when Several Different Population Variances are Involved", Biometrika 34, 1947;
//               Sidak's correction (critical.hpp).
// Formula:      for each R, G and B value t = excess / error. excess is a - b with its sign, less the
//               tolerance, if there is one. error is the root of the sum of both pictures' cautious
//               variances (noise.hpp). z is the normal number that is as rare as t. Likewise for sums over
//               regions, squares of 2, 4, 8, ... pixels up to the whole picture: a drift that no pixel shows
//               is visible in their sum. The variance of a sum is the sum of variances; if pixels err
//               together, the square of the sum of errors, which is its upper bound.
// Errors:       the cautious ones of small squares. From 8 pixels a side on, a sum of the replicates' own variances is known
//               well enough: it counts if it has 16 degrees of freedom (Satterthwaite's). Under heavy tails that of a
//               region is halfway to the cautious one, if that is larger.
// Patterns:     sums weighted by what a brighter, moved or wider picture would change (patterns.hpp).
// Level:        each size has an equal part of it, as has each pattern, and its tests share that part; all by Sidak. So the
//               few sums over large squares need not be as rare as one of all values. The z of one is that of a
//               single value as rare among those, and z.critical is theirs.
// No noise:     equal values have z = 0, others an infinite z.
// Outliers:     pixels beyond the noise are excluded from regions, if the tolerance allows as many.
#pragma once

#include "compare/metrics/metric.hpp"
#include "profile/noise.hpp"

namespace lobelia {

/// The noise of the two pictures of a comparison; null for a picture without noise.
struct NoiseOfPair {
  const PictureNoise* a = nullptr;
  const PictureNoise* b = nullptr;
  double significance = 0.01;  ///< chance of finding a difference where there is none
};
inline constexpr double kLeastSignificance = 1e-12, kMostSignificance = 0.5;

/// The cautious error of a - b in one value, and Welch's degrees of freedom.
struct ValueError {
  double size = 0, freedom = 0;
};
ValueError error_of_difference(const NoiseOfPair& noise, std::size_t value);

struct ZTest {
  double largest = 0;         ///< |z| of all values of pixels and regions
  int x = 0, y = 0;           ///< its upper left pixel
  int size = 0;               ///< its pixels a side; 0 if nothing differs
  double critical = 0;        ///< a |z| above it is not chance
  std::int64_t beyond = 0;    ///< pixels with such a value
  std::int64_t off_edge = 0;  ///< of these, off the tolerance's edges
  std::int64_t regions = 0;   ///< regions and patterns with such a value
  /// Pixels not certain to lie within the tolerance: |a - b| plus the critical error exceeds it.
  std::int64_t open = 0;
};

/// The number of values of pixels and regions of a picture of this size, and of patterns.
double count_of_tests(int width, int height);
/// The level of the test of each pixel's value.
double level_of_single_values(int width, int height, double significance);

/// Tests an input with noise.
ZTest z_test(const MetricInput& input);

}  // namespace lobelia
