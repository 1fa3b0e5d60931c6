// What the numbers mean, for a reader who has not read the source.
#pragma once

#include <string>
#include <string_view>

namespace lobelia::gallery {

enum class MetricUnit { kRadiance, kShare, kCount, kPlain };

struct MetricNote {
  std::string title;         ///< "Largest difference"
  std::string_view meaning;  ///< one sentence; empty for a metric that this table does not know
  MetricUnit unit = MetricUnit::kPlain;
  bool more_is_better = false;
};

/// "share", as gallery/web/src/grid_data.ts has it.
std::string unit_name(MetricUnit unit);
/// Whether it says where a metric has its value: "max_abs.x".
bool is_coordinate(std::string_view id);

/// By the metric's id; one that is not in the table is shown by its id.
MetricNote metric_note(std::string_view id);
/// As number_text, or as per cent or a count, as the unit asks.
std::string metric_text(std::string_view id, double value);

}  // namespace lobelia::gallery
