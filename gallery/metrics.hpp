// What the numbers mean, for a reader who has not read the source. The room's user hands it over.
#pragma once

#include <string>
#include <string_view>
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

  /// A metric that is not known is shown by its id.
  MetricInfo info(std::string_view id) const;
  /// As number_text, or as per cent or a count, as the unit asks.
  std::string text(std::string_view id, double value) const;

 private:
  std::vector<MetricInfo> all_;
};

/// Whether it says where a metric has its value: "max_abs.x".
bool is_coordinate(std::string_view id);

}  // namespace lobelia::gallery
