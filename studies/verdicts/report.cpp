#include "studies/verdicts/verdicts.hpp"

#include <fmt/format.h>

#include "studies/table.hpp"

namespace lobelia::verdicts {
namespace {

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

}  // namespace lobelia::verdicts
