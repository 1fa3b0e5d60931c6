// The list of metrics, for records, the command line and the property tests.
#pragma once

#include "compare/metrics/metric.hpp"

namespace lobelia {

std::span<const Metric* const> metrics();

/// The metric with an output of this id, and the output; null if there is none.
const Metric* find_metric(std::string_view id);
const MetricOutput* find_metric_output(std::string_view id);

/// Whether the input has everything that the metric needs.
bool is_measurable(const Metric& metric, const MetricInput& input);
/// Why a metric cannot be measured although no option is missing; otherwise empty.
std::string why_not_measured(const Metric& metric, const MetricInput& input);

/// Whether a value passes a limit; false if either is NaN.
bool is_within(const MetricOutput& output, double value, double limit);

/// Ids that take a limit, in the order of the catalogue.
std::vector<std::string_view> limit_names();

/// docs/metrics.md, written by `lobelia compare --list-metrics`.
std::string metrics_document();

}  // namespace lobelia
