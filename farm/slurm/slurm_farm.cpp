#include "farm/slurm/slurm_farm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/system/host.hpp"
#include "base/system/removal.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr char kRunFile[] = "run.json";

fs::path chunk_file(const fs::path& run_directory, std::size_t number) {
  return run_directory / "chunks" / fmt::format("{}.json", number);
}

/// The jobs of a session that can still be done: without a result, and without a failure in this run.
class Missing {
 public:
  explicit Missing(FarmSession& session) : session_(session), graph_(session.work().graph) {}

  std::vector<SlurmJob> operator()() {
    // Includes jobs with a result at the start: it may have been removed.
    const JobStateFilter filter{
        .wanted = [&](JobIndex job) { return session_.states()[job] != JobState::kAbsent; },
        .failures = JobStateFilter::Failures::kCount,
        .look = ResultCache::Look::kName};
    jobs_.clear();
    std::vector<SlurmJob> missing;
    for (const std::size_t cell : session_.waiting_cells()) {
      const auto states = cell_states(graph_, &session_.cache(), filter, cell).states;
      if (std::ranges::find(states, JobState::kWaiting) == states.end()) continue;
      const Scene scene = session_.work().cells.scene(cell);
      for (const JobIndex job : graph_.jobs(cell)) {
        if (states[graph_.place(job)] != JobState::kWaiting) continue;
        const Job& one = graph_[job];
        const std::string whose = graph_.whose(job);
        missing.push_back(
            {graph_.name(job), is_picture(one.kind) ? 0 : 1,
             estimated_seconds(
                 one.kind,
                 one.engine == kNoEngine ? nullptr : &graph_.engines()[one.engine].engine->info(),
                 scene),
             one.kind == JobKind::kReference ? whose : std::string(kJobKindNames[int(one.kind)])});
        jobs_.push_back(job);
      }
    }
    return missing;
  }

  std::vector<JobIndex> at(std::span<const std::size_t> places) const {
    std::vector<JobIndex> found;
    for (const std::size_t place : places) found.push_back(jobs_.at(place));
    return found;
  }

  /// Keeps failures, so that this run does not try these jobs again.
  void give_up(std::span<const std::size_t> places, const std::string& why) const {
    for (const JobIndex job : at(places))
      session_.cache().keep_failure(
          graph_[job].key,
          {graph_.name(job), graph_[job].key.text(), "no node left", why, 0, records::this_node()});
  }

  /// The results that were missing at the start and are there now.
  JobRunWork made() const {
    JobRunWork work;
    for (const std::size_t cell : session_.waiting_cells()) {
      const auto now =
          cell_states(graph_, &session_.cache(), {.look = ResultCache::Look::kName}, cell).states;
      for (const JobIndex job : graph_.jobs(cell)) {
        if (session_.states()[job] != JobState::kWaiting ||
            now[graph_.place(job)] != JobState::kDone)
          continue;
        ++work.made;
        if (is_picture(graph_[job].kind)) ++work.pictures;
      }
    }
    return work;
  }

  void forget_failures() const {
    for (JobIndex job = 0; job < graph_.size(); ++job)
      if (session_.states()[job] == JobState::kWaiting)
        session_.cache().forget_failure(graph_[job].key);
  }

 private:
  FarmSession& session_;
  JobGraph& graph_;
  std::vector<JobIndex> jobs_;  ///< of the last answer
};

/// The hash of what the last element does by the record. The command is left out: another client may continue the run.
Sha256Digest hash_of_run(records::FarmRun record) {
  record.command.clear();
  return sha256(records::record_text(record));
}

Sha256Digest write_run_record(const fs::path& run_directory, const fs::path& grid_file,
                              const fs::path& directory, const FarmSession& session,
                              const FarmOptions& options) {
  records::FarmRun record;
  own_identity().put_into(record);
  record.grid = fs::absolute(grid_file).string();
  record.directory = fs::absolute(directory).string();
  record.cache = session.cache().directory().string();
  record.command = options.command;
  if (!options.gallery.empty()) record.gallery = fs::absolute(options.gallery).string();
  for (const auto& [engine, program] : options.programs)
    record.programs.emplace_back(engine, fs::absolute(program).string());
  records::write_record(run_directory / kRunFile, record, AtLink::kReplace);
  return hash_of_run(record);
}

struct RecordedRun {
  fs::path grid_file, directory;
  FarmOptions options;
};

/// Lists what a run's record asks for beyond the farm's directory, for refuse_without_leave().
std::vector<std::string> wishes_of_run(const records::FarmRun& record, const fs::path& directory) {
  std::vector<std::string> wishes;
  for (const auto& [engine, program] : record.programs) wishes.push_back(start_of(engine, program));
  const fs::path cache = real_path(record.cache), farm = real_path(directory);
  // $LOBELIA_CACHE is the user's. A link in the farm may be somebody else's.
  const fs::path usual = cache_directory({}, directory);
  const bool is_users = usual != directory / "cache" && cache == real_path(usual);
  if (!is_users && !is_below(cache, farm))
    wishes.push_back(fmt::format("write into the cache '{}'", printable(record.cache, 1000)));
  if (!record.gallery.empty() && !is_below(real_path(record.gallery), farm))
    wishes.push_back(fmt::format("write a gallery into '{}'", printable(record.gallery, 1000)));
  return wishes;
}

