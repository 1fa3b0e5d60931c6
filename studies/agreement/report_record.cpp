#include "studies/agreement/report.hpp"

namespace lobelia::agreement {
namespace {

records::AgreementRow row_record(const Agreement& agreement, const Row& row) {
  const Case& one = agreement.cases[row.index];
  records::AgreementRow record;
  record.group = kGroupNames[std::size_t(one.group)];
  record.what = one.what;
  record.model = one.highlight.model;
  record.lobe = one.highlight.lobe;
  record.normalisation = one.highlight.normalisation;
  record.exponent = one.highlight.exponent;
  record.view = one.close_up ? "close-up" : "whole";
  record.width = one.scene.film.width;
  record.height = one.scene.film.height;
  record.witness = row.variant.name;
  record.why = row.why;
  if (row.why.empty()) {
    const Figures& f = row.figures;
    record.max_of_peak = f.max_of_peak;
    record.rms_of_peak = f.rms_of_peak;
    record.max_relative = f.max_relative;
    record.ring = records::Ring{f.ring_pixels, f.ring_over, one.ring_allowed, f.ring_max_of_peak};
  }
  if (const auto target = target_of(row.variant, one.highlight.exponent)) {
    records::Target& asked = record.target.emplace();
    (target->relative ? asked.relative : asked.of_peak) = target->limit;
  }
  record.verdict = kVerdictNames[std::size_t(row.verdict)];
  return record;
}

records::SoftRow soft_record(const SoftRow& row) {
  records::SoftRow record;
  record.what = row.what;
  record.witness = row.variant.name;
  for (const auto& count : row.counts)
    record.counts.push_back(
        {count.points, count.statistics.values, count.statistics.beyond, count.rms_of_peak});
  record.why = row.why;
  record.verdict = kVerdictNames[std::size_t(row.verdict)];
  return record;
}

}  // namespace

records::Agreement report_record(const Agreement& agreement,
                                 const std::vector<std::string>& command) {
  records::Agreement record;
  record.command = command;
  record.small = agreement.scope.small;
  for (const EngineHere& engine : agreement.engines) {
    records::AgreementEngine& one = record.engines.emplace_back();
    one.name = engine.info.name;
    one.title = engine.info.title;
    one.available = engine.status.available();
    one.state = state_name(engine.status.state);
    (one.available ? one.version : one.why) =
        one.available ? engine.status.version : engine.status.why;
  }
  for (std::size_t v = 0; v < std::size(kVerdictNames); ++v)
    record.verdicts.emplace_back(kVerdictNames[v], agreement.count(Verdict(v)));
  for (const Row& row : agreement.rows) record.rows.push_back(row_record(agreement, row));
  for (const SoftRow& row : agreement.soft) record.soft.push_back(soft_record(row));
  return record;
}

}  // namespace lobelia::agreement
