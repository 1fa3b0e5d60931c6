// Makes the results of a run's jobs. For any thread.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <ctime>

#include "base/system/files.hpp"
#include "base/system/host.hpp"
#include "base/words/text.hpp"
#include "farm/failed_jobs.hpp"
#include "farm/group_flush.hpp"
#include "farm/job_board.hpp"
#include "farm/make_result.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/replicates.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {

inline double thread_cpu_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

inline const records::Host& host_of_result() {
  static const records::Host host = records::this_node();
  return host;
}

/// The result of an input vanished from the cache; the job itself has not failed.
class LostInput : public Error {
 public:
  explicit LostInput(const std::string& name)
      : Error(ExitCode::kOutput, name + ": its result is no longer in the cache") {}
};

inline void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
}

struct JobFailure {
  FailureClass kind = FailureClass::kNone;
  std::string message;  ///< empty: it has not failed
  int attempts = 0;
};

class JobMaker {
 public:
  JobMaker(JobGraph& graph, const ResultCache& cache, const JobRunOptions& options, JobBoard& board,
           GroupFlush& flush)
      : graph_(graph),
        cache_(cache),
        options_(options),
        board_(board),
        flush_(flush),
        failed_(options.failed_directory) {}

  /// The right to make a result, among all processes and the threads of this one: two cells may have the same scene.
  class Claim {
   public:
    Claim(JobMaker& maker, const ResultKey& key) : maker_(maker), key_(key) {}
    ~Claim() {
      lock_.reset();
      const std::scoped_lock guard(maker_.mutex_);
      maker_.claimed_.erase(key_);
    }
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

   private:
    friend class JobMaker;
    JobMaker& maker_;
    ResultKey key_;
    std::optional<ByteLocks::Claim> lock_;
  };
  /// Null while another process or thread has it.
  std::unique_ptr<Claim> claim(JobIndex job) {
    const ResultKey& key = graph_[job].key;
    {
      const std::scoped_lock guard(mutex_);
      if (!claimed_.insert(key).second) return nullptr;
    }
    auto claim = std::make_unique<Claim>(*this, key);
    if (auto lock = cache_.try_claim(key)) claim->lock_.emplace(std::move(*lock));
    return claim->lock_ ? std::move(claim) : nullptr;
  }
  /// Settles the job if its result has been made since the farm looked.
  bool is_there(JobIndex job) {
    if (!find_result(graph_, cache_, job)) {
      // A result that is damaged, or made from other pictures.
      if (find_result(graph_, cache_, job, ResultCache::Look::kName))
        cache_.discard(graph_[job].key);
      return false;
    }
    board_.count([](JobRunWork& work) { ++work.found; });
    settle_done(job);
    return true;
  }

