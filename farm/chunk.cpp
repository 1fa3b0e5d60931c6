#include "farm/chunk.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <numeric>

#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/system/host.hpp"
#include "base/words/text.hpp"
#include "farm/slurm/slurm_answers.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// The engines of the plan. Whether they are here shows once they are asked for a picture.
std::vector<FarmEngine> planned_engines(const records::FarmChunk& chunk, const Leave& leave) {
  std::vector<FarmEngine> engines;
  for (const auto& planned : chunk.engines)
    engines.push_back({planned.outside ? make_outside_engine(*planned.outside, leave)
                                       : make_engine(planned.name, planned.program),
                       planned.name, planned.version, planned.content});
  return engines;
}

/// Lists what a chunk asks for, for refuse_without_leave().
std::vector<std::string> wishes_of_chunk(const records::FarmChunk& chunk) {
  std::vector<std::string> wishes{
      fmt::format("write into the cache '{}'", printable(chunk.cache, 1000))};
  if (chunk.failed)
    wishes.push_back(fmt::format("write into '{}'", printable(*chunk.failed, 1000)));
  for (const auto& engine : chunk.engines) {
    if (!engine.program.empty()) wishes.push_back(start_of(engine.name, engine.program));
    if (!engine.outside) continue;
    std::ranges::move(starts_of(*engine.outside), std::back_inserter(wishes));
    if (!engine.outside->files.empty())
      wishes.push_back(
          fmt::format("read pictures in '{}'", printable(engine.outside->directory, 1000)));
  }
  return wishes;
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
    cell.tokens = one.axes;
    cells.scenes.push_back(
        parse_scene(one.scene, fmt::format("{} ({})", file_name, printable(cell.id))));
    cells.jobs.emplace_back(one.jobs.begin(), one.jobs.end());
    cells.farm.cells.push_back(std::move(cell));
  }
  return cells;
}

constexpr char kReportsDirectory[] = "reports";
constexpr std::size_t kMostReportBytes = 64 << 10;
constexpr std::size_t kMostLeft = 100;  // far more than there are engines
constexpr std::size_t kMostWhy = 500;   // bytes
constexpr std::size_t kMostProblems = 10;
constexpr std::size_t kMostReports = 2000;  // two rounds of 1000 elements

/// "7.json": 7
std::optional<std::size_t> number_of(const std::string& name) {
  long long number = 0;
  if (!parse_integer(name.substr(0, name.find('.')), number) || number < 0 ||
      name != fmt::format("{}.json", number))
    return {};
  return std::size_t(number);
}

bool is_engine_name(std::string_view name) {
  return name.size() <= 64 && std::ranges::all_of(name, [](unsigned char c) {
           return std::isalnum(c) || c == '-' || c == '_';
         });
}

