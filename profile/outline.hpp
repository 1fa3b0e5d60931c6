// Peak and half-widths of a highlight over its background, with or without noise.
//
// Without noise they are read from the pixels: locate_peak() and distance_to_level(). With noise the brightest pixel is
// too bright, and the first one below half too near. Then they are read from a local polynomial of degree 4 over an
// elliptical window, which a highlight's own shape changes by 0.3 % of the peak at most where the window reaches to half
// of it. The window is smaller the less noise there is, so that its error stays below that of the noise.
#pragma once

#include <array>
#include <optional>

#include "profile/peak.hpp"

namespace lobelia {

/// A rough outline, to look near: the axes of the pixels above half of the peak. Semi-axes are 2 sigma.
struct Outline {
  Peak peak;
  /// From the peak to where the highlight first falls to half, pixels: along a direction, against it, across it to the
  /// right (on the film) and to the left. NaN if a hole or the border comes first.
  std::array<double, 4> reach{};
  double half_width(int axis) const {
    return (reach[std::size_t(2 * axis)] + reach[std::size_t(2 * axis + 1)]) / 2;
  }
};

/// Whether a highlight is read from a smoothed surface: its noise, a share of the peak, is more than rounding, and it is
/// large enough.
bool is_smoothed(const Axes& rough, double noise);

/// `noise` is the standard error of a pixel as a share of the peak; 0 for none. `brightest` is a pixel as locate_peak()
/// takes it, for a highlight without noise or too small for a window.
Outline trace_outline(const Field& above, const Axes& rough, FilmPoint along, double noise,
                      std::size_t brightest);

/// The direction of `reach[k]`.
FilmPoint outline_direction(FilmPoint along, int k);

/// Repeated means over 3 x 3 pixels with the weights 1 2 1 across and down; holes stay.
Field softened(Field field, int passes);
/// Enough passes to make noise of that share of the peak harmless for finding its half.
int passes_for(double noise);

/// The noise of pixels, by the root mean square of the sixth differences through each of them to the right and down, which
/// a smooth highlight does not have. NaN if there are too few.
double scatter_of(const Field& field, const std::vector<std::size_t>& pixels);

}  // namespace lobelia
