#include "farm/farm.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "core/error.hpp"
#include "farm/farm_session.hpp"

namespace lobelia {
namespace fs = std::filesystem;

fs::path cache_directory(const fs::path& wanted, const fs::path& farm_directory) {
  if (!wanted.empty()) return wanted;
  if (const char* from_environment = std::getenv("LOBELIA_CACHE");
      from_environment && *from_environment)
    return from_environment;
  return farm_directory / "cache";
}

FarmSummary run_farm(const Grid& grid, const fs::path& directory, const FarmOptions& options) {
  // Somebody may take results away while the farm is at work.
  constexpr int kMostRounds = 4;
  FarmOptions now = options;
  std::size_t made = 0, pictures = 0;
  for (int round = 1;; ++round) {
    FarmSession session(grid, directory, now);
    JobRun run(session.work().graph, session.cache(), now, session.states());
    try {
      run.run(session.waiting_cells(), [&](std::size_t cell) { session.finish_cell(cell); });
    } catch (...) {
      try {
        session.show_what_is_there();
      } catch (const Error&) {  // the first failure is the one to tell
      }
      throw;
    }
    session.write_farm_record();
    JobRunWork work = run.work();
    work.made = made += work.made;
    work.pictures = pictures += work.pictures;
    FarmSummary summary = session.summarise(work);
    if (!session.has_lost(run) || (options.fail_fast && summary.failed > 0)) return summary;
    if (round == kMostRounds)
      throw Error(
          ExitCode::kOutput,
          fmt::format("{}: results vanish while the farm is at work; the same command makes "
                      "them again",
                      session.cache().directory().string()));
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
