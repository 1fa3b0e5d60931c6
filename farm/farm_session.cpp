#include "farm/farm_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <unordered_set>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/host.hpp"
#include "core/removal.hpp"
#include "core/text.hpp"
#include "core/threads.hpp"
#include "farm/failed_jobs.hpp"
#include "records/record.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// Whatever is in one of them may be taken away as none of its own.
void require_apart(const fs::path& cache, const fs::path& directory) {
  const fs::path a = fs::weakly_canonical(fs::absolute(cache)),
                 b = fs::weakly_canonical(fs::absolute(directory));
  const auto is_in = [](const fs::path& inner, const fs::path& outer) {
    const fs::path between = inner.lexically_relative(outer);
    return !between.empty() && *between.begin() != "..";
  };
  bool inside = is_in(a, b / "cells");
  for (const char* part : {"results", "failures", "making"}) inside = inside || is_in(b, a / part);
  if (inside)
    throw Error(
        ExitCode::kUsage,
        fmt::format("{}: the cache {} may not lie among a farm's cells, nor a farm in a cache",
                    directory.string(), cache.string()));
}

}  // namespace

FarmWork::FarmWork(const Grid& g, const FarmOptions& options, const fs::path& directory)
    : grid(g),
      cells{cells_of(g), [this](std::size_t i) { return scene_of(grid, cells.cells[i]); }},
      engines(find_engines(g.engines, {options.programs, options.require_engines, directory,
                                       options.engines_as_recorded})),
      graph(cells, engines) {}

std::vector<std::string> FarmWork::absences() const {
  std::vector<std::string> sentences;
  for (const auto& here : engines)
    if (!here.is_here()) sentences.push_back(absence(here));
  return sentences;
}

std::vector<std::string> FarmWork::refusals() const {
  std::vector<std::string> sentences;
  for (std::size_t e = 0; e < engines.size(); ++e)
    if (const std::size_t count = graph.refusals(e); count > 0)
      sentences.push_back(fmt::format("{} cannot show {} of {} cells; each cell.json says why",
                                      engines[e].engine->info().title, count, graph.cell_count()));
  return sentences;
}

JobStateFilter FarmWork::filter(const FarmOptions& options) const {
  JobStateFilter filter;
  if (!options.filter.picks_everything())
    filter.wanted = [&](JobIndex job) { return options.filter.picks(graph.name(job)); };
  if (options.again)
    filter.again = [&](JobIndex job) {
      return graph[job].kind != JobKind::kReference || engines[graph[job].engine].is_here();
    };
  return filter;
}

std::string FarmWork::filter_warning(const JobFilter& filter) const {
  if (filter.picks_everything()) return "";
  std::string first;
  for (JobIndex job = 0; job < graph.size(); ++job) {
    if (!graph[job].exists) continue;
    const std::string name = graph.name(job);
    if (filter.picks(name)) return "";
    if (first.empty()) first = name;
  }
  if (first.empty()) return "";
  return fmt::format("--filter '{}' picks no job of this grid; the first is named '{}'",
                     printable(filter.text()), first);
}

namespace {
const Grid& checked(const Grid& grid) {
  if (grid.cell_count() > kMaxFarmCells)
    throw Error(
        ExitCode::kInput,
        fmt::format("{}: {} cells; a farm has at most {}: cut the grid into several, which may "
                    "share a cache (--cache)",
                    grid.file_name, grid.cell_count(), kMaxFarmCells));
  return grid;
}

/// Says at once, not after the first picture or a night, that a part of it is a link, or that no gallery can be written.
const fs::path& made(const fs::path& directory, const FarmOptions& options) {
  require_apart(cache_directory(options.cache, directory), directory);
  if (!options.gallery.empty()) {
    make_directories(options.gallery);
    require_writable(options.gallery / "index.html");
  }
  make_directories(directory);
  const HeldDirectory held(directory);
  for (const std::string& link : held.links())
    if (link == "cells" || link == "farm.json")
      throw Error(ExitCode::kOutput, fmt::format("{}: a symbolic link, which is not followed",
                                                 (directory / link).string()));
  return directory;
}
}  // namespace

