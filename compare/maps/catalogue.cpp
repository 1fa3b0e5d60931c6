// The maps of differences. The visual ones have their formulas and sources in the files of their metrics.
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/system/scratch_memory.hpp"
#include "compare/maps/difference_map.hpp"
#include "compare/metrics/ciede2000.hpp"
#include "compare/metrics/code_values.hpp"
#include "compare/metrics/delta_e_itp.hpp"
#include "compare/metrics/flip_error.hpp"

namespace lobelia {
namespace {

/// The largest difference(a, b) of the three channels.
template <class Difference>
PixelValues largest_of_channels(const MetricInput& input, Difference difference) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  PixelValues map(input.a.pixel_count());
  const auto width = std::size_t(input.a.width());
  oneapi::tbb::parallel_for(0, input.a.height(), [&](int y) {
    for (std::size_t i = width * std::size_t(y), end = i + width; i < end; ++i)
      map[i] = std::max({difference(a[3 * i], b[3 * i]), difference(a[3 * i + 1], b[3 * i + 1]),
                         difference(a[3 * i + 2], b[3 * i + 2])});
    looked_at(7 * sizeof(float) * width);
  });
  return map;
}

PixelValues absolute(const MetricInput& input) {
  return largest_of_channels(input, [](float a, float b) { return std::abs(a - b); });
}

PixelValues mean_signed(const MetricInput& input) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  PixelValues map(input.a.pixel_count());
  in_parts(map.size(), 6 * sizeof(float), [&](std::size_t begin, std::size_t end) {
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      double sum = 0;
      for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) sum += double(a[i]) - double(b[i]);
      map[pixel] = float(sum / 3);
    }
  });
  return map;
}

/// Flanks and tails count like the peak.
PixelValues relative(const MetricInput& input) {
  return largest_of_channels(input, [](float a, float b) {
    // A difference from a reference of 0 exceeds every scale, but is not the NaN of a broken pixel.
    constexpr double kWithoutReference = std::numeric_limits<float>::max();
    const double difference = std::abs(double(a) - double(b));
    if (difference == 0) return 0.0f;
    return float(b == 0 ? kWithoutReference
                        : std::min(difference / std::abs(double(b)), kWithoutReference));
  });
}

PixelValues code_map(const MetricInput& input) { return code_differences(*code_pair(input)); }

PixelValues yiq_map(const MetricInput& input) { return yiq_differences(*code_pair(input)); }

PixelValues ciede2000_map(const MetricInput& input) {
  return ciede2000_of_pixels(input.shown_a, input.shown_b, input.needed());
}

PixelValues delta_e_itp_map(const MetricInput& input) {
  return delta_e_itp_of_pixels(input.shown_a, input.shown_b, input.needed());
}

PixelValues flip_ldr_map(const MetricInput& input) {
  return flip_error_map(input.shown_a, input.shown_b, FlipFilters(input.pixels_per_degree),
                        input.needed());
}

constexpr DifferenceMap kMaps[] = {
    {"abs", "radiance", "largest |A - B| of R, G and B", false, false, absolute},
    {"signed", "radiance", "mean of A - B over R, G and B", true, false, mean_signed},
    {"relative", "share of the reference", "largest |A - B| / |B| of R, G and B", false, false,
     relative},
    {"code", "code values", "largest difference of 8-bit sRGB code values", false, false, code_map},
    {"yiq", "YIQ, 0 to 1", "colour difference as pixelmatch and odiff have it", false, false,
     yiq_map},
    {"ciede2000", "CIEDE2000", "colour difference as shown, 1 is about just noticeable", false,
     true, ciede2000_map},
    {"delta_e_itp", "delta E ITP",
     "colour difference as shown to an adapted eye, 1 is just noticeable", false, true,
     delta_e_itp_map},
    {"flip.ldr", "LDR-FLIP, 0 to 1", "what is noticed when the two are shown in turn", false, true,
     flip_ldr_map, MapScale::kOne},
    {"flip.hdr", "HDR-FLIP, 0 to 1", "the same at the exposure that shows it best", false, false,
     flip_hdr_error_map, MapScale::kOne, true},
    {"flip.hdr.exposure", "stops", "the exposure at which HDR-FLIP is largest", false, false,
     flip_hdr_exposure_map, MapScale::kExposures, true, "viridis"}};

}  // namespace

std::span<const DifferenceMap> difference_maps() { return kMaps; }

}  // namespace lobelia
