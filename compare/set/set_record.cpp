// A set of comparisons as its record.
#include "compare/set/report.hpp"

namespace lobelia {

records::Comparison pair_record(const PairReport& pair) {
  records::Comparison record = comparison_record(*pair.comparison, pair.a, pair.b, pair.c);
  if (pair.sources) record.pictures = pictures_record(pair.sources->a, pair.sources->b);
  if (pair.layers) add_layers(record, pair.verdict(), *pair.layers);
  return record;
}

records::ComparisonSet set_record(const SetReport& report) {
  records::ComparisonSet record;
  record.a = report.a;
  record.b = report.b;
  record.c = report.c;
  record.summary = count(report);
  const SetNotCompared left = not_compared(report);
  record.not_compared = {left.all.layers, left.all.alpha, left.all.overscan_pixels,
                         left.all.mip_levels, left.pairs};
  for (const MetricSummary& metric : summarise(report.pairs))
    record.worst.emplace_back(
        metric.id, records::WorstOfSet{metric.worst, metric.worst_at->name, metric.mean});
  record.missing = report.missing;
  record.extra = report.extra;
  record.links_not_followed = report.not_followed;
  for (const PairReport& pair : report.pairs) {
    records::PairOfSet& one = record.pairs.emplace_back();
    one.name = pair.name;
    if (pair.comparison)
      one.comparison = pair_record(pair);
    else
      one.error = pair.error;
  }
  return record;
}

}  // namespace lobelia
