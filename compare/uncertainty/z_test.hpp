// Whether two pictures differ by more than their noise, in any pixel or any region.
//
// Source:       W. S. Gosset's t with the degrees of freedom of B. L. Welch, "The Generalization of 'Student's'
//               Problem when Several Different Population Variances are Involved", Biometrika 34, 1947;
//               Sidak's correction (critical.hpp).
// Formula:      of each R, G and B value t = excess / error: excess is a - b with its sign, less what the
//               tolerance allows (nothing without one), error the root of the sum of both pictures' cautious
//               variances (noise.hpp). z is the normal number that is as rare as t. The same of the sums over
//               regions, squares of 2, 4, 8, ... pixels up to the whole picture: a drift that is nowhere seen
//               in a pixel is seen in their sum. The variance of a sum is the sum of variances; where
//               pixels err together, the square of the sum of errors, which is the most that it can be.
// Level:        Sidak's over all values of all sizes, m of them: about four thirds of the picture's values.
// No noise:     where neither picture has any, equal values have z = 0 and others an infinite one.
// Outliers:     pixels found by themselves, if the tolerance allows as many, are left out of the regions.
#pragma once

#include <cstdint>

#include "compare/metrics/metric.hpp"
#include "compare/uncertainty/noise.hpp"

namespace lobelia {

/// The noise of the two pictures of a comparison; null for a picture without noise.
struct NoiseOfPair {
  const PictureNoise* a = nullptr;
  const PictureNoise* b = nullptr;
  double significance = 0.01;  ///< chance of finding a difference where there is none
};
inline constexpr double kLeastSignificance = 1e-12, kMostSignificance = 0.5;

struct ZTest {
  double largest = 0;  ///< |z| of all values of pixels and regions
  int x = 0, y = 0,
      size = 0;         ///< where: the upper left pixel, and pixels a side; 0 if nothing differs
  double critical = 0;  ///< a |z| above is no chance
  std::int64_t beyond = 0;    ///< pixels with such a value
  std::int64_t off_edge = 0;  ///< of these, off the edges that the tolerance names
  std::int64_t regions = 0;   ///< regions with such a value
  /// Pixels that are not sure to lie within the tolerance: |a - b| and as much error as would be no
  /// chance are together more than it allows.
  std::int64_t open = 0;
};

/// Values of pixels and of regions of a picture of that size.
double count_of_tests(int width, int height);

/// Tests an input with noise.
ZTest z_test(const MetricInput& input);

}  // namespace lobelia
