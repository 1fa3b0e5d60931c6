// A set of comparisons as its record, docs/records.md.
#include <utility>

#include "compare/set/report.hpp"

namespace lobelia {

Json pair_record(const PairReport& pair) {
  Json record = comparison_record(*pair.comparison, pair.a, pair.b, pair.c);
  if (pair.sources) add_pictures(record, pair.sources->a, pair.sources->b);
  if (pair.layers) add_layers(record, pair.verdict(), *pair.layers);
  return record;
}

Json set_record(const SetReport& report) {
  Json record = make_record("comparison-set");
  record["a"] = report.a;
  record["b"] = report.b;
  if (!report.c.empty()) record["c"] = report.c;
  const SetCounts counts = count(report);
  record["summary"] = {
      {"pairs", report.pairs.size()},     {"pass", counts.pass},
      {"differs", counts.differs},        {"undecided", counts.undecided},
      {"nonFinite", counts.nonfinite},    {"errors", counts.errors},
      {"missing", counts.missing},        {"extra", counts.extra},
      {"passedOver", report.passed_over}, {"linksNotFollowed", counts.not_followed}};
  const SetNotCompared left = not_compared(report);
  record["notCompared"] = to_json(left.all);
  record["notCompared"]["pairs"] = left.pairs;
  record["worst"] = Json::object();
  for (const MetricSummary& metric : summarise(report.pairs))
    record["worst"][std::string(metric.id)] = {{"value", number_or_name(metric.worst)},
                                               {"pair", metric.worst_at->name},
                                               {"mean", number_or_name(metric.mean)}};
  record["missing"] = report.missing;
  record["extra"] = report.extra;
  record["linksNotFollowed"] = report.not_followed;
  record["pairs"] = Json::array();
  for (const PairReport& pair : report.pairs) {
    Json entry = {{"name", pair.name}};
    if (pair.comparison)
      entry["comparison"] = pair_record(pair);
    else
      entry["error"] = pair.error;
    record["pairs"].push_back(std::move(entry));
  }
  return record;
}

}  // namespace lobelia
