// Error over time as a drawing, and all files of a report.
#include <fmt/format.h>

#include "core/error_time_chart.hpp"
#include "core/files.hpp"
#include "cost/pareto.hpp"
#include "cost/report.hpp"
#include "records/record.hpp"

namespace lobelia::cost {

std::string cost_chart(const Table& table, std::size_t error) {
  ErrorTimes times{table.id + "-" + table.errors[error].id,
                   table.title,
                   table.per,
                   table.is_timed() ? "" : table.unit,
                   table.errors[error].meaning,
                   {}};
  const Front front = pareto_front(table, error);
  for (const Way& way : table.ways)
    times.points.push_back(
        {way.name,
         fmt::format("{}: {}, {} {:.3g}", way.name, cost_value_text(table, way.time.median),
                     table.errors[error].id, way.errors[error]),
         way.time.median, way.time.spread * way.time.median, way.errors[error],
         way.error_spreads.empty() ? 0 : way.error_spreads[error], false});
  for (const std::size_t i : front.ways) times.points[i].on_front = true;
  return draw_chart_file(error_time_chart(times));
}

void write_cost(const Report& report, const std::filesystem::path& directory) {
  make_directories(directory);
  for (const Table& table : report.tables)
    for (std::size_t e = 0; e < table.errors.size(); ++e)
      write_file(directory / (table.id + "-" + table.errors[e].id + ".svg"), cost_chart(table, e));
  write_file(directory / "cost.csv", cost_csv(report));
  records::write_record(directory / "cost.json", cost_record(report));
}

}  // namespace lobelia::cost
