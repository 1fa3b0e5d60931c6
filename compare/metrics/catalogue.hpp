// The list of metrics, for records, the command line and the property tests.
#pragma once

#include "compare/metrics/metric.hpp"

namespace lobelia {

/// A metric that is measured in regions has an entry for each of them. Thresholds that find_metric() met come last.
std::span<const Metric* const> metrics();

using MetricList = std::vector<const Metric*>;

/// One value per output of each metric of the list, over its region. With a second exposure the worse of both values
/// counts. All of them must be measurable. Each value is the same bits as if the metric were measured alone.
std::vector<std::vector<double>> measure_metrics(std::span<const Metric* const> list,
                                                 const MetricInput& input);
void measure_metric(const Metric& metric, const MetricInput& input, std::span<double> values);

/// The metric with an output of this id, and the output; null if there is none. An id of the catalogue that ends in "=0"
/// stands for any threshold: "share_over.abs=0.0040" finds one with the id "share_over.abs=0.004".
const Metric* find_metric(std::string_view id);
const MetricOutput* find_metric_output(std::string_view id);

/// The id of an output of a metric of the whole picture in a region: "flip.ldr.mean.highlight", and of a place
/// "max_abs.highlight.x", as the region follows the figure.
std::string id_in_region(const Metric& metric, const MetricOutput& output, Region region);

/// Whether the input has everything that the metric needs.
bool is_measurable(const Metric& metric, const MetricInput& input);
/// Whether a metric that cannot be measured has its best value all the same, because the pictures are equal.
bool is_best_by_equality(const Metric& metric, const MetricInput& input);
/// Why a metric has no value although no option is missing; otherwise empty.
std::string why_not_measured(const Metric& metric, const MetricInput& input);

/// Whether a name of --metrics means the metric: "all"; the id of an output, its beginning up to a dot or an equals sign
/// ("flip.ldr", "relmse") or a family ("colour"), each of the whole picture; one of these with a region ("rmse.mask");
/// or a region ("highlight"). A threshold above 0 is meant by its id alone.
bool is_named(const Metric& metric, std::string_view name);

/// Why no limit on the output can have this value, with what to write instead; empty if one can. A signed error takes a
/// limit on its size.
std::string limit_problem(const MetricOutput& output, double limit);

/// Whether a value passes a limit; false if either is NaN.
bool is_within(const MetricOutput& output, double value, double limit);

/// Ids that take a limit, in the order of the catalogue; without those of regions or with them.
std::vector<std::string_view> limit_names(bool with_regions);

/// docs/metrics.md, written by `lobelia compare --list-metrics`.
std::string metrics_document();

}  // namespace lobelia
