#include "gallery/cells/history.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <ctime>

#include "base/system/error.hpp"
#include "base/system/no_resources.hpp"
#include "base/words/text.hpp"
#include "gallery/cells/cell_page.hpp"

namespace lobelia::gallery {
namespace {

namespace fs = std::filesystem;

using AxisValues = std::map<std::string, std::string>;  ///< value by axis

bool is_link(const fs::path& path) {
  std::error_code ignored;
  return fs::is_symlink(fs::symlink_status(path, ignored));
}

/// "2026-11-20", in UTC.
std::string date_of(const fs::path& run) {
  struct stat status {};
  std::tm parts{};
  if (::stat((run / "farm.json").c_str(), &status) != 0 || !::gmtime_r(&status.st_mtime, &parts))
    return "an unknown day";
  return fmt::format("{:04}-{:02}-{:02}", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday);
}

/// The directory's own name, also of "." and of a path with a slash at its end.
std::string name_of(const fs::path& run) {
  std::error_code error;
  const fs::path whole = fs::canonical(run, error);
  return printable((error ? run : whole).filename().string());
}

AxisValues place_of(const records::FarmCell& cell, bool by_last_part) {
  AxisValues place;
  for (const auto& [axis, value] : cell.axes)
    place[axis] = by_last_part ? value.substr(value.rfind('/') + 1) : value;
  return place;
}

/// One of these with the same id, or the only one.
std::optional<std::size_t> pick(const std::vector<std::size_t>& places, const std::string& id,
                                const records::Farm& farm) {
  for (const std::size_t i : places)
    if (farm.cells[i].id == id) return i;
  return places.size() == 1 ? std::optional(places.front()) : std::nullopt;
}

void match_by(bool by_last_part, const records::Farm& now, const records::Farm& earlier,
              std::vector<std::optional<std::size_t>>& match) {
  std::vector<bool> is_taken(earlier.cells.size());
  for (const auto& place : match)
    if (place) is_taken[*place] = true;
  std::map<AxisValues, std::vector<std::size_t>> cells_at;
  for (std::size_t i = 0; i < earlier.cells.size(); ++i)
    if (!is_taken[i]) cells_at[place_of(earlier.cells[i], by_last_part)].push_back(i);
  for (std::size_t i = 0; i < now.cells.size(); ++i) {
    if (match[i]) continue;
    const auto found = cells_at.find(place_of(now.cells[i], by_last_part));
    if (found == cells_at.end()) continue;
    match[i] = pick(found->second, now.cells[i].id, earlier);
    if (match[i]) std::erase(found->second, *match[i]);
  }
}

/// The first link among the places that the cell's records are read from; empty if there is none. Throws Error(kInput) if
/// the system cannot tell.
std::string link_in(const fs::path& run, const std::string& id) {
  const fs::path cells = run / "cells", here = cells / id;
  if (is_link(cells)) return "cells";
  if (is_link(here)) return id;
  std::error_code error;
  for (fs::directory_iterator at(here, error), end; !error && at != end; at.increment(error))
    if (is_link(at->path())) return at->path().filename().string();
  if (error && !tells_of_file(error.value()))
    throw failure_of(here.string() + ": cannot be listed", error.value(), ExitCode::kInput);
  return "";
}

CheckedCell check_earlier_cell(const EarlierRun& run, const CellEntry& entry) {
  const std::string link = link_in(run.directory, entry.id);
  if (link.empty())
    return check_cell(run.directory, entry, run.farm.metrics, run.farm.hub, run.farm.texts.get());
  CheckedCell cell;
  cell.id = entry.id;
  cell.hub = run.farm.hub;
  cell.status = CellStatus::kDamaged;
  cell.unreadable = printable(link) + " is a link, and links are not followed.";
  return cell;
}

TimePoint point_of(const CheckedCell& cell, const std::string& engine, const std::string& metric,
                   std::string date, std::string name) {
  TimePoint point{std::move(date), std::move(name), {}, {}, "not compared"};
  const CheckedComparison* comparison = cell.find_comparison(engine);
  if (!comparison) return point;
  point.verdict = verdict_words(*comparison);
  if (comparison->doubt || !comparison->problem.empty()) return point;
  point.value = comparison->metric(metric);
  const records::Named<double> limits = limits_of(comparison->record);
  if (const double* limit = records::find(limits, metric)) point.limit = *limit;
  return point;
}

}  // namespace

std::string History::since() const {
  return fmt::format("{} ({})", baseline().date, baseline().name);
}

std::vector<const CellEntry*> History::gone() const {
  std::vector<bool> is_there(baseline().farm.cells.size());
  for (const auto& place : baseline().match)
    if (place) is_there[*place] = true;
  std::vector<const CellEntry*> gone;
  for (std::size_t i = 0; i < is_there.size(); ++i)
    if (!is_there[i]) gone.push_back(&baseline().farm.cells[i]);
  return gone;
}

std::vector<std::optional<std::size_t>> match_cells(const records::Farm& now,
                                                    const records::Farm& earlier) {
  std::vector<std::optional<std::size_t>> match(now.cells.size());
  for (const bool by_last_part : {false, true}) match_by(by_last_part, now, earlier, match);
  return match;
}

History read_history(const fs::path& run, const ShownFarm& farm,
                     const std::vector<fs::path>& earlier) {
  History history{date_of(run), {}};
  for (const fs::path& directory : earlier) {
    std::error_code ignored;
    if (fs::equivalent(directory, run, ignored))
      throw Error(ExitCode::kUsage,
                  "--baseline: '{}' is RUN itself; give the folder of an earlier run",
                  printable(directory.string()));
    if (is_link(directory / "farm.json"))
      throw Error(ExitCode::kInput,
                  (directory / "farm.json").string() + ": a link; links are not followed");
    EarlierRun one{directory,
                   name_of(directory),
                   date_of(directory),
                   read_farm(directory, farm.metrics, farm.texts),
                   {}};
    one.match = match_cells(farm.record, one.farm.record);
    history.runs.push_back(std::move(one));
  }
  return history;
}

CellHistory history_of(const History& history, const ShownFarm& farm, std::size_t index,
                       const CheckedCell& cell) {
  CellHistory result;
  result.change.change = Change::kNew;
  for (const CheckedComparison& comparison : cell.comparisons)
    if (std::string metric = main_metric(comparison.record); !metric.empty())
      result.timelines.push_back({cell.other_of(comparison), std::move(metric), {}});
  const auto add_points = [&](const CheckedCell& at, const std::string& date,
                              const std::string& name) {
    for (Timeline& line : result.timelines)
      line.points.push_back(point_of(at, line.engine, line.metric, date, name));
  };
  for (const EarlierRun& run : history.runs) {
    const auto place = run.match[index];
    CheckedCell was;
    was.hub = run.farm.hub;
    if (place) was = check_earlier_cell(run, run.farm.cells[*place]);
    add_points(was.hub == cell.hub ? was : CheckedCell{}, run.date, run.name);
    if (&run != &history.baseline() || !place) continue;
    result.change = compare_cells(was, cell, farm);
    result.before = std::move(was);
  }
  add_points(cell, history.date, "this run");
  return result;
}

}  // namespace lobelia::gallery
