// The noise of a highlight's pixels, and figures measured again with it.
#pragma once

#include <functional>
#include <span>

#include "profile/noise.hpp"
#include "profile/peak.hpp"

namespace lobelia {

/// Standard errors of the mean of R, G and B. The channels of a pixel share their noise under white light, so the errors
/// add up.
Field radiance_errors(const PictureNoise& noise);

/// The noise of the mean of R, G and B, by how the picture and independent others of the same thing scatter. The picture
/// becomes the mean of all.
PictureNoise noise_of_replicates(Image& image, std::vector<Image> others);

struct PixelNoise {
  std::vector<double> error;  ///< of each pixel, independent from pixel to pixel
  bool shared = false;        ///< or else all with the same sign
  /// Texture beneath: a deviation that neighbouring pixels share, over squares of so many pixels.
  double texture = 0;
  int grain = 1;
  /// A deviation of these pixels together: what the background as a whole is not known to.
  double level = 0;
  std::vector<std::size_t> ring;
};

/// Root mean squares of how far figures of fields with so much more noise are from those of the field (parametric
/// bootstrap, as compare/uncertainty/error_bars.hpp has it). So what noise adds to a figure counts, such as to the
/// brightest pixel. Where noise is shared, the larger one of independent and of equal noise. `measure` fills the figures
/// of a field; it is called from several threads. A figure that is NaN in more than a fifth of the fields has no error.
std::vector<double> bootstrap_errors(
    const Field& field, const PixelNoise& noise, std::size_t figures, std::uint64_t seed,
    const std::function<void(const Field&, std::span<double>)>& measure);

}  // namespace lobelia