FarmSession::FarmSession(const Grid& grid, const fs::path& directory, const FarmOptions& options)
    : work_(checked(grid), options, directory),
      directory_(directory),
      options_(options),
      directory_in_use_(made(directory, options), FarmDirectoryLock::Use::kFarm),
      cache_(cache_directory(options.cache, directory)),
      in_use_(cache_.use()),
      lock_sharing_(cache_.lock_sharing()),
      status_(work_.graph.cell_count(), "missing") {
  summary_.absent_engines = work_.absences();
  summary_.refusals = work_.refusals();
  summary_.cells = work_.graph.cell_count();
  if (std::string warning = work_.filter_warning(options.filter); !warning.empty())
    summary_.warnings.insert(std::move(warning));
  cache_.remove_abandoned();
  remove_abandoned_temporaries();
  cache_.keep_content(own_libraries());
  for (const auto& engine : work_.engines) cache_.keep_content(engine.files);
  remove_abandoned_parts(HeldDirectory(directory_));
  look_at_cells();
  FailedJobs(options.failed_directory)
      .forget_if([&](const std::string& cell, const std::string& job) {
        return !is_to_be_made(cell, job);
      });
  // Now as well as at the end: a run that is killed has its record too.
  write_farm_record();
}

void FarmSession::look_at_cells() {
  const std::size_t count = work_.graph.cell_count();
  std::vector<std::uint8_t> unfinished(count);
  const auto before = std::chrono::steady_clock::now();
  ThreadLimit(options_.threads).run([&] {
    states_ = job_states(work_.graph, &cache_, work_.filter(options_),
                         [&](std::size_t cell, const CellStates& found) {
                           unfinished[cell] = !look_at(cell, found);
                         });
  });
  summary_.cached_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  for (const std::size_t cell : coarse_to_fine(work_.cells.cells))
    if (unfinished[cell]) waiting_cells_.push_back(cell);
}

/// The cell may be of another grid.
bool FarmSession::is_to_be_made(const std::string& cell, const std::string& job) const {
  const JobGraph& graph = work_.graph;
  for (std::size_t i = 0; i < graph.cell_count(); ++i)
    if (work_.cells.cells[i].id == cell)
      return std::ranges::any_of(graph.jobs(i), [&](JobIndex j) {
        return states_[j] != JobState::kDone && graph.name_in_cell(j) == job;
      });
  return false;
}

/// Whether everything of the cell is there. Where it is not, its record goes: it would speak of other results.
bool FarmSession::look_at(std::size_t cell, const CellStates& found) {
  const JobGraph& graph = work_.graph;
  bool complete = true;
  std::size_t kept = 0;
  for (const JobIndex job : graph.jobs(cell)) {
    const Job& one = graph[job];
    if (found.states[graph.place(job)] == JobState::kDone) {
      cache_.touch(one.key);
      if (is_picture(one.kind)) ++kept;
      continue;
    }
    complete = false;
    if (found.records[graph.place(job)]) cache_.discard(one.key);  // it is made again
  }
  {
    const std::scoped_lock lock(mutex_);
    summary_.kept += kept;
    if (complete) ++summary_.cached_cells;
    take_warnings(found.records);
  }
  const CellDirectory there = cell_directory(cell);
  if (!complete) {
    there.forget();
    return false;
  }
  status_[cell] = there.current_status(cache_, found.records);
  if (status_[cell].empty())
    status_[cell] = there.write(cache_, found.records, {});
  else
    there.remove_abandoned();
  return true;
}

void FarmSession::take_warnings(const CellRecords& records) {
  if (records[0] && records[0]->warnings)
    summary_.warnings.insert(records[0]->warnings->begin(), records[0]->warnings->end());
}

