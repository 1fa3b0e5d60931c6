// How far surfaces are from their distance in the reference, and pixels that lost or gained a surface.
//
// Source:       ours.
// Formula:      relative: |a - b| / max(|a|, |b|) of a pixel, 0 if both are 0; of several channels the largest. Mean,
//               95th percentile (nearest rank) and maximum over the pixels where both have a surface; 0 without any.
//               background: the pixels where one alone has a surface.
// Input:        distances as stored; a value that is infinite or at least 1e10 is background (compare/layer_types.hpp).
// Deviations:   divided by the larger of two distances, not by the reference's: a reference of 0 is no division by 0.
#include <algorithm>
#include <cmath>

#include "compare/metrics/pixel_differences.hpp"

namespace lobelia {
namespace {

constexpr ValueRange kDepthRange{0, 2};  // 2: the same distance on the other side

constexpr MetricOutput kDepthOutputs[] = {
    {"depth.relative.mean", "Depth, mean", Unit::kShare, Better::kLower, true,
     "relative difference of depth, mean over surfaces", "", 0, false, kDepthRange},
    {"depth.relative.p95", "Depth, 95th percentile", Unit::kShare, Better::kLower, true,
     "relative difference of depth, 95th percentile", "", 0, false, kDepthRange},
    {"depth.relative.max", "Depth, largest", Unit::kShare, Better::kLower, true,
     "relative difference of depth, largest", "", 0, false, kDepthRange},
    {"depth.background", "Pixels with a surface in one alone", Unit::kCount, Better::kLower, true,
     "pixels that are background in one picture alone"}};

void measure_depth(const MetricInput& input, std::span<double> values) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  const std::size_t count = input.a.pixel_count();
  PixelValues relative(count);
  PixelFlags surfaces(count);
  std::int64_t background = 0;
  for (std::size_t pixel = 0; pixel < count; ++pixel) {
    if (!input.in_region(pixel)) continue;
    surfaces[pixel] = input.layer->background[pixel] == 0;
    background += input.layer->background[pixel] == 2;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      const double in_a = a[i], in_b = b[i], larger = std::max(std::abs(in_a), std::abs(in_b));
      if (larger > 0)
        relative[pixel] = std::max(relative[pixel], float(std::abs(in_a - in_b) / larger));
    }
  }
  MetricInput of_surfaces = input;
  of_surfaces.region = surfaces;
  write_figures(relative, of_surfaces, {0.95}, values.first(3));
  values[3] = double(background);
}

}  // namespace

extern constinit const Metric depth_metric{.outputs = kDepthOutputs,
                                           .family = Family::kRadiance,
                                           .needs = Needs::kNothing,
                                           .source = "ours",
                                           .measure = measure_depth,
                                           .layer = LayerType::kDepth};

}  // namespace lobelia
