#include "farm/farm_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <unordered_set>

#include "base/records/farm_file.hpp"
#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/system/threads.hpp"
#include "base/words/text.hpp"
#include "farm/failed_jobs.hpp"
#include "farm/upkeep.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// Neither may lie among the files of the other, which may be removed at any time.
void require_apart(const fs::path& cache, const fs::path& directory) {
  const fs::path a = real_path(cache), b = real_path(directory);
  bool inside = is_below(a, b / "cells");
  for (const char* part : {"results", "failures", "making"})
    inside = inside || is_below(b, a / part);
  if (inside)
    throw Error(ExitCode::kUsage,
                "{}: the cache {} may not lie among a farm's cells, nor a farm in a cache",
                directory.string(), cache.string());
}

const Grid& checked(const Grid& grid) {
  if (grid.cell_count() > kMaxFarmCells)
    throw Error(ExitCode::kInput,
                "{}: {} cells; a farm has at most {}: cut the grid into several, which may "
                "share a cache (--cache)",
                grid.file_name, grid.cell_count(), kMaxFarmCells);
  return grid;
}

/// The leave for what the grid says. Throws Error(kUsage) if it starts a program without.
Leave leave_of(const Grid& grid, const FarmOptions& options) {
  const Leave leave = options.leave.said_by(grid.directory);
  if (!options.engines_as_recorded) require_leave_to_start(grid.outside, leave);
  return leave;
}

/// Makes the directory. Throws before any work starts if a part of it is a link, or the gallery cannot be written.
const fs::path& made(const fs::path& directory, const FarmOptions& options) {
  require_apart(cache_directory(options.cache, directory), directory);
  if (!options.gallery.empty()) {
    make_directories(options.gallery);
    require_writable(options.gallery / "index.html");
  }
  make_directories(directory);
  const HeldDirectory held(directory);
  for (const char* link : {"cells", "farm.json"})
    if (held.is_link(link))
      throw Error(ExitCode::kOutput, "{}: a symbolic link, which is not followed",
                  (directory / link).string());
  return directory;
}

}  // namespace

FarmWork::FarmWork(const Grid& g, const FarmOptions& options, const fs::path& directory)
    : grid(g),
      cells{cells_of(g), [this](std::size_t i) { return scene_of(grid, cells.cells[i]); }, g.truth,
            g.ours},
      engines(
          find_engines(g.engines, {options.programs, options.require_engines, directory,
                                   options.engines_as_recorded, g.outside, leave_of(g, options)})),
      graph(cells, engines, options.time_limit) {}

std::vector<std::string> FarmWork::absences() const {
  std::vector<std::string> sentences;
  for (const auto& here : engines)
    if (!here.is_here()) sentences.push_back(absence(here));
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
  for (std::size_t e = 0; e < work_.engines.size(); ++e)
    if (const std::size_t count = work_.graph.refusals(e); count > 0)
      summary_.refusals.push_back(
          fmt::format("{} cannot show {} of {} cells; each cell.json says why",
                      work_.engines[e].engine->info().title, count, work_.graph.cell_count()));
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
        const JobGraph& graph = work_.graph;
        const auto found = std::ranges::find(work_.cells.cells, cell, &Cell::id);
        return found == work_.cells.cells.end() ||
               std::ranges::none_of(
                   graph.jobs(std::size_t(found - work_.cells.cells.begin())), [&](JobIndex j) {
                     return states_[j] != JobState::kDone && graph.name_in_cell(j) == job;
                   });
      });
  // Written now and at the end: a killed run has its record too.
  write_farm_record();
}

void FarmSession::look_at_cells() {
  const std::size_t count = work_.graph.cell_count();
  std::vector<std::uint8_t> unfinished(count);
  const auto before = std::chrono::steady_clock::now();
  std::exception_ptr failure;
  GroupFlush flush({directory_}, [&](std::exception_ptr error) { failure = std::move(error); });
  ThreadLimit(options_.threads).run([&] {
    states_ = job_states(work_.graph, &cache_, work_.filter(options_),
                         [&](std::size_t cell, const CellStates& found) {
                           unfinished[cell] = !look_at(cell, found, flush);
                         });
  });
  flush.finish();
  if (failure) std::rethrow_exception(failure);
  summary_.cached_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  for (const std::size_t cell : coarse_to_fine(work_.cells.cells))
    if (unfinished[cell]) waiting_cells_.push_back(cell);
}