RecordedRun read_run(const fs::path& directory, const Leave& leave,
                     const std::optional<Sha256Digest>& planned = {}) {
  const InputFile file(slurm_run_directory(directory) / kRunFile);
  const std::string name = file.path().string();
  const auto record =
      records::parse_record<records::FarmRun>(read_file(file, records::kMaxRecordBytes), name);
  if (planned && hash_of_run(record) != *planned)
    throw Error(ExitCode::kInput,
                "{}: it says other things than when this job was submitted; 'lobelia "
                "farm status DIR --attach' ends the run as it says now",
                printable_path(name));
  // With another identity, results would have other keys.
  const auto differences = identity_differences(OwnIdentity::of_record(record), own_identity());
  if (!differences.empty())
    throw Error(ExitCode::kInput, "{}: a run that cannot go on here: {}", name,
                fmt::join(differences, "; "));
  std::error_code unknown;
  if (!fs::equivalent(record.directory, directory, unknown))
    throw Error(ExitCode::kInput,
                "{}: a run of the farm in '{}'; begin a new one with 'lobelia farm GRID "
                "-o DIR --executor slurm'",
                name, printable(record.directory, 1000));
  RecordedRun run;
  run.grid_file = record.grid;
  run.directory = directory;
  run.options.leave = leave.said_by(file.real_path());
  if (const auto wishes = wishes_of_run(record, directory); !wishes.empty() && !run.options.leave)
    refuse_without_leave(wishes);
  // Without the links that were looked through: they may be replaced.
  run.options.cache = real_path(record.cache);
  run.options.command = record.command;
  if (!record.gallery.empty()) run.options.gallery = real_path(record.gallery);
  for (const auto& [engine, program] : record.programs) run.options.programs[engine] = program;
  return run;
}

}  // namespace

fs::path slurm_run_directory(const fs::path& directory) {
  return fs::absolute(directory) / "runs" / "slurm";
}

double estimated_seconds(JobKind kind, const EngineInfo* engine, const Scene& scene) {
  // Measured on one core, for small and large pictures; chunks need only the order of magnitude.
  const double pixels = double(scene.film.width) * scene.film.height;
  const double rays = pixels * std::max(1, scene.sampler.sample_count);
  switch (kind) {
    case JobKind::kRender:
      return 0.02 + 5e-7 * rays;
    case JobKind::kReference: {
      const EngineSeconds& seconds = engine->seconds;
      return seconds.start + seconds.per_ray * rays;
    }
    case JobKind::kCompare:
      return 0.05 + 2e-6 * pixels;
    case JobKind::kProfile:
      return 0.02 + 1e-6 * pixels;
  }
  return 1;
}

SlurmFarmSummary run_farm_on_slurm(const Grid& grid, const fs::path& grid_file,
                                   const fs::path& directory, const FarmOptions& options,
                                   SlurmRunOptions slurm) {
  FarmSession session(grid, directory, options);
  SlurmWork work;
  work.run_directory = slurm_run_directory(directory);
  work.program = program_file();
  // A link would lead what is written, and started on nodes, out of the farm.
  HeldDirectory held(fs::absolute(directory));
  for (const char* name : {"runs", "slurm", "chunks"})
    held = held.make_below(name, HeldDirectory::Border::kCross);
  Missing missing(session);
  // A client that finds living jobs keeps their failures; a new run tries everything again.
  if (slurm_status(work.run_directory, slurm.call_limit).living.empty()) missing.forget_failures();
  work.run_record = write_run_record(work.run_directory, grid_file, directory, session, options);
  work.missing = [&] { return missing(); };
  work.write_chunk = [&](std::size_t number, std::span<const std::size_t> places) {
    const std::string text = records::record_text(
        chunk_record(session.work(), session.cache(), options, missing.at(places)));
    write_file(chunk_file(work.run_directory, number), text, AtLink::kReplace);
    return sha256(text);
  };
  work.give_up = [&](std::span<const std::size_t> places, const std::string& why) {
    missing.give_up(places, why);
  };
  SlurmFarmSummary summary{{}, {}, directory, options.gallery};
  try {
    summary.slurm = run_on_slurm(work, slurm);
  } catch (...) {
    try {
      session.show_what_is_there();
    } catch (const Error&) {  // the first failure matters more
    }
    throw;
  }
  session.show_what_is_there();
  summary.farm = session.summarise(missing.made());
  return summary;
}

ChunkSummary exec_slurm_chunk(const fs::path& run_directory, std::size_t number,
                              const Sha256Digest& planned, const Leave& leave) {
  int threads = 1;
  if (const char* given = std::getenv("SLURM_CPUS_PER_TASK")) {
    long long count = 0;
    if (parse_integer(given, count) && count >= 1 && count <= 1024) threads = int(count);
  }
  ChunkSummary summary = exec_chunk(chunk_file(run_directory, number), threads, leave, planned);
  write_chunk_report(run_directory, number, summary.left);
  return summary;
}

SlurmFarmSummary finish_slurm_run(const fs::path& run_directory, const Sha256Digest& planned,
                                  const Leave& leave) {
  // It is DIR/runs/slurm.
  const fs::path inside = fs::absolute(run_directory / "chunks").lexically_normal();
  RecordedRun run = read_run(inside.parent_path().parent_path().parent_path(), leave, planned);
  run.options.engines_as_recorded = true;
  const Grid grid = read_grid(run.grid_file);
  FarmSession session(grid, run.directory, run.options);
  session.show_what_is_there();
  return {session.summarise({}), {}, run.directory, run.options.gallery};
}

SlurmFarmSummary attach_to_slurm_run(const fs::path& directory, const SlurmRunOptions& slurm,
                                     const Leave& leave) {
  const RecordedRun run = read_run(directory, leave);
  return run_farm_on_slurm(read_grid(run.grid_file), run.grid_file, run.directory, run.options,
                           slurm);
}

}  // namespace lobelia
