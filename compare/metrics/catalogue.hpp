// The list of metrics. Records, the command line and the property tests find them here.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/metrics/metric.hpp"

namespace lobelia {

std::span<const Metric* const> metrics();

/// The metric that has the output of that id, or null; and the output.
const Metric* find_metric(std::string_view id);
const MetricOutput* find_metric_output(std::string_view id);

/// Whether the metric can be measured of that input; where not, it is left out of the results.
bool is_measurable(const Metric& metric, const MetricInput& input);
/// Why a metric that needs no option, or has what it needs, still cannot be measured; empty if it can be, or
/// was not asked for.
std::string why_not_measured(const Metric& metric, const MetricInput& input);

/// Whether a value passes a limit. False if either is NaN.
bool is_within(const MetricOutput& output, double value, double limit);

/// Ids on which a limit may be set, in the order of the catalogue.
std::vector<std::string_view> limit_names();

/// docs/metrics.md, by `lobelia compare --list-metrics`.
std::string metrics_document();

}  // namespace lobelia
