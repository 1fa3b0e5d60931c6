// How a blob falls off from its peak: an elliptical Gaussian or a GGX tail, over a level background, by least squares.
//
// Families:     with q the square of the distance in half-widths, 2^-q, which is also what a high power of a cosine looks
//               like, and (1 + (sqrt 2 - 1) q)^-2, which is Trowbridge and Reitz's distribution over a plane.
// Clipped:      a pixel at the file's maximum is at least so bright: it has a residual only where the curve is below it.
// Method:       Levenberg and Marquardt; seven unknowns. The ellipse is a Cholesky factor, so that it stays one.
// Error:        the covariance through the pixels' standard errors; what the family misses adds to it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "profile/peak.hpp"

namespace lobelia {

/// Named by records::kFalloffs.
enum class Falloff { kGaussian, kGgx };

using records::Estimate;

struct FalloffFit {
  Falloff family{};
  Estimate peak, major_half_width, minor_half_width;  ///< over the background; pixels
  FilmPoint place;
  /// In half-widths from the place, s = shape[0] dx + shape[1] dy and t = shape[2] dy.
  std::array<double, 3> shape{};
  double residual = 0;  ///< root mean square over the peak
  std::size_t pixels = 0;
  std::string why_not;  ///< a sentence if there is no fit; then the figures are NaN
};

/// The fitted curve at a place, over its level.
double value_at(const FalloffFit& fit, FilmPoint place);

/// Both families, the better one first. `rough` says where to look; pixels within `reach` of its semi-axes are fitted.
/// `clipped` and `error` have an entry for each pixel.
std::vector<FalloffFit> fit_falloff(const Field& above, const Axes& rough, double reach,
                                    const std::vector<bool>& clipped,
                                    std::span<const double> error);

}  // namespace lobelia
