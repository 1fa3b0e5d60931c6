#include "studies/verdicts/verdicts.hpp"

#include <fmt/format.h>

#include "base/system/files.hpp"
#include "studies/table.hpp"

namespace lobelia::verdicts {
namespace {

std::string cell_name(const records::VerdictCell& cell) {
  return fmt::format("{} px, {} samples, {} pictures", cell.size, cell.samples, cell.replicates);
}

studies::Table table_of(const records::VerifyVerdicts& verdicts) {
  studies::Table table{"",
                       {{"noise", -10},
                        {"size", 5},
                        {"samples", 8},
                        {"pictures", 9},
                        {"false alarms", 13},
                        {"at most", 8}},
                       {}};
  if (verdicts.cells.empty()) return table;
  const auto& changes = verdicts.cells.front().changes;
  for (std::size_t i = 1; i < changes.size(); ++i)
    table.columns.push_back({changes[i].change, int(changes[i].change.size()) + 1});
  for (const records::VerdictCell& cell : verdicts.cells) {
    const records::VerdictsOfChange& none = cell.changes.front();
    std::vector<studies::Cell> row{
        cell.noise,
        cell.size,
        cell.samples,
        cell.replicates,
        fmt::format("{}{} of {}", cell.holds ? "" : "OUTSIDE ", none.different, none.pairs),
        cell.most_false};
    for (std::size_t i = 1; i < cell.changes.size(); ++i)
      row.emplace_back(
          cell.changes[i].pairs == 0
              ? ""
              : fmt::format("{} of {}", cell.changes[i].different, cell.changes[i].pairs));
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace

std::string report_text(const records::VerifyVerdicts& verdicts) {
  studies::Table table = table_of(verdicts);
  int alarms = 0, pairs = 0;
  for (const records::VerdictCell& cell : verdicts.cells) {
    alarms += cell.changes.front().different;
    pairs += cell.changes.front().pairs;
  }
  if (!verdicts.left_out.empty())
    table.remarks.push_back(fmt::format("cycles: left out, {}", verdicts.left_out));
  table.remarks.push_back(fmt::format("{} false alarms in {} pairs; promised: at most {:g} of them",
                                      alarms, pairs, verdicts.significance));
  table.remarks.push_back(
      verdicts.outside == 0
          ? "Every kind of noise keeps the promise."
          : fmt::format("{} kinds of noise have more than {:g} times what was promised.",
                        verdicts.outside, kMostOfPromise));
  return studies::table_text(table);
}

std::string report_markdown(const records::VerifyVerdicts& verdicts) {
  return studies::table_markdown(table_of(verdicts));
}

std::vector<Chart> charts(const records::VerifyVerdicts& verdicts) {
  constexpr int kStyles = 5;
  std::vector<Chart> charts;
  for (const records::VerdictCell& cell : verdicts.cells) {
    if (charts.empty() || charts.back().id != "verdicts-" + cell.noise) {
      Chart& chart = charts.emplace_back();
      chart.id = "verdicts-" + cell.noise;
      chart.title = fmt::format("Called different under noise: {}", cell.noise);
      chart.description =
          "The share of pairs that are called different over the share of light that "
          "one of them lacks. At 0 it is that of false alarms.";
      chart.width = 1080;
      chart.height = 420;
      chart.x = {"share of light that is missing", 0, 0.3};
      chart.y = {"share called different", 0, 1};
    }
    std::vector<ChartSeries>& all = charts.back().series;
    ChartSeries series{cell_name(cell), {}, {}, 1 + int(all.size()) % kStyles};
    for (const records::VerdictsOfChange& change : cell.changes)
      if (change.pairs > 0 && (change.change.empty() || change.dimmer > 0)) {
        series.x.push_back(change.dimmer);
        series.y.push_back(double(change.different) / change.pairs);
      }
    all.push_back(std::move(series));
  }
  return charts;
}

void write_charts(const std::filesystem::path& directory, const records::VerifyVerdicts& verdicts) {
  make_directories(directory);
  for (const Chart& chart : charts(verdicts))
    write_file(directory / (chart.id + ".svg"), draw_chart_file(chart));
}

}  // namespace lobelia::verdicts
