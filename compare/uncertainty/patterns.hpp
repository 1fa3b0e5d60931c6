// Differences of the usual kinds, summed over the whole picture.
//
// Source:       the score test of C. R. Rao, "Large Sample Tests of Statistical Hypotheses Concerning Several Parameters with
//               Applications to Problems of Estimation", Proc. Cambridge Philosophical Society 44, 1948; in signal
//               processing the matched filter.
// Formula:      sum of w (a - b) over all values. With e the picture that both would be draws of (noise_draws.hpp) the weights
//               are e itself (brighter), its derivatives by x and y (moved), and (p - c) . grad e (wider), where p is the
//               place and c the centre of e squared. Light is where the signal is, and little of the noise.
// Noise:        of each pixel the variance of its weighted sum over the channels: so it counts how they err together. Of standard
//               errors alone the channels count as erring together, which is the upper bound.
// Fireflies:    noise with heavy tails hides all of these. If both pictures have as many replicates and, within chance, as
//               many fireflies, a - b is as often above as below zero, however heavy the tails. So it is clipped at
//               three times the median of its size around (P. J. Huber, "Robust Estimation of a Location Parameter", Annals
//               of Mathematical Statistics 35, 1964), and the noise of the sum is the root of its squares (the test of
//               signs). e is the mean of both there, of which each value is the median of 5 x 5.
// Assumes:      of fireflies, that both pictures are of one process. e tells nothing of the sign of a - b. The errors of a
//               mean weighted by variances and of the difference are uncorrelated, and a derivative leaves out the pixel
//               itself.
#pragma once

#include <array>
#include <functional>

#include "compare/uncertainty/z_test.hpp"

namespace lobelia {

/// A sum of differences, and what is known of its noise.
struct NoisySum {
  double excess = 0;
  double cautious = 0, cautious_squares = 0;  ///< variance; sum of variance^2 / freedom
  double own = 0, own_squares = 0;            ///< of the replicates alone
  double shared_a = 0, shared_b = 0;          ///< standard errors of values that err together

  void operator+=(const NoisySum& other);
};

inline constexpr std::size_t kPatterns = 4;

/// Brighter, moved right, moved down, wider. `excess` is a - b of a value, less what is allowed.
std::array<NoisySum, kPatterns> sums_of_patterns(const Image& a, const Image& b,
                                                 const NoiseOfPair& noise,
                                                 const std::function<double(std::size_t)>& excess);

}  // namespace lobelia
