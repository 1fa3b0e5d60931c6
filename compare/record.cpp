// A comparison as its record, docs/records.md.
#include <utility>

#include "compare/compare.hpp"

namespace lobelia {
namespace {

void add_uncertainty(const Uncertainty& uncertainty, Json& record) {
  Json object = Json::object();
  for (const auto& [name, noise] : {std::pair("a", uncertainty.a), {"b", uncertainty.b}})
    if (noise)
      object[name] = {{"freedom", number_or_name(noise->freedom)}, {"shared", noise->shared}};
  object["significance"] = uncertainty.significance;
  object["tests"] = uncertainty.tests;
  object["each"] = uncertainty.each;
  object["bootstraps"] = uncertainty.bootstraps;
  object["seed"] = uncertainty.seed;
  record["uncertainty"] = std::move(object);
  record["errorBars"] = Json::object();
  for (const ErrorBar& bar : uncertainty.error_bars)
    record["errorBars"][std::string(bar.id)] = {
        {"standardError", number_or_name(bar.standard_error)},
        {"noiseFloor", number_or_name(bar.floor)},
        {"noiseFloorMost", number_or_name(bar.floor_most)},
        {"low", number_or_name(bar.low)},
        {"high", number_or_name(bar.high)}};
}

Json limit_entry(const LimitResult& limit) {
  Json entry{{"metric", limit.metric},
             {"limit", limit.limit},
             {"value", number_or_name(limit.value)},
             {"pass", limit.pass}};
  if (limit.standing) entry["standing"] = standing_name(*limit.standing);
  if (limit.standing == Standing::kOpen) entry["moreSamples"] = number_or_name(limit.more_samples);
  return entry;
}

Json metrics_json(std::span<const MetricValue> metrics) {
  Json object = Json::object();
  for (const MetricValue& metric : metrics)
    object[std::string(metric.id)] = number_or_name(metric.value);
  return object;
}

Json limits_json(std::span<const LimitResult> limits) {
  Json list = Json::array();
  for (const LimitResult& limit : limits) list.push_back(limit_entry(limit));
  return list;
}

Json nonfinite_json(const Comparison& comparison) {
  Json object{{"a", comparison.nonfinite_a}, {"b", comparison.nonfinite_b}};
  for (const auto& [name, place] :
       {std::pair("a", comparison.first_nonfinite_a), {"b", comparison.first_nonfinite_b}})
    if (place)
      object["first"][name] = {{"x", place->x},
                               {"y", place->y},
                               {"channel", place->channel},
                               {"value", number_or_name(double(place->value))}};
  if (comparison.equal_nonfinite) object["equalAllowed"] = *comparison.equal_nonfinite;
  return object;
}

}  // namespace

Json comparison_record(const Comparison& comparison, const std::string& a, const std::string& b,
                       const std::string& c) {
  Json record = make_record("comparison");
  record["verdict"] = verdict_name(comparison.verdict);
  record["a"] = a;
  record["b"] = b;
  record["nonfinite"] = nonfinite_json(comparison);
  record["viewing"] = {{"exposureStops", comparison.viewing.exposure_stops},
                       {"pixelsPerDegree", comparison.viewing.pixels_per_degree}};
  if (const auto& range = comparison.viewing.hdr_exposures;
      range && range->problem.empty() && !comparison.metrics.empty())
    record["viewing"]["hdrExposures"] = {{"startStops", range->start_stops},
                                         {"stopStops", range->stop_stops},
                                         {"count", range->count},
                                         {"automatic", range->automatic},
                                         {"toneCurve", "aces"}};
  if (const auto& display = comparison.viewing.display)
    record["viewing"]["display"] = {
        {"config", display->choice().config},          {"configId", display->config_id()},
        {"display", display->choice().display},        {"view", display->choice().view},
        {"inputSpace", display->choice().input_space}, {"decodedBy", display->decoded_by()}};
  if (comparison.mask_pixels) record["mask"] = {{"pixels", *comparison.mask_pixels}};
  record["metrics"] = metrics_json(comparison.metrics);
  if (!comparison.not_measured.empty()) {
    record["notMeasured"] = Json::array();
    for (const NotMeasured& one : comparison.not_measured)
      record["notMeasured"].push_back({{"metric", one.id}, {"because", one.because}});
  }
  record["limits"] = limits_json(comparison.limits);
  if (!comparison.warnings.empty()) record["warnings"] = limits_json(comparison.warnings);
  record["disagreement"] = comparison.disagreement;
  if (comparison.uncertainty) add_uncertainty(*comparison.uncertainty, record);
  if (comparison.tolerance)
    record["tolerance"] = {{"relative", comparison.tolerance->relative},
                           {"ofPeak", comparison.tolerance->of_peak},
                           {"allowedOutliers", comparison.tolerance->allowed_outliers},
                           {"onEdgesOnly", !comparison.tolerance->edges.empty()}};
  if (const auto& floor = comparison.reference_floor)
    record["referenceFloor"] = {
        {"c", c}, {"nonfinite", floor->nonfinite}, {"metrics", metrics_json(floor->metrics)}};
  return record;
}

}  // namespace lobelia
