// The report as its record and as a table of values.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "cost/pareto.hpp"
#include "cost/report.hpp"

namespace lobelia::cost {
namespace {

/// A value for each kind of error of the table.
records::Named<double> by_error(const Table& table, const std::vector<double>& values) {
  records::Named<double> named;
  for (std::size_t e = 0; e < table.errors.size(); ++e)
    named.emplace_back(table.errors[e].id, values[e]);
  return named;
}

records::CostWay way_record(const Table& table, const Way& way) {
  records::CostWay record;
  record.name = way.name;
  record.settings = way.settings;
  record.errors = by_error(table, way.errors);
  if (table.is_timed())
    record.seconds = records::CostSeconds{way.time.median, way.time.spread, way.time.least,
                                          way.time.most, way.time.rounds};
  else
    record.count = way.time.median;
  if (!way.error_spreads.empty()) record.error_spreads = by_error(table, way.error_spreads);
  records::Named<double> at_most;
  for (std::size_t e = 0; e < way.errors_at_most.size(); ++e)
    if (!std::isnan(way.errors_at_most[e]))
      at_most.emplace_back(table.errors[e].id, way.errors_at_most[e]);
  if (!at_most.empty()) record.errors_at_most = std::move(at_most);
  record.facts = way.facts;
  return record;
}

records::CostFront front_record(const Table& table, std::size_t error) {
  const Front front = pareto_front(table, error);
  records::CostFront record;
  for (const std::size_t i : front.ways) record.ways.push_back(table.ways[i].name);
  for (std::size_t i = 0; i < table.ways.size(); ++i)
    if (front.dominated_by[i] != kNone)
      record.dominated_by.emplace_back(table.ways[i].name, table.ways[front.dominated_by[i]].name);
  record.in_words = front_sentences(table, error);
  record.chart = table.id + "-" + table.errors[error].id + ".svg";
  return record;
}

records::CostTable table_record(const Table& table) {
  records::CostTable record;
  record.id = table.id;
  record.level = table.level;
  record.title = table.title;
  record.unit = table.unit;
  record.per = table.per;
  for (const ErrorKind& kind : table.errors) record.errors.push_back({kind.id, kind.meaning});
  for (const Way& way : table.ways) record.ways.push_back(way_record(table, way));
  for (std::size_t e = 0; e < table.errors.size(); ++e)
    record.fronts.emplace_back(table.errors[e].id, front_record(table, e));
  record.remarks = table.remarks;
  return record;
}

}  // namespace

records::Cost cost_record(const Report& report) {
  records::Cost record{report.command, report.host, report.instruction_set, {}};
  for (const Table& table : report.tables) record.tables.push_back(table_record(table));
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