  /// Makes the result in this process; false while another process or thread makes it. The job is settled once its
  /// files are on the disk.
  bool make_here(JobIndex job) {
    if (graph_[job].kind == JobKind::kProfile)
      graph_.narrow_profile(graph_.cell_of(job), [&](JobIndex picture) {
        return board_.state(picture) == JobState::kDone;
      });
    auto claimed = claim(job);
    if (!claimed) return false;
    const double cpu_before = thread_cpu_seconds();
    const auto wall_before = std::chrono::steady_clock::now();
    std::optional<ResultDraft> draft;
    try {
      if (is_there(job)) return true;
      draft.emplace(cache_.draft());
      records::Result record = result_record(job, 1);
      {
        const auto later = flush_.later();
        make(job, *draft, record);
      }
      const double cpu = thread_cpu_seconds() - cpu_before;
      record.seconds = {seconds_since(wall_before), cpu};
      record.peak_memory_bytes = peak_memory_of(::getpid());
      board_.count([&](JobRunWork& work) { work.kernel_cpu_seconds += cpu; });
      publish(job, claimed, *draft, std::move(record));
    } catch (const Error& error) {
      if ((draft && !draft->is_there()) || dynamic_cast<const LostInput*>(&error) ||
          discard_unreadable_inputs(job)) {
        settle_lost(job);
        return true;
      }
      // A full disk ends the farm; other errors are this job's own failure.
      if (error.code() != ExitCode::kEngine && error.code() != ExitCode::kInput) throw;
      const auto* failure = dynamic_cast<const ResultFailure*>(&error);
      fail(job, {failure ? failure->kind() : FailureClass::kRefused, error.what(), 1});
    }
    return true;
  }
  /// Likewise for an engine's picture, whose claim it takes. Throws ResultFailure if it is not a valid one.
  void keep_reference(JobIndex job, const Scene& scene, ReferenceResult result, int attempt,
                      double wall_seconds, std::unique_ptr<Claim>& claim) {
    const FarmEngine& engine = graph_.engines()[graph_[job].engine];
    const std::string program = program_for(options_.programs, engine.name).string();
    records::Result record = result_record(job, attempt);
    const records::Reference& made_by = result.record;
    record.threads = made_by.threads.value_or(1);
    record.seconds = {wall_seconds, made_by.cpu_seconds.value_or(0)};
    record.peak_memory_bytes = made_by.peak_memory_bytes.value_or(0);
    ResultDraft draft = cache_.draft();
    try {
      const double cpu_before = thread_cpu_seconds();
      {
        const auto later = flush_.later();
        make_reference(scene, engine, program, std::move(result), draft, record);
      }
      const double cpu = thread_cpu_seconds() - cpu_before;
      board_.count([&](JobRunWork& work) { work.kernel_cpu_seconds += cpu; });
      publish(job, claim, draft, std::move(record));
    } catch (const Error&) {
      if (draft.is_there()) throw;
      settle_lost(job);
    }
  }
  void fail(JobIndex job, JobFailure failure, const std::string& log = {}) {
    if (!board_.is_made_here(job) && worth_retrying(failure.kind)) {
      const std::string kept = keep_input(job, log);
      replace_all(failure.message, kEngineDirectory, kept.empty() ? "." : kept);
      if (!kept.empty()) failure.message += fmt::format("; its input and log are in {}", kept);
    }
    const std::string key = graph_[job].key.text();
    cache_.keep_failure(graph_[job].key,
                        {graph_.name(job), key, std::string(failure_name(failure.kind)),
                         failure.message, failure.attempts, host_of_result()},
                        log);
    if (options_.fail_fast) board_.stop();
    board_.settle(job, JobState::kFailed);
  }

