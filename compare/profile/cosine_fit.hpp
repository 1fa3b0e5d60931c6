// The power of a cosine that fits a highlight, whatever its lobe is: coefficient * cos(angle)^n fitted to the pixels by
// least squares.
//
// The coefficient is linear, so the best one is known for every n, and only n is searched: the root of the derivative of
// the sum of squares, by Boost.Math's TOMS 748. The error is the square root of n's entry in the covariance matrix of the
// residuals by White's estimate HC3 (MacKinnon, White 1985, "Some heteroskedasticity-consistent covariance matrix
// estimators"). It allows for noise that differs from pixel to pixel, as a picture's noise grows with its radiance. Without
// noise the error tells how far the lobe is from a power of a cosine, not the uncertainty of n. It underestimates noise
// that neighbouring pixels share.
#pragma once

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
  double exponent = 0;        ///< NaN if there is no fit
  double standard_error = 0;  ///< of the exponent
  double coefficient = 0;
  double residual = 0;     ///< root mean square over the brightest fitted value
  std::size_t pixels = 0;  ///< number of fitted pixels
  std::string why_not;     ///< a sentence if there is no fit
};

/// A lobe needs this many pixels above half of its peak to tell its width.
inline constexpr std::size_t kFewestPixelsOfALobe = 9;

/// Searches exponents from 1e-3 to 1e8.
CosineFit fit_cosine_lobe(std::span<const LobeSample> samples);

}  // namespace lobelia
