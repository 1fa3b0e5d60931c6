#include "reference_scenes/agreement/report.hpp"

namespace lobelia::agreement {
namespace {

Json target_json(const Target& target) {
  return {{target.relative ? "relative" : "ofPeak", target.limit}};
}

Json row_json(const Agreement& agreement, const Row& row) {
  const Case& one = agreement.cases[row.index];
  Json json = {{"group", kGroupNames[std::size_t(one.group)]},
               {"what", one.what},
               {"model", one.highlight.model},
               {"lobe", one.highlight.lobe},
               {"normalisation", one.highlight.normalisation},
               {"exponent", one.highlight.exponent},
               {"view", one.close_up ? "close-up" : "whole"},
               {"width", one.scene.film.width},
               {"height", one.scene.film.height},
               {"witness", row.witness.name}};
  if (row.why.empty()) {
    const Figures& f = row.figures;
    json["maxOfPeak"] = number_or_name(f.max_of_peak);
    json["rmsOfPeak"] = number_or_name(f.rms_of_peak);
    json["maxRelative"] = number_or_name(f.max_relative);
    json["ring"] = {{"pixels", f.ring_pixels},
                    {"over", f.ring_over},
                    {"allowed", one.ring_allowed},
                    {"maxOfPeak", number_or_name(f.ring_max_of_peak)}};
  } else {
    json["why"] = row.why;
  }
  if (const auto target = target_of(row.witness, one.highlight.exponent))
    json["target"] = target_json(*target);
  json["verdict"] = kVerdictNames[std::size_t(row.verdict)];
  return json;
}

Json soft_json(const SoftRow& row) {
  Json json = {{"what", row.what}, {"witness", row.witness.name}, {"counts", Json::array()}};
  for (const auto& count : row.counts)
    json["counts"].push_back({{"points", count.points},
                              {"values", count.statistics.values},
                              {"beyond", count.statistics.beyond},
                              {"rmsOfPeak", count.rms_of_peak}});
  if (!row.why.empty()) json["why"] = row.why;
  json["verdict"] = kVerdictNames[std::size_t(row.verdict)];
  return json;
}

}  // namespace

Json report_record(const Agreement& agreement, const std::vector<std::string>& command) {
  Json record = make_record("agreement");
  record["command"] = command;
  record["small"] = agreement.scope.small;
  record["engines"] = Json::array();
  for (const EngineHere& engine : agreement.engines) {
    Json json = {{"name", engine.info.name},
                 {"title", engine.info.title},
                 {"available", engine.status.available()},
                 {"state", state_name(engine.status.state)}};
    if (engine.status.available())
      json["version"] = engine.status.version;
    else
      json["why"] = engine.status.why;
    record["engines"].push_back(std::move(json));
  }
  record["verdicts"] = Json::object();
  for (std::size_t v = 0; v < std::size(kVerdictNames); ++v)
    record["verdicts"][std::string(kVerdictNames[v])] = agreement.count(Verdict(v));
  record["rows"] = Json::array();
  for (const Row& row : agreement.rows) record["rows"].push_back(row_json(agreement, row));
  record["soft"] = Json::array();
  for (const SoftRow& row : agreement.soft) record["soft"].push_back(soft_json(row));
  return record;
}

}  // namespace lobelia::agreement
