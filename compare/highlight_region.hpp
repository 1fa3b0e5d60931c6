// Where the highlight is, and the exposures that show it.
#pragma once

#include "compare/metrics/metric.hpp"

namespace lobelia {

/// A pixel is in the highlight if a value of it is at least this share of its picture's brightest value.
inline constexpr double kHighlightShare = 0.05;

/// The darkest light that is not black on an 8-bit sRGB display.
inline constexpr double kDimmestShown = 0.5 / 255 / 12.92;

/// The brightest R, G or B value of each picture; 0 without a positive value.
struct Peaks {
  double a = 0, b = 0;
};
Peaks peaks_of(const Image& a, const Image& b);

/// By pixel, 1 where the pixel is in the highlight of `a` or of `b`, and inside `mask` unless that is empty: so that a
/// highlight that one of them lacks is looked at, and a single bright pixel does not hide the other's highlight. All 0
/// if no value is positive. Finite pictures of one size.
PixelFlags highlight_region(const Image& a, const Image& b, std::span<const std::uint8_t> mask);
PixelFlags highlight_region(const Image& a, const Image& b, const Peaks& peaks,
                            std::span<const std::uint8_t> mask);

/// The region grown by `radius` pixels to all sides.
PixelFlags grown(std::span<const std::uint8_t> region, int width, int radius);

/// Stops from the exposure that shows the peak just below white to the one that shows the tail.
inline constexpr double kTailStops = 6;

/// Whether the brightest value of `a` and `b` would be clipped or not be shown at exposure 0.
bool needs_exposures(const Peaks& peaks);

/// With `viewing.automatic`: several exposures if needs_exposures(), and otherwise exposure 0 alone. At the first, the
/// brightest value is white; at the second 1/64 of it is. A highlight of `b` whose peak is below 1/64 of white at both gets
/// a further exposure that shows its peak, which may show other ones as well.
Viewing with_exposures(Viewing viewing, const Image& a, const Image& b);
Viewing with_exposures(Viewing viewing, const Peaks& peaks, const Image& b,
                       std::span<const LocalHighlight> highlights);

}  // namespace lobelia
