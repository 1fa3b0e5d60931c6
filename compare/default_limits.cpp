// How pictures are judged unless a user chooses: the default limits, each with its reason.
#include <fmt/format.h>

#include <array>

#include "compare/compare.hpp"
#include "compare/highlights/judge.hpp"

namespace lobelia {

ComparisonOptions usual_options() {
  ComparisonOptions options;
  options.viewing.automatic = true;
  options.highlight = true;
  return options;
}

std::span<const MetricLimit> default_limits() {
  static const std::array<MetricLimit, 3> limits{{
      // Engines with the same formula differ by 5e-4 of the peak if one writes half floats, otherwise by 1e-5. A
      // wrong normalisation is off by 3 % and more.
      {"max_rel_peak", 0.01},
      // One step of an 8-bit display, 128 to 129 over the whole picture, has a FLIP of 0.03.
      {"flip.ldr.mean", 0.01},
      // 1 is about a just noticeable difference. One pixel in twenty may have more: engines sample the edge of the
      // silhouette differently, which max_rel_peak judges.
      {"ciede2000.p95", 1.0},
  }};
  return limits;
}

std::span<const MetricLimit> highlight_limits() {
  static const std::array<MetricLimit, 8> limits{{
      // A wrong coefficient is off by 3 % and more, a wrong exponent by half as many per cent in width.
      {"energy.highlight", 0.01},
      {"width.highlight", 0.01},
      // Half a pixel is what a wrong pixel centre shifts.
      {"shift.highlight", 0.25},
      {"ciede2000.p95.highlight", 1.0},
      {"flip.ldr.mean.highlight", 0.03},
      // Each highlight by itself. A pair that is 1 % dimmer throughout is off by up to 2.5 % over a bright background.
      {"highlights.energy", kEnergyLimit},
      {"highlights.width", kWidthLimit},
      {"highlights.shift", kShiftLimit},
  }};
  return limits;
}

std::string limits_text(std::span<const MetricLimit> limits, std::string_view mark) {
  std::string text;
  for (const auto& [metric, limit] : limits)
    text += fmt::format("{}{}{}{} {:g}", text.empty() ? "" : ", ", mark, metric, mark, limit);
  return text;
}

}  // namespace lobelia
