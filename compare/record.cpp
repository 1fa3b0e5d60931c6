// A comparison as its record, docs/records.md.
#include "compare/compare.hpp"

namespace lobelia {

Json comparison_record(const Comparison& comparison, const std::string& a, const std::string& b) {
  Json record = make_record("comparison");
  record["verdict"] = verdict_name(comparison.verdict);
  record["a"] = a;
  record["b"] = b;
  record["nonfinite"] = {{"a", comparison.nonfinite_a}, {"b", comparison.nonfinite_b}};
  record["viewing"] = {{"exposureStops", comparison.viewing.exposure_stops},
                       {"pixelsPerDegree", comparison.viewing.pixels_per_degree}};
  if (const auto& range = comparison.viewing.hdr_exposures; range && !comparison.metrics.empty())
    record["viewing"]["hdrExposures"] = {{"startStops", range->start_stops},
                                         {"stopStops", range->stop_stops},
                                         {"count", range->count},
                                         {"automatic", range->automatic},
                                         {"toneCurve", "aces"}};
  if (comparison.mask_pixels) record["mask"] = {{"pixels", *comparison.mask_pixels}};
  record["metrics"] = Json::object();
  for (const MetricValue& metric : comparison.metrics)
    record["metrics"][std::string(metric.id)] = number_or_name(metric.value);
  record["limits"] = Json::array();
  for (const LimitResult& limit : comparison.limits)
    record["limits"].push_back({{"metric", limit.metric},
                                {"limit", limit.limit},
                                {"value", number_or_name(limit.value)},
                                {"pass", limit.pass}});
  record["disagreement"] = comparison.disagreement;
  if (comparison.tolerance)
    record["tolerance"] = {{"relative", comparison.tolerance->relative},
                           {"ofPeak", comparison.tolerance->of_peak},
                           {"allowedOutliers", comparison.tolerance->allowed_outliers},
                           {"onEdgesOnly", !comparison.tolerance->edges.empty()}};
  return record;
}

}  // namespace lobelia
