#include "compare/highlight_region.hpp"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_values.hpp"
#include "compare/highlights/find.hpp"

namespace lobelia {
namespace {

/// A picture that is so many times brighter than the other has a firefly, which would hide everything else.
constexpr double kFarBrighter = 64;

/// Sets out[i] to 1 where a value within `radius` of row[i] is not 0.
void grow_row(std::span<const std::uint8_t> row, std::size_t radius, std::uint8_t* out) {
  std::size_t next = 0;  // values before it have been set
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] == 0) continue;
    const std::size_t end = std::min(row.size(), i + radius + 1);
    for (next = std::max(next, i > radius ? i - radius : 0); next < end; ++next) out[next] = 1;
  }
}

/// The peak that the first exposure shows.
double exposed_peak(const Peaks& peaks) {
  const auto [least, most] = std::minmax({peaks.a, peaks.b});
  return least > 0 && most > kFarBrighter * least ? least : most;
}

}  // namespace

Peaks peaks_of(const Image& a, const Image& b) {
  Peaks peaks;
  oneapi::tbb::parallel_invoke([&] { peaks.a = peak_value(a); }, [&] { peaks.b = peak_value(b); });
  return peaks;
}

PixelFlags highlight_region(const Image& a, const Image& b, std::span<const std::uint8_t> mask) {
  return highlight_region(a, b, peaks_of(a, b), mask);
}

PixelFlags highlight_region(const Image& a, const Image& b, const Peaks& peaks,
                            std::span<const std::uint8_t> mask) {
  PixelFlags region(a.pixel_count());
  const auto width = std::size_t(a.width());
  for (const auto& [image, peak] : {std::pair(&a, peaks.a), {&b, peaks.b}}) {
    const double least = kHighlightShare * peak;
    if (!(least > 0)) continue;
    const std::span<const float> values = image->values();
    oneapi::tbb::parallel_for(0, a.height(), [&](int y) {
      for (std::size_t pixel = width * std::size_t(y), end = pixel + width; pixel < end; ++pixel)
        if (double(std::max({values[3 * pixel], values[3 * pixel + 1], values[3 * pixel + 2]})) >=
                least &&
            (mask.empty() || mask[pixel] != 0))
          region[pixel] = 1;
      looked_at((3 * sizeof(float) + 1) * width);
    });
  }
  return region;
}

PixelFlags grown(std::span<const std::uint8_t> region, int width, int radius) {
  if (radius <= 0 || region.empty()) return {region.begin(), region.end()};
  const auto across = std::size_t(width);
  const int down = int(region.size() / across);
  PixelFlags rows(region.size()), result(region.size());
  const auto row_of = [across](auto& pixels, int y) {
    return pixels.data() + across * std::size_t(y);
  };
  oneapi::tbb::parallel_for(0, down, [&](int y) {
    grow_row({row_of(region, y), across}, std::size_t(radius), row_of(rows, y));
    looked_at(2 * across);
  });
  oneapi::tbb::parallel_for(0, down, [&](int y) {
    std::uint8_t* const out = row_of(result, y);
    const std::size_t count = across;  // a byte that is written might be one of `across`
    for (int from = std::max(0, y - radius); from <= std::min(down - 1, y + radius); ++from) {
      const std::uint8_t* const row = row_of(rows, from);
      for (std::size_t x = 0; x < count; ++x) out[x] |= row[x];
    }
    looked_at(2 * across);
  });
  return result;
}

bool needs_exposures(const Peaks& peaks) {
  const double peak = exposed_peak(peaks);
  return peak > 0 && !(peak <= 1 && peak >= kDimmestShown);
}

Viewing with_exposures(Viewing viewing, const Image& a, const Image& b) {
  if (!viewing.automatic) return viewing;
  const Peaks peaks = peaks_of(a, b);
  return with_exposures(
      std::move(viewing), peaks, b,
      needs_exposures(peaks) ? find_highlights(b) : std::vector<LocalHighlight>());
}

Viewing with_exposures(Viewing viewing, const Peaks& peaks, const Image& b,
                       std::span<const LocalHighlight> highlights) {
  if (!viewing.automatic) return viewing;
  viewing.exposure_stops = 0;
  viewing.tail_stops.reset();
  viewing.further_stops.clear();
  if (!needs_exposures(peaks)) return viewing;
  viewing.exposure_stops = std::clamp(exposure_for_peak(exposed_peak(peaks)), -kMaxExposureStops,
                                      kMaxExposureStops - kTailStops);
  viewing.tail_stops = viewing.exposure_stops + kTailStops;
  std::vector<double> dim;
  for (const LocalHighlight& highlight : highlights)
    dim.push_back(double(std::ranges::max(b.pixel(highlight.x, highlight.y))));
  std::ranges::sort(dim, std::ranges::greater{});
  double brightest = *viewing.tail_stops;
  for (const double peak : dim) {
    if (!(peak * std::exp2(brightest + kTailStops) < 1)) continue;
    brightest = std::min(exposure_for_peak(peak), kMaxExposureStops);
    viewing.further_stops.push_back(brightest);
  }
  return viewing;
}

}  // namespace lobelia