std::string why_not_read(const HeldDirectory& directory, const std::string& name) {
  struct stat status {};
  if (::fstatat(directory.fd(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
    return std::strerror(errno);
  if (S_ISLNK(status.st_mode)) return "a link";
  if (!S_ISREG(status.st_mode)) return "not a regular file";
  return std::uint64_t(status.st_size) > kMostReportBytes
             ? fmt::format("over {} bytes", kMostReportBytes)
             : "it cannot be read";
}

ChunkReport parse_report(const std::string& text, std::size_t number) {
  auto record = records::parse_record<records::FarmChunkReport>(text, "");
  if (!is_node_name(record.node))
    throw Error(ExitCode::kInput, "'{}' is no name of a node", printable(record.node));
  for (LeftUndone& left : record.left) {
    if (!is_engine_name(left.engine))
      throw Error(ExitCode::kInput, "'{}' is no name of an engine", printable(left.engine));
    left.why = printable(left.why, kMostWhy);
  }
  return {std::move(record), number};
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
  record.truth = work.cells.truth;
  if (!work.cells.ours) record.ours = false;
  if (!options.failed_directory.empty()) record.failed = options.failed_directory.string();
  for (const auto& here : work.engines) {
    const fs::path program = program_for(options.programs, here.name);
    record.engines.push_back({here.name,
                              here.version,
                              here.content,
                              program.empty() ? "" : fs::absolute(program).string(),
                              {}});
    if (const OutsideEngine* outside = here.engine->outside())
      record.engines.back().outside = *outside;
  }
  std::map<std::size_t, std::vector<std::string>> names;
  for (const JobIndex job : jobs) names[graph.cell_of(job)].push_back(graph.name(job));
  for (auto& [cell, of_cell] : names)
    record.cells.push_back({work.cells.cells[cell].id, work.cells.cells[cell].engines,
                            work.cells.cells[cell].tokens, scene_to_xml(work.cells.scene(cell)),
                            std::move(of_cell)});
  return record;
}

ChunkSummary exec_chunk(const fs::path& file, int threads, const Leave& leave,
                        const std::optional<Sha256Digest>& planned) {
  const InputFile opened(file);
  const std::string text = read_file(opened, records::kMaxRecordBytes);
  if (planned && sha256(text) != *planned)
    throw Error(ExitCode::kInput, "{}: not the chunk that was submitted: its SHA-256 is {}, not {}",
                printable_path(file.string()), hex(sha256(text)), hex(*planned));
  const auto chunk = records::parse_record<records::FarmChunk>(text, file.string());
  const Leave trusted = leave.said_by(opened.real_path());
  if (!trusted) refuse_without_leave(wishes_of_chunk(chunk));
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
    throw Error(ExitCode::kInput, "{}: 'failed' is no absolute path", file.string());
  const std::vector<FarmEngine> engines = planned_engines(chunk, trusted);
  for (const auto& planned : chunk.engines)
    if (!planned.program.empty()) options.programs[planned.name] = planned.program;
  ChunkCells cells = read_cells(chunk, file.filename().string());
  cells.farm.truth = chunk.truth;
  cells.farm.ours = chunk.ours.value_or(true);
  cells.farm.scene = [&](std::size_t cell) { return cells.scenes[cell]; };
  JobGraph graph(cells.farm, engines, options.time_limit);
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
    std::string why = engine_difference(engines[e], options.programs, trusted);
    if (why.empty()) continue;
    summary.left.push_back({engines[e].name, std::move(why)});
    for (const JobIndex job : pictures) cells.jobs[graph.cell_of(job)].erase(graph.name(job));
  }
  const ResultCache cache(chunk.cache);
  const auto in_use = cache.use();
  remove_abandoned_temporaries();
  std::vector<JobState> states = job_states(
      graph, &cache, {.wanted = is_of_chunk, .failures = JobStateFilter::Failures::kOfOthersCount});
  std::vector<std::size_t> order(graph.cell_count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  summary.work = run_jobs(graph, cache, options, states, order, cache.directory(),
                          [](std::size_t, GroupFlush&) {});
  std::ranges::copy(summary.work.engines_given_up, std::back_inserter(summary.left));
  for (JobIndex job = 0; job < graph.size(); ++job) {
    if (!is_of_chunk(job)) continue;
    if (states[job] == JobState::kDone) ++summary.done;
    if (states[job] == JobState::kFailed) ++summary.failed;
    if (states[job] == JobState::kAbsent) ++summary.undone;
  }
  return summary;
}

std::string own_node_name() {
  const char* given = std::getenv("SLURMD_NODENAME");
  return given && is_node_name(given) ? given : host_name();
}

void write_chunk_report(const fs::path& run_directory, std::size_t number,
                        std::span<const LeftUndone> left) {
  if (left.empty()) return;
  const fs::path directory = run_directory / kReportsDirectory;
  const fs::path path = directory / fmt::format("{}.json", number);
  const std::string node = own_node_name();
  if (!is_node_name(node))
    throw Error(ExitCode::kOutput, "{}: '{}' is no name of a node", printable_path(path.string()),
                printable(node));
  make_directories(directory);
  for (const fs::path& one : {directory, path}) {
    std::error_code ignored;
    if (fs::is_symlink(fs::symlink_status(one, ignored)))
      throw Error(ExitCode::kOutput, "{}: a link; a report is not written through it",
                  printable_path(one.string()));
  }
  records::FarmChunkReport record;
  record.node = node;
  for (const LeftUndone& one : left.first(std::min(left.size(), kMostLeft)))
    record.left.push_back({one.engine, printable(one.why, kMostWhy)});
  records::write_record(path, record, AtLink::kReplace);
}

ChunkReports read_chunk_reports(const fs::path& run_directory, std::size_t first, std::size_t end) {
  ChunkReports found;
  const fs::path path = run_directory / kReportsDirectory;
  const auto problem = [&](const fs::path& where, std::string_view what) {
    if (found.problems.size() < kMostProblems)
      found.problems.push_back(
          fmt::format("{}: not taken for a report: {}", printable_path(where.string()), what));
  };
  const HeldDirectory directory = HeldDirectory(run_directory).below(kReportsDirectory);
  if (!directory && !directory.is_missing()) problem(path, directory.why_not());
  std::vector<std::size_t> numbers;
  for (const std::string& name : directory.names())
    if (const auto number = number_of(name); number && *number >= first && *number < end)
      numbers.push_back(*number);
  std::sort(numbers.begin(), numbers.end());
  if (numbers.size() > kMostReports) {
    problem(path, fmt::format("only the last {} of {} are read", kMostReports, numbers.size()));
    numbers.erase(numbers.begin(), numbers.end() - kMostReports);
  }
  for (const std::size_t number : numbers) {
    const std::string name = fmt::format("{}.json", number);
    try {
      const auto text = directory.read(name, kMostReportBytes);
      if (text)
        found.reports.push_back(parse_report(*text, number));
      else
        problem(path / name, why_not_read(directory, name));
    } catch (const Error& error) {
      problem(path / name, error.what());
    }
  }
  return found;
}

}  // namespace lobelia
