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
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

/// As the options of the command line are held to.
double limit(const Json& chunk, const char* name, double least, double most) {
  const double value = chunk.at("limits").at(name).get<double>();
  if (!(value >= least && value <= most))
    throw Error(ExitCode::kInput, fmt::format("a chunk's limit {} is {}; allowed: {} to {}", name,
                                              value, least, most));
  return value;
}

/// Engines as the plan has them; whether they are here is seen when they are asked for a picture.
std::vector<FarmEngine> planned_engines(const Json& chunk) {
  std::vector<FarmEngine> engines;
  for (const auto& planned : chunk.at("engines").get_ref<const Json::array_t&>()) {
    const std::string name = planned.at("name");
    engines.push_back({make_engine(name, planned.value("program", std::string())), name,
                       planned.at("version").get<std::string>(),
                       planned.at("content").get<std::string>()});
  }
  return engines;
}

struct ChunkCells {
  FarmCells farm;
  std::vector<Scene> scenes;
  std::vector<std::set<std::string>> jobs;  ///< names, by cell
};

ChunkCells read_cells(const Json& chunk, const std::string& file_name) {
  ChunkCells cells;
  for (const auto& one : chunk.at("cells").get_ref<const Json::array_t&>()) {
    Cell cell;
    cell.id = one.at("id");
    cell.engines = one.at("engines").get<std::vector<std::string>>();
    cells.scenes.push_back(parse_scene(one.at("scene").get<std::string>(),
                                       fmt::format("{} ({})", file_name, printable(cell.id))));
    cells.jobs.push_back(one.at("jobs").get<std::set<std::string>>());
    cells.farm.cells.push_back(std::move(cell));
  }
  return cells;
}

bool wants_pictures_of(const ChunkCells& cells, const std::string& engine) {
  for (std::size_t cell = 0; cell < cells.jobs.size(); ++cell)
    if (cells.jobs[cell].contains(job_name(cells.farm.cells[cell].id, JobKind::kReference, engine)))
      return true;
  return false;
}

/// Takes the pictures of an engine out of what is to be done.
void leave_out(ChunkCells& cells, const std::string& engine) {
  for (std::size_t cell = 0; cell < cells.jobs.size(); ++cell)
    cells.jobs[cell].erase(job_name(cells.farm.cells[cell].id, JobKind::kReference, engine));
}

/// What is to be done, and what is there of what that needs.
std::vector<JobState> states_of(const ChunkCells& cells, const JobGraph& graph,
                                const ResultCache& cache) {
  std::vector<JobState> states(graph.size(), JobState::kAbsent);
  for (std::size_t cell = 0; cell < graph.cell_count(); ++cell) {
    const CellRecords records = find_records(cache, graph, cell);
    for (std::size_t slot = 0; slot < records.size(); ++slot) {
      const JobIndex job = JobIndex(graph.render(cell) + slot);
      if (!graph[job].exists) continue;
      if (records[slot])
        states[job] = JobState::kDone;
      else if (cells.jobs[cell].contains(graph.name(job)))
        states[job] = JobState::kWaiting;
      else if (cache.failure(graph[job].key))
        states[job] = JobState::kFailed;
    }
    leave_out_what_waits_for_nothing(graph, states, cell);
  }
  return states;
}

}  // namespace

Json chunk_record(FarmWork& work, const ResultCache& cache, const FarmOptions& options,
                  std::span<const JobIndex> jobs) {
  const JobGraph& graph = work.graph;
  Json record = make_record("farm-chunk");
  own_identity().put_into(record);
  record["cache"] = cache.directory().string();
  record["limits"] = {{"timeLimit", options.time_limit.count()},
                      {"noProgressLimit", options.no_progress_limit.count()},
                      {"attempts", options.attempts},
                      {"memory", options.memory},
                      {"disk", options.disk},
                      {"giveUpAfter", options.give_up_after}};
  if (!options.failed_directory.empty()) record["failed"] = options.failed_directory.string();
  record["engines"] = Json::array();
  for (const auto& here : work.engines) {
    Json engine{{"name", here.name}, {"version", here.version}, {"content", here.content}};
    if (const auto given = options.programs.find(here.name); given != options.programs.end())
      engine["program"] = std::filesystem::absolute(given->second).string();
    record["engines"].push_back(std::move(engine));
  }
  std::map<std::size_t, Json> names;
  for (const JobIndex job : jobs) names[graph.cell_of(job)].push_back(graph.name(job));
  record["cells"] = Json::array();
  for (auto& [cell, of_cell] : names)
    record["cells"].push_back({{"id", work.cells.cells[cell].id},
                               {"engines", work.cells.cells[cell].engines},
                               {"scene", scene_to_xml(work.cells.scene(cell))},
                               {"jobs", std::move(of_cell)}});
  return record;
}

