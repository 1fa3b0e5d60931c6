#include "compare/metrics/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

// One line per metric. A file of that name in this directory defines `const Metric <name>_metric`, and
// <name>_mask_metric for the same inside a mask.
#define LOBELIA_METRICS(METRIC) \
  METRIC(mae)                   \
  METRIC(mse)                   \
  METRIC(rmse)                  \
  METRIC(psnr)                  \
  METRIC(drift)                 \
  METRIC(relmse)                \
  METRIC(max_abs)               \
  METRIC(max_rel_peak)          \
  METRIC(ciede2000)             \
  METRIC(delta_e_itp)           \
  METRIC(ssim)                  \
  METRIC(ms_ssim)               \
  METRIC(flip_ldr)              \
  METRIC(flip_hdr)              \
  METRIC(outliers)              \
  METRIC(mae_mask)              \
  METRIC(rmse_mask)             \
  METRIC(drift_mask)            \
  METRIC(max_abs_mask)          \
  METRIC(z)

namespace lobelia {

#define LOBELIA_DECLARE(name) extern const Metric name##_metric;
LOBELIA_METRICS(LOBELIA_DECLARE)
#undef LOBELIA_DECLARE

std::span<const Metric* const> metrics() {
#define LOBELIA_ADDRESS(name) &name##_metric,
  static constexpr const Metric* kMetrics[] = {LOBELIA_METRICS(LOBELIA_ADDRESS)};
#undef LOBELIA_ADDRESS
  return kMetrics;
}

const Metric* find_metric(std::string_view id) {
  for (const Metric* metric : metrics())
    if (std::ranges::count(metric->outputs, id, &MetricOutput::id) > 0) return metric;
  return nullptr;
}

const MetricOutput* find_metric_output(std::string_view id) {
  const Metric* metric = find_metric(id);
  return metric ? &*std::ranges::find(metric->outputs, id, &MetricOutput::id) : nullptr;
}

bool is_measurable(const Metric& metric, const MetricInput& input) {
  const int side = std::min(input.a.width(), input.a.height());
  switch (metric.needs) {
    case Needs::kNothing:
      return true;
    case Needs::kTolerance:
      return input.tolerance != nullptr;
    case Needs::kMask:
      return std::ranges::any_of(input.mask, [](auto inside) { return inside != 0; });
    case Needs::kHdrExposures:
      return input.hdr_exposures != nullptr && input.hdr_exposures->problem.empty();
    case Needs::kOneWindow:
      return side >= kSsimSide;
    case Needs::kFiveScales:
      return side >= kMsSsimSide;
    case Needs::kNoise:
      return input.noise != nullptr;
  }
  return false;
}

std::string why_not_measured(const Metric& metric, const MetricInput& input) {
  if (is_measurable(metric, input)) return "";
  if (metric.needs == Needs::kHdrExposures && input.hdr_exposures)
    return input.hdr_exposures->problem;
  if (metric.needs == Needs::kMask && !input.mask.empty()) return "no pixel lies inside the mask";
  if (metric.needs != Needs::kOneWindow && metric.needs != Needs::kFiveScales) return "";
  return fmt::format("it needs {} pixels a side, the pictures have {} x {}",
                     metric.needs == Needs::kOneWindow ? kSsimSide : kMsSsimSide, input.a.width(),
                     input.a.height());
}

bool is_within(const MetricOutput& output, double value, double limit) {
  switch (output.better) {
    case Better::kLower:
      return value <= limit;
    case Better::kNearZero:
      return std::abs(value) <= limit;
    case Better::kHigher:
      return value >= limit;
    case Better::kNeither:
      break;
  }
  return false;
}

std::vector<std::string_view> limit_names() {
  std::vector<std::string_view> names;
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs)
      if (output.better != Better::kNeither) names.push_back(output.id);
  return names;
}

}  // namespace lobelia
