#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/system/error.hpp"
#include "base/system/scratch_memory.hpp"
#include "compare/metrics/metric.hpp"
#include "compare/metrics/pixel_differences.hpp"

namespace lobelia {
namespace {

/// The tone curve maps the largest and the median luminance to this value.
constexpr float kShown = 0.85f;

/// Inverts the tone curve, in the tool's order of operations.
float light_shown_as(float shown, ToneCurve curve) {
  const auto constants = tone_constants(curve);
  const auto& k = constants.c;
  const float a = k[0] - shown * k[3], b = k[1] - shown * k[4], c = k[2] - shown * k[5];
  if (a == 0) return -c / b;
  const float half = -0.5f * (b / a);
  return half + std::sqrt(half * half - c / a);
}

}  // namespace

int count_of_exposures(double start_stops, double stop_stops) {
  // In float32, like the tool: seven stops may be seven and a rounding in double.
  return std::max(2, int(std::ceil(std::min(float(stop_stops) - float(start_stops), 1e6f))));
}

HdrExposures automatic_exposures(const Image& reference, const HdrExposures& asked) {
  const std::span<const float> values = reference.values();
  std::vector<float, ZeroedMemory<float>> luminances(reference.pixel_count());
  bool finite = true;
  float largest = 0;
  std::size_t dark = 0;  // pixels that are not above 0
  in_parts(luminances.size(), 4 * sizeof(float), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      luminances[i] =
          0.2126f * values[3 * i] + 0.7152f * values[3 * i + 1] + 0.0722f * values[3 * i + 2];
      finite = finite && std::isfinite(luminances[i]);
      largest = std::max(largest, luminances[i]);
      dark += !(luminances[i] > 0);
    }
  });
  if (luminances.empty()) throw Error(ExitCode::kInput, "the pictures have no pixels");
  if (!finite)
    throw Error(ExitCode::kInput,
                "the automatic range of exposures needs a reference without a NaN or an infinity");
  if (!(largest > 0))
    throw Error(ExitCode::kInput,
                "the automatic range of exposures needs a reference with a pixel above 0");
  // The upper of the two middle values, like the tool. With a small highlight on black, the median of all pixels is 0
  // and the tool's range is infinite; then only those above 0 count.
  const std::size_t count = luminances.size();
  const bool is_dark = dark > count / 2;
  const float middle = nth_value(luminances, is_dark ? dark + (count - dark) / 2 : count / 2);
  const float light = light_shown_as(kShown, asked.curve);
  const float start = asked.given_start ? float(asked.start_stops) : std::log2(light / largest),
              stop = asked.given_stop ? float(asked.stop_stops) : std::log2(light / middle);
  HdrExposures exposures = asked;
  exposures.start_stops = start;
  exposures.stop_stops = stop;
  exposures.automatic = true;
  if (!asked.given_count) exposures.count = count_of_exposures(start, stop);
  if (start > stop)
    throw Error(ExitCode::kInput,
                "the range of exposures begins at {:.4g} stops, above its end at {:.4g}", start,
                stop);
  if (exposures.count > kMaxHdrExposures || !(std::abs(start) <= kMaxExposureStops) ||
      !(std::abs(stop) <= kMaxExposureStops))
    throw Error(ExitCode::kInput,
                "the automatic range of exposures, {:.4g} to {:.4g} stops, is too wide or "
                "too far; give a fixed range",
                start, stop);
  return exposures;
}

}  // namespace lobelia