ChunkSummary exec_chunk(const std::filesystem::path& file, int threads) {
  const Json chunk = read_record(file, "farm-chunk");
  try {
    ChunkSummary summary;
    for (auto& why : identity_differences(OwnIdentity::of_record(chunk), own_identity()))
      summary.left.push_back({"", std::move(why)});
    JobRunOptions options;
    options.threads = threads;
    options.time_limit = std::chrono::duration<double>(limit(chunk, "timeLimit", 0.1, 1e6));
    options.no_progress_limit =
        std::chrono::duration<double>(limit(chunk, "noProgressLimit", 0, 1e6));
    options.attempts = int(limit(chunk, "attempts", 1, 100));
    options.memory = std::uint64_t(limit(chunk, "memory", 0, 1e18));
    options.disk = std::uint64_t(limit(chunk, "disk", 0, 1e18));
    options.give_up_after = int(limit(chunk, "giveUpAfter", 0, 1e6));
    options.leave_undone = true;
    options.failed_directory = chunk.value("failed", std::string());
    if (chunk.contains("failed") && !options.failed_directory.is_absolute())
      throw Error(ExitCode::kInput, fmt::format("{}: 'failed' is no absolute path", file.string()));
    const std::vector<FarmEngine> engines = planned_engines(chunk);
    for (std::size_t e = 0; e < engines.size(); ++e)
      if (const auto& planned = chunk.at("engines")[e]; planned.contains("program"))
        options.programs[engines[e].name] = planned.at("program").get<std::string>();
    ChunkCells cells = read_cells(chunk, file.filename().string());
    cells.farm.scene = [&](std::size_t cell) { return cells.scenes[cell]; };
    JobGraph graph(cells.farm, engines);
    for (const auto& cell : cells.jobs) summary.jobs += cell.size();
    if (summary.left.empty())
      for (const FarmEngine& planned : engines) {
        if (!wants_pictures_of(cells, planned.name)) continue;
        std::string why = engine_difference(planned, options.programs);
        if (why.empty()) continue;
        summary.left.push_back({planned.name, std::move(why)});
        leave_out(cells, planned.name);
      }
    else
      for (auto& cell : cells.jobs) cell.clear();
    const ResultCache cache(chunk.at("cache").get<std::string>());
    const auto in_use = cache.use();
    remove_abandoned_temporaries();
    JobRun run(graph, cache, options, states_of(cells, graph, cache));
    std::vector<std::size_t> order(graph.cell_count());
    std::iota(order.begin(), order.end(), std::size_t{0});
    run.run(order, [](std::size_t) {});
    summary.work = run.work();
    std::ranges::copy(summary.work.engines_given_up, std::back_inserter(summary.left));
    for (JobIndex job = 0; job < graph.size(); ++job) {
      if (!graph[job].exists || !cells.jobs[graph.cell_of(job)].contains(graph.name(job))) continue;
      if (run.state(job) == JobState::kDone) ++summary.done;
      if (run.state(job) == JobState::kFailed) ++summary.failed;
      if (run.state(job) == JobState::kAbsent) ++summary.undone;
    }
    return summary;
  } catch (const Json::exception& error) {
    throw Error(ExitCode::kInput,
                fmt::format("{}: not a chunk of a farm: {}", file.string(), error.what()));
  }
}

}  // namespace lobelia
