#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/metrics/metric.hpp"
#include "core/error.hpp"

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
  std::vector<float> luminances;
  luminances.reserve(reference.pixel_count());
  for (std::size_t i = 0; i < values.size(); i += 3)
    luminances.push_back(0.2126f * values[i] + 0.7152f * values[i + 1] + 0.0722f * values[i + 2]);
  if (luminances.empty()) throw Error(ExitCode::kInput, "the pictures have no pixels");
  if (!std::ranges::all_of(luminances, [](float l) { return std::isfinite(l); }))
    throw Error(ExitCode::kInput,
                "the automatic range of exposures needs a reference without a NaN or an infinity");
  const float largest = std::ranges::max(luminances);
  // With a small highlight on black, the median of all pixels is 0 and the tool's range is infinite.
  const auto middle_of = [&] { return luminances.begin() + std::ptrdiff_t(luminances.size() / 2); };
  std::nth_element(luminances.begin(), middle_of(), luminances.end());
  if (!(*middle_of() > 0)) std::erase_if(luminances, [](float l) { return !(l > 0); });
  if (luminances.empty())
    throw Error(ExitCode::kInput,
                "the automatic range of exposures needs a reference with a pixel above 0");
  // The upper of the two middle values, like the tool.
  const auto middle = middle_of();
  std::nth_element(luminances.begin(), middle, luminances.end());
  const float light = light_shown_as(kShown, asked.curve);
  const float start = asked.given_start ? float(asked.start_stops) : std::log2(light / largest),
              stop = asked.given_stop ? float(asked.stop_stops) : std::log2(light / *middle);
  HdrExposures exposures = asked;
  exposures.start_stops = start;
  exposures.stop_stops = stop;
  exposures.automatic = true;
  if (!asked.given_count) exposures.count = count_of_exposures(start, stop);
  if (start > stop)
    throw Error(
        ExitCode::kInput,
        fmt::format("the range of exposures begins at {:.4g} stops, above its end at {:.4g}", start,
                    stop));
  if (exposures.count > kMaxHdrExposures || !(std::abs(start) <= kMaxExposureStops) ||
      !(std::abs(stop) <= kMaxExposureStops))
    throw Error(
        ExitCode::kInput,
        fmt::format("the automatic range of exposures, {:.4g} to {:.4g} stops, is too wide or "
                    "too far; give a fixed range",
                    start, stop));
  return exposures;
}

}  // namespace lobelia
