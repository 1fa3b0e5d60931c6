#include "gallery/cells/metrics.hpp"

#include <algorithm>

#include "base/words/numbers.hpp"

namespace lobelia::gallery {

MetricInfo Metrics::info(std::string_view id) const {
  const auto found = std::ranges::find(all_, id, &MetricInfo::id);
  if (found != all_.end()) return *found;
  return {std::string(id), std::string(id), "", "plain", false};
}

std::string Metrics::text(std::string_view id, double value) const {
  const std::string unit = info(id).unit;
  if (unit == "share") return percent_text(value);
  return unit == "count" ? count_text(value) : number_text(value);
}

bool is_coordinate(std::string_view id) { return id.ends_with(".x") || id.ends_with(".y"); }

}  // namespace lobelia::gallery
