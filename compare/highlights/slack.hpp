// How far the figures of a highlight may be off although nothing differs.
//
// Formula:      kSlack standard errors of each figure. The error of a pixel is the known noise, or what the reference's own
//               roughness tells: fourth differences around the highlight, and where its core has pixels enough, within,
//               which smooth light hardly has. Two pictures may be as rough.
//               Rounding of stored values is added; it may be the same in all pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/highlights/find.hpp"

namespace lobelia {

/// Standard errors. More than the chance of one highlight asks for: a picture may have a hundred, and the errors themselves
/// are estimates.
inline constexpr double kSlack = 5;

/// Whether the highlight stands out: its height is six errors of a pixel, and its energy is known to a seventh. Else the
/// maximum of noise may have chosen its pixels. `peak`: the reference's brightest radiance.
bool add_slack(const Image& reference, const HighlightNoise& noise, double peak,
               LocalHighlight& highlight);

/// visit(pixel, x, y) for each pixel of the runs.
template <class Visit>
void for_pixels(std::span<const PixelRun> runs, int width, Visit visit) {
  for (const PixelRun& run : runs)
    for (int x = run.x; x < run.end; ++x)
      visit(std::size_t(run.y) * std::size_t(width) + std::size_t(x), x, run.y);
}

inline double squared_distance(const LocalHighlight& highlight, int x, int y) {
  const double dx = x - highlight.centre_x, dy = y - highlight.centre_y;
  return dx * dx + dy * dy;
}

/// visit(pixel, x, y) for at most about 2000 pixels at 1.3 to 2.5 of the highlight's radius from its centre.
template <class Visit>
void for_pixels_around(const Image& image, const LocalHighlight& highlight, Visit visit) {
  constexpr double kFrom = 1.3, kTo = 2.5, kMargin = 4, kMost = 2000;
  const double radius = std::sqrt(double(highlight.count) / std::numbers::pi);
  const double from = kFrom * radius, to = kTo * radius + kMargin;
  const int x0 = std::max(0, int(highlight.centre_x - to)),
            y0 = std::max(0, int(highlight.centre_y - to)),
            x1 = std::min(image.width() - 1, int(highlight.centre_x + to)),
            y1 = std::min(image.height() - 1, int(highlight.centre_y + to));
  const int step = std::max(1, int(std::ceil(2 * to / std::sqrt(kMost))));
  for (int y = y0; y <= y1; y += step)
    for (int x = x0; x <= x1; x += step)
      if (const double away = squared_distance(highlight, x, y);
          away >= from * from && away <= to * to)
        visit(std::size_t(y) * std::size_t(image.width()) + std::size_t(x), x, y);
}

}  // namespace lobelia
