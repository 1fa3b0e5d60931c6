// HDR-FLIP: the difference that a person sees when two pictures of high dynamic range alternate on a display,
// at the exposure that shows it best; 0 to 1.
//
// Source:       P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Moeller, "Visualizing Errors in
//               Rendered High Dynamic Range Images", Eurographics 2021 Short Papers.
// Formula:      per pixel the largest LDR-FLIP (flip_ldr.cpp) over a range of exposures, evenly
//               spaced in stops, each shown through a tone curve of display_light.hpp, ACES unless the
//               range has another. mean and max over all pixels.
// Input:        scene-linear values; values below 0 count as 0. The range of exposures, which the record
//               holds, replaces the exposure of the viewing condition.
// Left out:     where no range is given. A figure depends on its range, so one range should serve a whole
//               set of pairs. automatic_exposures() chooses the tool's range for one reference.
// Agrees with:  NVIDIA's tool, version 1.6, its mean taken in double: to 5e-7 on a ramp, to 1e-4 on flat pictures, whose
//               features are rounding noise in the tool (flip_ldr.cpp); and its automatic ranges.
// Differs:      the mean is summed in double. The tool's curve gives a NaN for values over 1.8e19, as
//               their square is infinite, and light for negative values. Ours gives white and black.
#include <algorithm>

#include "compare/metrics/flip_error.hpp"
#include "compare/metrics/flip_kernels.hpp"
#include "compare/metrics/pixel_differences.hpp"
#include "compare/metrics/shared_work.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kFlipHdrOutputs[] = {
    {"flip.hdr.mean", "HDR-FLIP, mean", Unit::kPlain, Better::kLower, true, "HDR-FLIP, mean",
     "The same at the exposure that shows each pixel’s difference best.", 0, false, kUnitRange},
    {"flip.hdr.max", "HDR-FLIP, largest", Unit::kPlain, Better::kLower, true,
     "HDR-FLIP, the largest of all pixels", "The pixel where a person would notice most.", 0, false,
     kUnitRange}};

/// Spaced in float32, like the tool's.
std::vector<float> exposure_stops(const HdrExposures& range) {
  const auto start = float(range.start_stops), stop = float(range.stop_stops);
  const float step = (stop - start) / float(range.count - 1);
  std::vector<float> stops;
  for (int i = 0; i < range.count; ++i) stops.push_back(start + float(i) * step);
  // Stops are equal if the reference's largest luminance is its median.
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
  return stops;
}

/// HDR-FLIP of tiles: the largest error, or the exposure that has it.
FlipTileValues tile_values(const MetricInput& input, bool exposures) {
  return [&input, exposures, filters = FlipFilters(input.pixels_per_degree),
          stops = exposure_stops(*input.hdr_exposures)](const FlipTile& tile,
                                                        std::span<float> values) {
    std::vector<float> logs(values.size(), kNoFlip),
        largest(exposures ? values.size() : 0, kNoFlip);
    // Errors grow with their logarithm, so the largest needs one power.
    std::ranges::fill(values, exposures ? stops.front() : kNoFlip);
    const FlipTile part = differing_part(input.a, input.b, tile, filters.radius());
    for (const float stop : part.width > 0 ? stops : std::vector<float>()) {
      const ToneCurve curve = input.hdr_exposures->curve;
      const DisplayLight a(input.a, double(stop), curve), b(input.b, double(stop), curve);
      flip_tile_logs(a, b, filters, tile, part, logs);
      for (std::size_t i = 0; i < logs.size(); ++i)
        if (!exposures)
          values[i] = std::max(values[i], logs[i]);
        else if (logs[i] > largest[i])
          largest[i] = logs[i], values[i] = stop;
    }
    if (!exposures) flip_errors_of(values.data(), values.size());
  };
}

void measure_flip_hdr(const MetricInput& input, std::span<double> values) {
  const auto map = shared(input, "flip.hdr", [&] { return flip_hdr_error_map(input); });
  write_figures(*map, input, {}, values);
}

}  // namespace

PixelValues flip_hdr_error_map(const MetricInput& input) {
  return flip_map(input.a.width(), input.a.height(), tile_values(input, false), input.needed());
}

PixelValues flip_hdr_exposure_map(const MetricInput& input) {
  return flip_map(input.a.width(), input.a.height(), tile_values(input, true), input.needed());
}

extern constinit const Metric flip_hdr_metric{kFlipHdrOutputs,
                                              Family::kVisibility,
                                              Needs::kHdrExposures,
                                              "Andersson et al. 2021; FLIP 1.6",
                                              measure_flip_hdr,
                                              "flip.hdr",
                                              true,
                                              flip_radius};

}  // namespace lobelia
