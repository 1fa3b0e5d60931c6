// The report as its record and as a table of values.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "cost/pareto.hpp"
#include "cost/report.hpp"

namespace lobelia::cost {
namespace {

Json way_json(const Table& table, const Way& way) {
  Json entry = {{"name", way.name}, {"settings", Json::object()}, {"errors", Json::object()}};
  if (table.is_timed())
    entry["seconds"] = {{"median", way.time.median},
                        {"spread", way.time.spread},
                        {"least", way.time.least},
                        {"most", way.time.most},
                        {"rounds", way.time.rounds}};
  else
    entry["count"] = way.time.median;
  for (const auto& [key, value] : way.settings) entry["settings"][key] = value;
  for (std::size_t e = 0; e < table.errors.size(); ++e)
    entry["errors"][table.errors[e].id] = number_or_name(way.errors[e]);
  if (!way.error_spreads.empty()) {
    entry["errorSpreads"] = Json::object();
    for (std::size_t e = 0; e < table.errors.size(); ++e)
      entry["errorSpreads"][table.errors[e].id] = number_or_name(way.error_spreads[e]);
  }
  for (std::size_t e = 0; e < way.errors_at_most.size(); ++e)
    if (!std::isnan(way.errors_at_most[e]))
      entry["errorsAtMost"][table.errors[e].id] = way.errors_at_most[e];
  if (!way.facts.empty()) entry["facts"] = way.facts;
  return entry;
}

Json table_json(const Table& table) {
  Json entry = {{"id", table.id},        {"level", table.level},     {"title", table.title},
                {"unit", table.unit},    {"per", table.per},         {"errors", Json::array()},
                {"ways", Json::array()}, {"fronts", Json::object()}, {"remarks", table.remarks}};
  for (const ErrorKind& kind : table.errors)
    entry["errors"].push_back({{"id", kind.id}, {"meaning", kind.meaning}});
  for (const Way& way : table.ways) entry["ways"].push_back(way_json(table, way));
  for (std::size_t e = 0; e < table.errors.size(); ++e) {
    Json names = Json::array(), by = Json::object();
    const Front front = pareto_front(table, e);
    for (const std::size_t i : front.ways) names.push_back(table.ways[i].name);
    for (std::size_t i = 0; i < table.ways.size(); ++i)
      if (front.dominated_by[i] != kNone)
        by[table.ways[i].name] = table.ways[front.dominated_by[i]].name;
    entry["fronts"][table.errors[e].id] = {{"ways", names},
                                           {"dominatedBy", by},
                                           {"inWords", front_sentences(table, e)},
                                           {"chart", table.id + "-" + table.errors[e].id + ".svg"}};
  }
  return entry;
}

}  // namespace

Json cost_record(const Report& report) {
  Json record = make_record("cost");
  record["command"] = report.command;
  record["host"] = report.host;
  record["instructionSet"] = report.instruction_set;
  record["tables"] = Json::array();
  for (const Table& table : report.tables) record["tables"].push_back(table_json(table));
  return record;
}

std::string cost_csv(const Report& report) {
  std::string text =
      "table,level,way,settings,per,unit,median,spread,least,most,rounds,error,value,error_spread,on_front,at_most\r\n";
  for (const Table& table : report.tables)
    for (std::size_t e = 0; e < table.errors.size(); ++e) {
      const Front front = pareto_front(table, e);
      for (std::size_t i = 0; i < table.ways.size(); ++i) {
        const Way& way = table.ways[i];
        std::string settings;
        for (const auto& [key, value] : way.settings)
          settings += fmt::format("{}{}={}", settings.empty() ? "" : " ", key, value);
        const bool on_front =
            std::find(front.ways.begin(), front.ways.end(), i) != front.ways.end();
        text += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", csv_field(table.id), table.level,
            csv_field(way.name), csv_field(settings), table.per, table.unit, way.time.median,
            way.time.spread, way.time.least, way.time.most, way.time.rounds, table.errors[e].id,
            way.errors[e], way.error_spreads.empty() ? "" : fmt::format("{}", way.error_spreads[e]),
            on_front ? "yes" : "no",
            e < way.errors_at_most.size() && !std::isnan(way.errors_at_most[e])
                ? fmt::format("{}", way.errors_at_most[e])
                : "");
      }
    }
  return text;
}

}  // namespace lobelia::cost