 private:
  using Hashes = records::Named<std::string>;
  const std::string& cell_id(JobIndex job) const {
    return graph_.cells().cells[graph_.cell_of(job)].id;
  }
  void settle_done(JobIndex job) {
    cache_.forget_failure(graph_[job].key);
    failed_.forget(cell_id(job), graph_.name_in_cell(job));
    board_.settle(job, JobState::kDone);
  }
  /// Its input or its draft was removed: the next round of the farm makes both.
  void settle_lost(JobIndex job) {
    board_.count([](JobRunWork& work) { ++work.lost; });
    board_.settle(job, JobState::kBlocked);
  }
  /// Keeps the engine's input, to look for the reason. Returns "failed/CELL/JOB", or "".
  std::string keep_input(JobIndex job, const std::string& log) {
    const std::string& engine = graph_.engines()[graph_[job].engine].name;
    return failed_.keep(
        cell_id(job), graph_.name_in_cell(job), [&](const std::filesystem::path& directory) {
          const Scene scene = graph_.cells().scene(graph_.cell_of(job));
          constexpr std::uint64_t kMostLog = FailedJobs::kMostBytes / 2;
          if (!log.empty() && log.size() <= kMostLog)
            write_file(directory / (engine + ".log"), log);
          if (const auto* outside = graph_.engines()[graph_[job].engine].engine->outside())
            return keep_outside_input(*outside, scene, graph_.axes(graph_.cell_of(job)), directory);
          write_file(directory / "scene.xml", scene_to_xml(scene));
          std::vector<std::string> again{"lobelia", "reference", "scene.xml",    "--engine",
                                         engine,    "-o",        engine + ".exr"};
          if (const std::filesystem::path program = program_for(options_.programs, engine);
              !program.empty())
            again.insert(again.end(), {"--" + engine, program.string()});
          write_file(directory / "again.sh", shell_join(again) + "\n");
          // The first picture of an average stands for all.
          keep_engine_input(
              engine, needs_replicates(scene) ? replicates(scene, 1, 1, 0)[0][0].scene : scene, {},
              directory);
        });
  }
  records::Result result_record(JobIndex job, int attempts) const {
    const Job& one = graph_[job];
    records::Result record;
    record.job = kJobKindNames[int(one.kind)];
    record.first_made_for = cell_id(job);
    own_identity().put_into(record.inputs);
    record.inputs.scene = graph_.scene_hash(graph_.cell_of(job));
    if (one.engine != kNoEngine) {
      const FarmEngine& engine = graph_.engines()[one.engine];
      record.engine = engine.name;
      record.inputs.engine_version = engine.version;
      record.inputs.engine_content = engine.content;
    }
    for (const JobIndex input : graph_.inputs(job))
      if (board_.state(input) == JobState::kDone)
        record.inputs.pictures.emplace_back(graph_.whose(input), graph_[input].key.text());
    record.host = host_of_result();
    record.attempts = attempts;
    return record;
  }
  /// The picture of an input; `from` gets its hash.
  MadePicture input_picture(JobIndex job, Hashes& from) const {
    const std::string engine = graph_.whose(job);
    const auto record = find_result(graph_, cache_, job);
    if (!record) throw LostInput(graph_.name(job));
    from.emplace_back(engine, record->hash_of(picture_file(engine)));
    return {engine, cache_.result_directory(graph_[job].key)};
  }
  /// Discards damaged inputs, so that they are made again. Whether there were any.
  bool discard_unreadable_inputs(JobIndex job) const {
    bool any = false;
    for (const JobIndex input : graph_.inputs(job)) {
      if (board_.state(input) != JobState::kDone ||
          find_result(graph_, cache_, input, ResultCache::Look::kThorough))
        continue;
      cache_.discard(graph_[input].key);
      any = true;
    }
    return any;
  }
  void make(JobIndex job, ResultDraft& draft, records::Result& record) const {
    const Scene scene = graph_.cells().scene(graph_.cell_of(job));
    const JobKind kind = graph_[job].kind;
    if (kind == JobKind::kRender)
      return make_render(scene, draft, options_.time_limit, options_.memory, record);
    if (kind == JobKind::kReference) {
      const FarmEngine& here = graph_.engines()[graph_[job].engine];
      ReferenceOptions reference;
      reference.threads = 1;
      ReferenceResult result =
          Session(*here.engine, reference).render(scene, graph_.axes(graph_.cell_of(job)));
      if (!result.error.empty()) throw ResultFailure(result.failure, result.error);
      return make_reference(scene, here, "", std::move(result), draft, record);
    }
    Hashes& from = record.from.emplace();
    std::vector<MadePicture> pictures;
    for (const JobIndex input : graph_.inputs(job))
      if (board_.state(input) == JobState::kDone) pictures.push_back(input_picture(input, from));
    if (kind == JobKind::kProfile) {
      if (!graph_.cells().ours)
        std::erase_if(pictures, [](const MadePicture& one) { return one.engine == kOurs; });
      return make_profile(scene, pictures, draft);
    }
    const MadePicture &a = pictures.at(0), &b = pictures.at(1);
    std::vector<EngineFloor> floors;
    for (const MadePicture* one : {&a, &b}) {
      if (one->engine == kOurs) floors.push_back(kOursFloor);
      for (const FarmEngine& engine : graph_.engines())
        if (engine.name == one->engine) floors.push_back(engine.engine->info().floor);
    }
    make_comparison(scene, {a.engine, b.engine, a.engine == graph_.whose(job)},
                    read_pictures(scene, a, b, pictures.size() > 2 ? pictures[2] : a), floors,
                    draft, record);
  }
  struct Made {
    std::unique_ptr<Claim> claim;
    ResultDraft draft;
    records::Result record;
  };
  /// Takes the claim and the draft, unless sealing fails.
  void publish(JobIndex job, std::unique_ptr<Claim>& claim, ResultDraft& draft,
               records::Result record) {
    {
      const auto later = flush_.later();
      cache_.seal(draft, graph_[job].key, record);
    }
    auto files = draft.files();
    const auto made =
        std::make_shared<Made>(Made{std::move(claim), std::move(draft), std::move(record)});
    flush_.add(std::move(files), [this, job, made] { place(job, *made); });
  }
  void place(JobIndex job, Made& made) try {
    const Publication publication = cache_.place(made.draft, graph_[job].key, made.record);
    board_.count([&](JobRunWork& work) {
      if (publication == Publication::kNew) {
        ++work.made;
        if (is_picture(graph_[job].kind)) ++work.pictures;
      } else {
        ++work.found;
        if (publication == Publication::kDifferent) ++work.different;
      }
    });
    settle_done(job);
  } catch (const Error&) {
    if (made.draft.is_there()) throw;
    settle_lost(job);
  }

  JobGraph& graph_;
  const ResultCache& cache_;
  const JobRunOptions& options_;
  JobBoard& board_;
  GroupFlush& flush_;
  FailedJobs failed_;
  std::mutex mutex_;
  std::set<ResultKey> claimed_;  ///< by threads of this process
};

}  // namespace lobelia
