// A comparison as its record.
#include "compare/compare.hpp"

namespace lobelia {
namespace {

std::vector<records::Limit> limit_records(std::span<const LimitResult> limits) {
  std::vector<records::Limit> list;
  for (const LimitResult& limit : limits) {
    records::Limit& one = list.emplace_back();
    one.metric = limit.metric;
    one.limit = limit.limit;
    one.value = limit.value;
    one.pass = limit.pass;
    if (limit.standing) one.standing = standing_name(*limit.standing);
    if (limit.standing == Standing::kOpen) one.more_samples = limit.more_samples;
  }
  return list;
}

records::Named<double> metric_records(std::span<const MetricValue> metrics) {
  records::Named<double> values;
  for (const MetricValue& metric : metrics) values.emplace_back(metric.id, metric.value);
  return values;
}

std::optional<records::NonfinitePlace> place_record(const std::optional<NonfinitePlace>& place) {
  if (!place) return std::nullopt;
  return records::NonfinitePlace{place->x, place->y, place->channel, double(place->value)};
}

records::Nonfinite nonfinite_record(const Comparison& comparison) {
  records::Nonfinite record{comparison.nonfinite_a, comparison.nonfinite_b, std::nullopt,
                            comparison.equal_nonfinite};
  if (comparison.first_nonfinite_a || comparison.first_nonfinite_b)
    record.first = records::NonfinitePlaces{place_record(comparison.first_nonfinite_a),
                                            place_record(comparison.first_nonfinite_b)};
  return record;
}

records::Viewing viewing_record(const Viewing& viewing, bool measured) {
  records::Viewing record{viewing.exposure_stops, viewing.pixels_per_degree, std::nullopt,
                          std::nullopt};
  if (const auto& range = viewing.hdr_exposures; range && range->problem.empty() && measured)
    record.hdr_exposures = records::HdrExposures{range->start_stops, range->stop_stops,
                                                 range->count, range->automatic, "aces"};
  if (const auto& display = viewing.display) {
    const auto& choice = display->choice();
    record.display =
        records::Display{choice.config, display->config_id(), choice.display,
                         choice.view,   choice.input_space,   std::string(display->decoded_by())};
  }
  return record;
}

}  // namespace

records::Comparison comparison_record(const Comparison& comparison, const std::string& a,
                                      const std::string& b, const std::string& c) {
  records::Comparison record;
  record.verdict = verdict_name(comparison.verdict);
  record.a = a;
  record.b = b;
  record.nonfinite = nonfinite_record(comparison);
  record.viewing = viewing_record(comparison.viewing, !comparison.metrics.empty());
  if (comparison.mask_pixels) record.mask = records::Mask{*comparison.mask_pixels};
  record.metrics = metric_records(comparison.metrics);
  record.not_measured = comparison.not_measured;
  record.limits = limit_records(comparison.limits);
  record.warnings = limit_records(comparison.warnings);
  record.disagreement = comparison.disagreement;
  record.uncertainty = comparison.uncertainty;
  if (comparison.uncertainty) record.error_bars = comparison.error_bars;
  if (comparison.tolerance)
    record.tolerance = records::Tolerance{
        comparison.tolerance->relative, comparison.tolerance->of_peak,
        comparison.tolerance->allowed_outliers, !comparison.tolerance->edges.empty()};
  if (const auto& floor = comparison.reference_floor)
    record.reference_floor =
        records::ReferenceFloor{c, floor->nonfinite, metric_records(floor->metrics)};
  return record;
}

}  // namespace lobelia
