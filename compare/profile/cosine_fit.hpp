// Which power of a cosine a highlight looks like, whatever its lobe is: coefficient * cos(angle)^n fitted to the
// pixels by least squares.
//
// The coefficient enters linearly, so at every n the best one is known and n alone is searched for: the root of
// the derivative of the sum of squares, by Boost.Math's TOMS 748. The error is the square root of n's entry in
// the covariance matrix of the residuals by White's estimate that allows for noise that differs from pixel to
// pixel, HC3 (MacKinnon, White 1985, "Some heteroskedasticity-consistent covariance matrix estimators"): noise
// of a picture grows with its radiance. Of a picture without noise it says by how much the lobe is no power
// of a cosine, not how uncertain n is; noise that neighbouring pixels share it underestimates.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace lobelia {

/// A pixel of a highlight: its radiance is scale * coefficient * lobe(angle).
struct LobeSample {
  double angle;  ///< radians, 0 to pi/2
  double scale;
  double radiance;
};

struct CosineFit {
  double exponent = 0;        ///< NaN where there is no fit
  double standard_error = 0;  ///< of the exponent
  double coefficient = 0;
  double residual = 0;     ///< root mean square over the brightest fitted value
  std::size_t pixels = 0;  ///< that were fitted to
  std::string why_not;     ///< a sentence where there is no fit
};

/// Above half of its peak a lobe must have as many, or they are too few to tell its width.
inline constexpr std::size_t kFewestPixelsOfALobe = 9;

/// Exponents from 1e-3 to 1e8.
CosineFit fit_cosine_lobe(std::span<const LobeSample> samples);

}  // namespace lobelia