/// Whether the cell has all results. If not, removes its record, which is about other results.
bool FarmSession::look_at(std::size_t cell, const CellStates& found, GroupFlush& flush) {
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
  std::string status = there.current_status(cache_, found.records);
  if (status.empty()) {
    write_cell(cell, found.records, {}, flush);
    return true;
  }
  there.remove_abandoned();
  const std::scoped_lock lock(mutex_);
  status_[cell] = std::move(status);
  return true;
}

void FarmSession::write_cell(std::size_t cell, const CellRecords& records,
                             const std::vector<CellProblem>& problems, GroupFlush& flush) {
  cell_directory(cell).write(cache_, records, problems, flush,
                             [this, cell](const std::string& status) {
                               const std::scoped_lock lock(mutex_);
                               status_[cell] = status;
                             });
}

void FarmSession::take_warnings(const CellRecords& records) {
  if (records[0] && records[0]->warnings)
    summary_.warnings.insert(records[0]->warnings->begin(), records[0]->warnings->end());
}

void FarmSession::finish_cell(std::size_t cell, GroupFlush& flush) {
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
  // Another farm of this directory may have written it meanwhile, as a run on Slurm and its client do. It is left: its
  // record would be away until this one is flushed.
  std::string status = problems.empty() ? cell_directory(cell).current_status(cache_, records) : "";
  if (status.empty()) write_cell(cell, records, problems, flush);
  const std::scoped_lock lock(mutex_);
  if (!status.empty()) status_[cell] = std::move(status);
  take_warnings(records);
  for (const auto& problem : problems)
    summary_.problems.push_back(fmt::format("{}: {}: {}", work_.cells.cells[cell].id,
                                            problem.record.engine, problem.record.message));
}

void FarmSession::show_what_is_there() {
  const Uninterrupted to_the_end;
  const JobStateFilter what_is_there{.wanted = [](JobIndex) { return false; },
                                     .failures = JobStateFilter::Failures::kOfOthersCount,
                                     .look = ResultCache::Look::kName};
  GroupFlush flush({directory_}, [](const std::exception_ptr&) {});
  for (const std::size_t cell : waiting_cells_)
    if (status_[cell] == "missing" &&
        std::ranges::any_of(cell_states(work_.graph, &cache_, what_is_there, cell).states,
                            [](JobState state) { return state != JobState::kAbsent; }))
      finish_cell(cell, flush);
  flush.finish();
  write_farm_record();
}

void FarmSession::write_farm_record() const {
  const Grid& grid = work_.grid;
  records::Farm record;
  record.title = grid.title;
  record.authors = grid.authors;
  record.url = grid.url;
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
  record.reference = grid.truth;
  record.engines = engines_record(work_.engines, grid.ours);
  for (std::size_t e = 0; e < work_.engines.size(); ++e)
    record.engines[e + grid.ours].refused_cells = work_.graph.refusals(e);
  const std::scoped_lock lock(mutex_);
  records::write_farm(directory_ / "farm.json", record, status_.size(), [&](std::size_t i) {
    const Cell& cell = work_.cells.cells[i];
    records::FarmCell one{cell.id, status_[i], {}};
    for (const auto& [name, value] : cell.axes) one.axes.emplace_back(name, value);
    return one;
  });
}

bool FarmSession::has_lost(const std::vector<JobState>& states) const {
  // A cell with a failed job is "failed", unless nothing can be read of the failure.
  const auto has_ended = [&](JobIndex job) {
    return states[job] == JobState::kDone || states[job] == JobState::kFailed ||
           states[job] == JobState::kBlocked || !work_.graph[job].exists;
  };
  return std::ranges::any_of(waiting_cells_, [&](std::size_t cell) {
    return status_[cell] == "missing" && std::ranges::all_of(work_.graph.jobs(cell), has_ended);
  });
}

