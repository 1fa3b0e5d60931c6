// The list of metrics. Records, the command line and the property tests find them here.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "compare/metrics/metric.hpp"

namespace lobelia {

std::span<const Metric* const> metrics();

/// The output of that id, or null.
const MetricOutput* find_metric_output(std::string_view id);

/// Ids on which a limit may be set, in the order of the catalogue.
std::vector<std::string_view> limit_names();

}  // namespace lobelia
