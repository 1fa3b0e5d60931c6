#include "farm/chunk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/host.hpp"
#include "core/text.hpp"
#include "records/record.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

/// Engines as the plan has them; whether they are here is seen when they are asked for a picture.
std::vector<FarmEngine> planned_engines(const records::FarmChunk& chunk) {
  std::vector<FarmEngine> engines;
  for (const auto& planned : chunk.engines)
    engines.push_back({make_engine(planned.name, planned.program), planned.name, planned.version,
                       planned.content});
  return engines;
}

struct ChunkCells {
  FarmCells farm;
  std::vector<Scene> scenes;
  std::vector<std::set<std::string>> jobs;  ///< names, by cell
};

ChunkCells read_cells(const records::FarmChunk& chunk, const std::string& file_name) {
  ChunkCells cells;
  for (const auto& one : chunk.cells) {
    Cell cell;
    cell.id = one.id;
    cell.engines = one.engines;
    cells.scenes.push_back(
        parse_scene(one.scene, fmt::format("{} ({})", file_name, printable(cell.id))));
    cells.jobs.emplace_back(one.jobs.begin(), one.jobs.end());
    cells.farm.cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace

records::FarmChunk chunk_record(FarmWork& work, const ResultCache& cache,
                                const FarmOptions& options, std::span<const JobIndex> jobs) {
  const JobGraph& graph = work.graph;
  records::FarmChunk record;
  own_identity().put_into(record);
  record.cache = cache.directory().string();
  record.limits = {options.time_limit.count(),
                   options.no_progress_limit.count(),
                   options.attempts,
                   options.memory,
                   options.disk,
                   options.give_up_after};
  if (!options.failed_directory.empty()) record.failed = options.failed_directory.string();
  for (const auto& here : work.engines) {
    const auto given = options.programs.find(here.name);
    record.engines.push_back(
        {here.name, here.version, here.content,
         given == options.programs.end() ? "" : std::filesystem::absolute(given->second).string()});
  }
  std::map<std::size_t, std::vector<std::string>> names;
  for (const JobIndex job : jobs) names[graph.cell_of(job)].push_back(graph.name(job));
  for (auto& [cell, of_cell] : names)
    record.cells.push_back({work.cells.cells[cell].id, work.cells.cells[cell].engines,
                            scene_to_xml(work.cells.scene(cell)), std::move(of_cell)});
  return record;
}

ChunkSummary exec_chunk(const std::filesystem::path& file, int threads) {
  const auto chunk = records::read_record<records::FarmChunk>(file);
  ChunkSummary summary;
  for (auto& why : identity_differences(OwnIdentity::of_record(chunk), own_identity()))
    summary.left.push_back({"", std::move(why)});
  JobRunOptions options;
  options.threads = threads;
  options.time_limit = std::chrono::duration<double>(chunk.limits.time_limit);
  options.no_progress_limit = std::chrono::duration<double>(chunk.limits.no_progress_limit);
  options.attempts = chunk.limits.attempts;
  options.memory = chunk.limits.memory;
  options.disk = chunk.limits.disk;
  options.give_up_after = chunk.limits.give_up_after;
  options.leave_undone = true;
  options.failed_directory = chunk.failed.value_or("");
  if (chunk.failed && !options.failed_directory.is_absolute())
    throw Error(ExitCode::kInput, fmt::format("{}: 'failed' is no absolute path", file.string()));
  const std::vector<FarmEngine> engines = planned_engines(chunk);
  for (const auto& planned : chunk.engines)
    if (!planned.program.empty()) options.programs[planned.name] = planned.program;
  ChunkCells cells = read_cells(chunk, file.filename().string());
  cells.farm.scene = [&](std::size_t cell) { return cells.scenes[cell]; };
  JobGraph graph(cells.farm, engines);
  const auto is_of_chunk = [&](JobIndex job) {
    return graph[job].exists && cells.jobs[graph.cell_of(job)].contains(graph.name(job));
  };
  for (const auto& cell : cells.jobs) summary.jobs += cell.size();
  if (!summary.left.empty())
    for (auto& cell : cells.jobs) cell.clear();
  for (std::size_t e = 0; e < engines.size(); ++e) {
    std::vector<JobIndex> pictures;
    for (std::size_t cell = 0; cell < graph.cell_count(); ++cell)
      if (is_of_chunk(graph.reference(cell, e))) pictures.push_back(graph.reference(cell, e));
    if (pictures.empty()) continue;
    std::string why = engine_difference(engines[e], options.programs);
    if (why.empty()) continue;
    summary.left.push_back({engines[e].name, std::move(why)});
    for (const JobIndex job : pictures) cells.jobs[graph.cell_of(job)].erase(graph.name(job));
  }
  const ResultCache cache(chunk.cache);
  const auto in_use = cache.use();
  remove_abandoned_temporaries();
  JobRun run(
      graph, cache, options,
      job_states(graph, &cache,
                 {.wanted = is_of_chunk, .failures = JobStateFilter::Failures::kOfOthersCount}));
  std::vector<std::size_t> order(graph.cell_count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  run.run(order, [](std::size_t) {});
  summary.work = run.work();
  std::ranges::copy(summary.work.engines_given_up, std::back_inserter(summary.left));
  for (JobIndex job = 0; job < graph.size(); ++job) {
    if (!is_of_chunk(job)) continue;
    if (run.state(job) == JobState::kDone) ++summary.done;
    if (run.state(job) == JobState::kFailed) ++summary.failed;
    if (run.state(job) == JobState::kAbsent) ++summary.undone;
  }
  return summary;
}

}  // namespace lobelia