FarmSummary FarmSession::summarise(const JobRunWork& done) {
  std::unordered_set<std::string> ids;
  for (const auto& cell : work_.cells.cells) ids.insert(cell.id);
  summary_.foreign = 0;
  for (const std::string& name : HeldDirectory(directory_ / "cells").names())
    if (!ids.contains(name)) ++summary_.foreign;
  static_cast<records::StatusCounts&>(summary_) = count_statuses(status_);
  std::ranges::sort(summary_.problems);
  summary_.work = done;
  summary_.rendered = done.pictures;
  return summary_;
}

fs::path cache_directory(const fs::path& wanted, const fs::path& farm_directory) {
  if (!wanted.empty()) return wanted;
  if (const char* from_environment = std::getenv("LOBELIA_CACHE");
      from_environment && *from_environment)
    return from_environment;
  return farm_directory / "cache";
}

FarmSummary run_farm(const Grid& grid, const fs::path& directory, const FarmOptions& options) {
  // Results may be removed while the farm is at work.
  constexpr int kMostRounds = 4;
  FarmOptions now = options;
  std::size_t made = 0, pictures = 0;
  for (int round = 1;; ++round) {
    FarmSession session(grid, directory, now);
    std::vector<JobState> states = session.states();
    JobRunWork work;
    try {
      work = run_jobs(
          session.work().graph, session.cache(), now, states, session.waiting_cells(), directory,
          [&](std::size_t cell, GroupFlush& flush) { session.finish_cell(cell, flush); });
    } catch (...) {
      try {
        session.show_what_is_there();
      } catch (const Error&) {  // the first failure matters more
      }
      throw;
    }
    session.write_farm_record();
    work.made = made += work.made;
    work.pictures = pictures += work.pictures;
    FarmSummary summary = session.summarise(work);
    const bool has_lost = work.lost > 0 || session.has_lost(states);
    if (!has_lost || (options.fail_fast && summary.failed > 0)) return summary;
    if (round == kMostRounds)
      throw Error(ExitCode::kOutput,
                  "{}: results vanish while the farm is at work; the same command makes "
                  "them again",
                  session.cache().directory().string());
    now.again = false;
  }
}

FarmPlan plan_farm(
    const Grid& grid, const fs::path& directory, const FarmOptions& options,
    const std::function<void(const std::string& name, const std::string& reason)>& on_job) {
  FarmWork work(grid, options, directory);
  JobGraph& graph = work.graph;
  std::optional<ResultCache> cache;
  std::error_code ignored;
  if (const fs::path there = cache_directory(options.cache, directory); fs::exists(there, ignored))
    cache.emplace(there, ResultCache::Opening::kLook);
  JobStateFilter filter = work.filter(options);
  filter.look = ResultCache::Look::kName;
  std::vector<std::uint8_t> is_there(graph.size());
  const std::vector<JobState> states = job_states(
      graph, cache ? &*cache : nullptr, filter, [&](std::size_t cell, const CellStates& found) {
        for (const JobIndex job : graph.jobs(cell))
          is_there[job] = found.records[graph.place(job)].has_value();
      });
  const bool has_cells = fs::exists(directory / "cells", ignored);
  FarmPlan plan;
  plan.cells = graph.cell_count();
  plan.absent_engines = work.absences();
  plan.warning = work.filter_warning(options.filter);
  for (const std::size_t cell : coarse_to_fine(work.cells.cells)) {
    const CellDirectory before(directory, graph, cell);
    for (const JobIndex job : graph.jobs(cell)) {
      ++plan.jobs;
      if (states[job] != JobState::kWaiting) continue;
      ++plan.wanted;
      on_job(graph.name(job), is_there[job]                             ? "again"
                              : cache && cache->failure(graph[job].key) ? "failed before"
                              : has_cells                               ? before.reason(job)
                                                                        : "missing");
    }
  }
  return plan;
}

}  // namespace lobelia
