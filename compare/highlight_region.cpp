#include "compare/highlight_region.hpp"

#include <algorithm>
#include <cmath>

#include "core/colour.hpp"
#include "core/image_values.hpp"

namespace lobelia {
namespace {

/// The darkest light that is not black on an 8-bit sRGB display.
constexpr double kDimmestShown = 0.5 / 255 / 12.92;
/// A picture that is so many times brighter than the other has a firefly, which would hide everything else.
constexpr double kFarBrighter = 64;

/// Sets each of `count` values `stride` apart to 1 if one within `radius` of it is not 0.
void grow_line(std::uint8_t* first, std::size_t count, std::size_t stride, std::size_t radius) {
  std::vector<std::uint8_t> line(count);
  std::size_t next = 0;  // values before it have been set
  for (std::size_t i = 0; i < count; ++i) {
    if (first[i * stride] == 0) continue;
    const std::size_t end = std::min(count, i + radius + 1);
    for (next = std::max(next, i > radius ? i - radius : 0); next < end; ++next) line[next] = 1;
  }
  for (std::size_t i = 0; i < count; ++i) first[i * stride] = line[i];
}

}  // namespace

std::vector<std::uint8_t> highlight_region(const Image& a, const Image& b,
                                           std::span<const std::uint8_t> mask) {
  std::vector<std::uint8_t> region(a.pixel_count(), 0);
  for (const Image* image : {&a, &b}) {
    const double least = kHighlightShare * peak_value(*image);
    if (!(least > 0)) continue;
    const std::span<const float> values = image->values();
    in_parts(region.size(), 3 * sizeof(float), [&](std::size_t begin, std::size_t end) {
      for (std::size_t pixel = begin; pixel < end; ++pixel)
        if (double(std::max({values[3 * pixel], values[3 * pixel + 1], values[3 * pixel + 2]})) >=
                least &&
            (mask.empty() || mask[pixel] != 0))
          region[pixel] = 1;
    });
  }
  return region;
}

std::vector<std::uint8_t> grown(std::span<const std::uint8_t> region, int width, int radius) {
  std::vector<std::uint8_t> result(region.begin(), region.end());
  if (radius <= 0 || region.empty()) return result;
  const auto across = std::size_t(width), down = region.size() / across;
  for (std::size_t y = 0; y < down; ++y)
    grow_line(result.data() + y * across, across, 1, std::size_t(radius));
  for (std::size_t x = 0; x < across; ++x)
    grow_line(result.data() + x, down, across, std::size_t(radius));
  return result;
}

Viewing with_exposures(Viewing viewing, const Image& a, const Image& b) {
  if (!viewing.automatic) return viewing;
  const auto [least, most] = std::minmax({peak_value(a), peak_value(b)});
  const double peak = least > 0 && most > kFarBrighter * least ? least : most;
  viewing.exposure_stops = 0;
  viewing.tail_stops.reset();
  if (!(peak > 0) || (peak <= 1 && peak >= kDimmestShown)) return viewing;
  viewing.exposure_stops =
      std::clamp(exposure_for_peak(peak), -kMaxExposureStops, kMaxExposureStops - kTailStops);
  viewing.tail_stops = viewing.exposure_stops + kTailStops;
  return viewing;
}

}  // namespace lobelia
