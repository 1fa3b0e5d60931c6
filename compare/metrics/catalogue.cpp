#include "compare/metrics/catalogue.hpp"

// One line per metric: a file of that name in this directory defines `const Metric <name>_metric`.
#define LOBELIA_METRICS(METRIC) \
  METRIC(rmse)                  \
  METRIC(max_abs)               \
  METRIC(max_rel_peak)          \
  METRIC(ciede2000)             \
  METRIC(flip_ldr)              \
  METRIC(outliers)

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

const MetricOutput* find_metric_output(std::string_view id) {
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs)
      if (output.id == id) return &output;
  return nullptr;
}

std::vector<std::string_view> limit_names() {
  std::vector<std::string_view> names;
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs)
      if (output.kind == OutputKind::kError) names.push_back(output.id);
  return names;
}

}  // namespace lobelia