void FarmSession::finish_cell(std::size_t cell) {
  JobGraph& graph = work_.graph;
  CellRecords records = find_records(graph, cache_, cell);
  const auto is_there = [&](JobIndex job) { return records[graph.place(job)].has_value(); };
  const auto lacks_picture = [&](JobIndex job) {
    return graph[job].kind == JobKind::kReference && !is_there(job);
  };
  if (graph[graph.profile(cell)].exists && std::ranges::any_of(graph.jobs(cell), lacks_picture)) {
    graph.narrow_profile(cell, is_there);
    records = find_records(graph, cache_, cell);
  }
  std::vector<CellProblem> problems;
  for (const JobIndex job : graph.jobs(cell))
    if (const auto failure = is_there(job) ? std::nullopt : cache_.failure(graph[job].key))
      problems.push_back({{graph.whose(job), failure->message, failure->failure, failure->attempts},
                          cache_.failure_log(graph[job].key)});
  std::string status = cell_directory(cell).write(cache_, records, problems);
  const std::scoped_lock lock(mutex_);
  status_[cell] = std::move(status);
  take_warnings(records);
  for (const auto& problem : problems)
    summary_.problems.push_back(fmt::format("{}: {}: {}", work_.cells.cells[cell].id,
                                            problem.record.engine, problem.record.message));
}

void FarmSession::show_what_is_there() {
  const JobStateFilter what_is_there{.wanted = [](JobIndex) { return false; },
                                     .failures = JobStateFilter::Failures::kOfOthersCount,
                                     .look = ResultCache::Look::kName};
  for (const std::size_t cell : waiting_cells_)
    if (status_[cell] == "missing" &&
        std::ranges::any_of(cell_states(work_.graph, &cache_, what_is_there, cell).states,
                            [](JobState state) { return state != JobState::kAbsent; }))
      finish_cell(cell);
  write_farm_record();
}

void FarmSession::write_farm_record() const {
  const Grid& grid = work_.grid;
  records::Farm record;
  record.title = grid.title;
  record.grid = grid.file_name;
  record.command = shell_join(options_.command);
  record.host = records::this_host();
  record.cache = cache_.directory().lexically_proximate(fs::absolute(directory_)).string();
  record.locks = records::Locks{lock_sharing_.shared, lock_sharing_.why};
  for (const auto& axis : grid.axes) {
    records::Axis& one = record.axes.emplace_back();
    one.name = axis.name;
    for (const auto& value : axis.values) one.values.push_back({value.value, value.label});
  }
  record.engines = engines_record(work_.engines);
  for (std::size_t e = 0; e < work_.engines.size(); ++e)
    record.engines[e + 1].refused_cells = work_.graph.refusals(e);
  const std::scoped_lock lock(mutex_);
  for (std::size_t i = 0; i < status_.size(); ++i) {
    const Cell& cell = work_.cells.cells[i];
    records::FarmCell& one = record.cells.emplace_back();
    one.id = cell.id;
    one.status = status_[i];
    for (const auto& [name, value] : cell.axes) one.axes.emplace_back(name, value);
  }
  records::write_record(directory_ / "farm.json", record, AtLink::kReplace);
}

bool FarmSession::has_lost(const JobRun& run) const {
  return run.work().lost > 0 || std::ranges::any_of(waiting_cells_, [&](std::size_t cell) {
           return status_[cell] == "missing" &&
                  std::ranges::all_of(work_.graph.jobs(cell), [&](JobIndex job) {
                    return run.state(job) == JobState::kDone;
                  });
         });
}

std::size_t FarmSession::count_foreign_cells() const {
  std::unordered_set<std::string> ids;
  for (const auto& cell : work_.cells.cells) ids.insert(cell.id);
  std::size_t foreign = 0;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory_ / "cells", ignored))
    if (!ids.contains(entry.path().filename().string())) ++foreign;
  return foreign;
}

FarmSummary FarmSession::summarise(const JobRunWork& done) {
  summary_.foreign = count_foreign_cells();
  for (const auto& status : status_) {
    if (status == "pass") ++summary_.pass;
    if (status == "differs") ++summary_.differs;
    if (status == "undecided") ++summary_.undecided;
    if (status == "unchecked") ++summary_.unchecked;
    if (status == "failed") ++summary_.failed;
    if (status == "missing") ++summary_.missing;
  }
  std::sort(summary_.problems.begin(), summary_.problems.end());
  summary_.work = done;
  summary_.rendered = done.pictures;
  return summary_;
}

}  // namespace lobelia
