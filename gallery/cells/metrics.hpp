// Titles and meanings of the metrics, for readers of the pages. The caller of the gallery provides them.
#pragma once

#include <string>
#include <vector>

namespace lobelia::gallery {

struct MetricInfo {
  std::string id;
  std::string title;           ///< "Largest difference"
  std::string meaning;         ///< one sentence; may be empty
  std::string unit = "plain";  ///< or "radiance", "share", "count"
  bool more_is_better = false;
};

class Metrics {
 public:
  Metrics() = default;
  explicit Metrics(std::vector<MetricInfo> all) : all_(std::move(all)) {}

  /// An unknown metric has its id as title.
  MetricInfo info(std::string_view id) const;
  /// The value as a number, a percentage or a count, by the metric's unit.
  std::string text(std::string_view id, double value) const;

 private:
  std::vector<MetricInfo> all_;
};

/// Whether the id names the place of a metric's value: "max_abs.x".
bool is_coordinate(std::string_view id);

}  // namespace lobelia::gallery
