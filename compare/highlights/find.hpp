// The highlights of a reference, each by itself: however bright a light in view is, those beside it are found.
//
// Source:       ours, on the tree of a picture's maxima: P. Salembier, A. Oliveras, L. Garrido, "Antiextensive connected
//               operators for image and sequence processing", 1998.
// Formula:      from each maximum downward, the connected pixels above a level are counted. Where their number grows
//               four times while the level hardly falls, there is the maximum's base: the light of its surroundings.
//               Without such a level the base is the saddle to a higher maximum, or 0. Below a base the search goes on:
//               a broad highlight may carry a narrow one. Height is peak less base; of a broad one, the narrow
//               one's base takes the place of the peak.
//               pixels  those that connect to the peak above base + kSkirt * height
//               core    those of them above base + height / 2
//               ring    some of those beyond, between 1.3 and 2.5 of their radius, within height / 4 of the base
// Kept:         a highlight of at least kFewestPixelsOfOne pixels whose height is a quarter of its own peak, and that
//               stands out
//               from noise and roughness (slack.hpp). No threshold depends on the brightest pixel, but for one on light
//               that no exposure would show.
// Work:         bounded: a large picture is first reduced to the largest values of squares, 2^20 at the most. At most
//               kMostHighlights are kept, those with the most light.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "base/pictures/image.hpp"
#include "base/pictures/pixel_flags.hpp"

namespace lobelia {

struct NoiseOfPair;  // compare/uncertainty/z_test.hpp

inline constexpr std::size_t kMostHighlights = 128;
/// A smaller one is a firefly, or a matter of the pixel filter.
inline constexpr std::size_t kFewestPixelsOfOne = 9;

/// Pixels x to end - 1 of a row.
struct PixelRun {
  int y = 0, x = 0, end = 0;
};

/// Radiance is the mean of R, G and B. Places are in pixels; the middle of the first pixel is (0, 0).
struct LocalHighlight {
  int x = 0, y = 0;        ///< the brightest pixel
  bool only_in_a = false;  ///< of the judged picture; see add_highlights_of_a()
  double peak = 0, base = 0;
  double top = 0;    ///< below `peak` if a narrower highlight lies on this one, which begins there
  double skirt = 0;  ///< the level that bounds `pixels`
  std::vector<PixelRun> pixels, core;
  std::vector<std::uint32_t> ring;    ///< pixels around it, with light near the base
  std::size_t count = 0;              ///< of pixels
  double centre_x = 0, centre_y = 0;  ///< of the radiance over the skirt
  /// Errors are divided by these sums (judge.hpp): the radiance of the core, the radiance of all pixels, and that times the
  /// squared distance from the centre.
  double energy = 0, light = 0, spread = 0;
  /// How far noise, rounding and the roughness of the picture may move the three figures.
  double energy_slack = 0, width_slack = 0, shift_slack = 0;

  double height() const { return top - base; }
};

/// Causes other than a real difference that may change the figures of a highlight.
struct HighlightNoise {
  const NoiseOfPair* known = nullptr;
  double rounding = 0;  ///< ComparisonOptions::rounding
};

/// The ones with the most light first. Nothing outside of `where` is looked at, unless that is empty. Finite values.
std::vector<LocalHighlight> find_highlights(const Image& reference,
                                            std::span<const std::uint8_t> where = {},
                                            const HighlightNoise& noise = {});

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
