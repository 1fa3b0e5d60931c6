#include "farm/job_run.hpp"

#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <ctime>
#include <deque>
#include <exception>
#include <mutex>
#include <queue>
#include <set>
#include <thread>

#include "core/at_once.hpp"
#include "core/error.hpp"
#include "core/files.hpp"
#include "core/host.hpp"
#include "core/image_io.hpp"
#include "core/interrupt.hpp"
#include "core/no_resources.hpp"
#include "core/numbers.hpp"
#include "core/process_memory.hpp"
#include "core/text.hpp"
#include "core/thread_count.hpp"
#include "farm/failed_jobs.hpp"
#include "farm/make_result.hpp"
#include "farm/our_name.hpp"
#include "reference_scenes/keep_input.hpp"
#include "reference_scenes/replicates.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
/// Between two looks at what somebody else is making.
constexpr auto kLookAgain = std::chrono::milliseconds(50);

double seconds(const timeval& time) { return double(time.tv_sec) + double(time.tv_usec) * 1e-6; }

double cpu_seconds_of(int who) {
  rusage usage{};
  ::getrusage(who, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double thread_cpu_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + double(time.tv_nsec) * 1e-9;
}

const records::Host& host_of_result() {
  static const records::Host host = records::this_node();
  return host;
}

/// An input was done, and is in the cache no more: no failure of the job.
class LostInput : public Error {
 public:
  explicit LostInput(const std::string& name)
      : Error(ExitCode::kOutput, name + ": its result is no longer in the cache") {}
};

/// How often an engine has failed on this machine since it made a picture.
struct Losses {
  int attempts = 0, pictures = 0;  ///< in a row; of pictures all attempts
  std::string last;                ///< why
};

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
}

struct JobFailure {
  FailureClass kind = FailureClass::kNone;
  std::string message;
  int attempts = 0;
};

}  // namespace

struct JobRun::Impl {
  Impl(JobGraph& g, const ResultCache& c, const JobRunOptions& o, std::vector<JobState> s)
      : graph(g), cache(c), options(o), failed(o.failed_directory), states(std::move(s)) {}

  // ---- what is known ----
  JobGraph& graph;
  const ResultCache& cache;
  const JobRunOptions& options;
  FailedJobs failed;

  mutable std::mutex mutex;  // of everything below
  std::condition_variable changed;
  std::vector<JobState> states;
  JobRunWork work;
  std::map<std::size_t, std::size_t> waiting_in_cell;
  std::vector<std::uint32_t> rank;  ///< of a cell in the order
  struct Later {
    std::pair<int, std::uint32_t> order;
    JobIndex job;
    bool operator<(const Later& other) const { return other.order < order; }
  };
  std::priority_queue<Later> ready;                         ///< renders, comparisons, profiles
  std::deque<std::pair<Clock::time_point, JobIndex>> held;  ///< somebody else is at work on it
  std::size_t kernel_jobs_left = 0;
  std::exception_ptr broken;  ///< what ends everything
  bool stopped = false;       ///< by a failure, with fail_fast
  std::function<void(std::size_t)> on_cell;
  struct Stage {
    std::string what;
    std::size_t done = 0, count = 0;
  };
  std::vector<Stage> stages;
  std::size_t steps_done = 0, steps = 0;

  bool over() const { return broken || stopped || interrupted(); }

  /// Done in this process, on one of its own threads.
  bool is_kernel(JobIndex job) const {
    const Job& one = graph[job];
    return one.kind != JobKind::kReference ||
           !graph.engines()[one.engine].engine->info().is_program;
  }

  std::string stage_of(JobIndex job) const {
    const Job& one = graph[job];
    if (one.kind == JobKind::kReference) return graph.engines()[one.engine].name;
    return one.kind == JobKind::kRender ? kOurs : std::string(kJobKindNames[int(one.kind)]);
  }

  void make_ready(JobIndex job) {
    // Comparisons first: they finish cells, and there are few of them at a time.
    const int urgency = is_picture(graph[job].kind) ? 1 : 0;
    ready.push({{urgency, rank[graph.cell_of(job)]}, job});
  }

  bool inputs_are_settled(JobIndex job) const {
    for (const JobIndex input : graph.inputs(job)) {
      if (states[input] == JobState::kDone) continue;
      if (graph.may_lack(job, input) && states[input] == JobState::kFailed) continue;
      return false;
    }
    return true;
  }

  /// Under the lock. What depends on it becomes ready, or cannot be done.
  void settle(JobIndex job, JobState state) {
    states[job] = state;
    if (is_kernel(job)) --kernel_jobs_left;
    count_step(job);
    for (const JobIndex next : graph.dependents(job)) {
      if (states[next] != JobState::kWaiting) continue;
      if (state == JobState::kAbsent)
        settle(next, state);
      else if (state != JobState::kDone && !graph.may_lack(next, job))
        settle(next, JobState::kBlocked);
      else if (inputs_are_settled(next))
        make_ready(next);
    }
    const std::size_t cell = graph.cell_of(job);
    if (--waiting_in_cell[cell] == 0) cells_done.push_back(cell);
    changed.notify_all();
  }

  std::deque<std::size_t> cells_done;  ///< whose on_cell has not been called yet

  void count_step(JobIndex job) {
    ++steps_done;
    FarmProgress progress{steps_done, steps, ""};
    const std::string what = stage_of(job);
    for (auto& stage : stages) {
      if (stage.what == what) ++stage.done;
      if (stage.done == stage.count) continue;
      if (!progress.running.empty()) progress.running += ", ";
      progress.running += fmt::format("{} {}/{}", stage.what, stage.done, stage.count);
    }
    if (options.on_progress) options.on_progress(progress);
  }

  void expect(JobIndex job) {
    ++steps;
    const std::string what = stage_of(job);
    const auto stage =
        std::find_if(stages.begin(), stages.end(), [&](const Stage& s) { return s.what == what; });
    if (stage == stages.end())
      stages.push_back({what, 0, 1});
    else
      ++stage->count;
  }

  void break_off() {
    const std::scoped_lock lock(mutex);
    if (!broken) broken = std::current_exception();
    changed.notify_all();
  }

  /// Of a job's name: the cell's id and what follows it.
  std::pair<std::string, std::string> parts_of_name(JobIndex job) const {
    const std::string& id = graph.cells().cells[graph.cell_of(job)].id;
    return {id, graph.name(job).substr(id.size() + 1)};
  }

  void settle_done(JobIndex job) {
    cache.forget_failure(graph[job].key);
    if (const auto [cell, name] = parts_of_name(job); true) failed.forget(cell, name);
    const std::scoped_lock lock(mutex);
    settle(job, JobState::kDone);
  }

  /// Keeps what an engine was given, so that somebody can look for the reason. Returns "failed/CELL/JOB", or "".
  std::string keep_input(JobIndex job, const std::string& log) {
    const std::string& engine = graph.engines()[graph[job].engine].name;
    const auto [cell, name] = parts_of_name(job);
    return failed.keep(cell, name, [&](const fs::path& directory) {
      const Scene scene = graph.cells().scene(graph.cell_of(job));
      write_file(directory / "scene.xml", scene_to_xml(scene));
      std::vector<std::string> again{"lobelia", "reference", "scene.xml",    "--engine",
                                     engine,    "-o",        engine + ".exr"};
      if (const auto given = options.programs.find(engine); given != options.programs.end())
        again.insert(again.end(), {"--" + engine, given->second.string()});
      write_file(directory / "again.sh", shell_join(again) + "\n");
      constexpr std::uint64_t kMostLog = FailedJobs::kMostBytes / 2;
      if (!log.empty() && log.size() <= kMostLog) write_file(directory / (engine + ".log"), log);
      // Of an average the first of its pictures stands for all.
      keep_engine_input(engine,
                        needs_replicates(scene) ? replicates(scene, 1, 1, 0)[0][0].scene : scene,
                        {}, directory);
    });
  }

  void settle_failed(JobIndex job, JobFailure failure, const std::string& log) {
    if (!is_kernel(job) && worth_retrying(failure.kind)) {
      const std::string kept = keep_input(job, log);
      replace_all(failure.message, kEngineDirectory, kept.empty() ? "." : kept);
      if (!kept.empty()) failure.message += fmt::format("; its input and log are in {}", kept);
    }
    cache.keep_failure(
        graph[job].key,
        {graph.name(job), graph[job].key.text(), std::string(failure_name(failure.kind)),
         failure.message, failure.attempts, host_of_result()},
        log);
    const std::scoped_lock lock(mutex);
    if (options.fail_fast) stopped = true;
    settle(job, JobState::kFailed);
  }

  /// What it needed was taken away: whoever runs the farm again has all of it made.
  void settle_lost(JobIndex job) {
    const std::scoped_lock lock(mutex);
    ++work.lost;
    settle(job, JobState::kBlocked);
  }

  void settle_cells() {
    while (true) {
      std::size_t cell = 0;
      {
        const std::scoped_lock lock(mutex);
        if (cells_done.empty()) return;
        cell = cells_done.front();
        cells_done.pop_front();
      }
      on_cell(cell);
    }
  }

  // ---- results ----
  /// Of a key: ours alone, among all processes and among the threads of this one (two cells may have one scene).
  struct Claim {
    Impl& run;
    ResultKey key;
    std::optional<ByteLocks::Claim> lock;
    Claim(Impl& r, const ResultKey& k) : run(r), key(k) {}
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;
    ~Claim() {
      lock.reset();
      const std::scoped_lock guard(run.mutex);
      run.in_work.erase(key);
    }
  };
  std::set<ResultKey> in_work;

  std::unique_ptr<Claim> claim_of(const ResultKey& key) {
    {
      const std::scoped_lock guard(mutex);
      if (!in_work.insert(key).second) return nullptr;
    }
    auto claim = std::make_unique<Claim>(*this, key);
    if (auto lock = cache.try_claim(key)) claim->lock.emplace(std::move(*lock));
    return claim->lock ? std::move(claim) : nullptr;
  }

  records::Result result_record(JobIndex job, int attempts) const {
    const Job& one = graph[job];
    const std::size_t cell = graph.cell_of(job);
    records::Result record;
    record.job = kJobKindNames[int(one.kind)];
    record.first_made_for = graph.cells().cells[cell].id;
    own_identity().put_into(record.inputs);
    record.inputs.scene = graph.scene_hash(cell);
    if (one.engine != kNoEngine) {
      const FarmEngine& engine = graph.engines()[one.engine];
      record.engine = engine.name;
      record.inputs.engine_version = engine.version;
      record.inputs.engine_content = engine.content;
    }
    for (const JobIndex input : graph.inputs(job))
      if (state_of(input) == JobState::kDone)
        record.inputs.pictures.emplace_back(graph.whose(input), graph[input].key.text());
    record.host = host_of_result();
    record.attempts = attempts;
    return record;
  }

  JobState state_of(JobIndex job) const {
    const std::scoped_lock lock(mutex);
    return states[job];
  }

  void publish(JobIndex job, ResultDraft& draft, records::Result record) {
    const Publication publication = cache.publish(draft, graph[job].key, std::move(record));
    {
      const std::scoped_lock lock(mutex);
      if (publication == Publication::kNew) {
        ++work.made;
        if (is_picture(graph[job].kind)) ++work.pictures;
      } else {
        ++work.found;
        if (publication == Publication::kDifferent) ++work.different;
      }
    }
    settle_done(job);
  }

  using Hashes = records::Named<std::string>;

  /// Of a picture that is an input: its directory, and in `from` the hash of what is read there.
  MadePicture input_picture(JobIndex job, Hashes& from) const {
    const std::string engine = graph.whose(job);
    const auto record = find_result(graph, cache, job);
    if (!record) throw LostInput(graph.name(job));
    from.emplace_back(engine, record->hash_of(picture_file(engine)));
    return {engine, cache.result_directory(graph[job].key)};
  }

  void make(JobIndex job, const Scene& scene, ResultDraft& draft, records::Result& record) {
    const std::size_t cell = graph.cell_of(job);
    switch (graph[job].kind) {
      case JobKind::kRender:
        return make_render(scene, draft, options.time_limit, options.memory, record);
      case JobKind::kCompare: {
        Hashes& from = record.from.emplace();
        const MadePicture ours = input_picture(graph.render(cell), from);
        const MadePicture theirs = input_picture(graph.reference(cell, graph[job].engine), from);
        return make_comparison(scene, ours, theirs, draft, record);
      }
      case JobKind::kProfile: {
        Hashes& from = record.from.emplace();
        std::vector<MadePicture> pictures;
        for (const JobIndex input : graph.inputs(job))
          if (state_of(input) == JobState::kDone) pictures.push_back(input_picture(input, from));
        return make_profile(scene, pictures, draft);
      }
      case JobKind::kReference:
        break;
    }
    const FarmEngine& here = graph.engines()[graph[job].engine];
    ReferenceOptions reference;
    reference.threads = 1;
    ReferenceResult result = Session(*here.engine, reference).render(scene);
    if (!result.error.empty()) throw ResultFailure(result.failure, result.error);
    make_reference(scene, here, "", std::move(result), draft, record);
  }

  /// Whether it has been settled; false: somebody else is at work on it.
  bool do_kernel_job(JobIndex job) {
    if (graph[job].kind == JobKind::kProfile) {
      const std::scoped_lock lock(mutex);
      graph.narrow_profile(graph.cell_of(job),
                           [&](JobIndex picture) { return states[picture] == JobState::kDone; });
    }
    const ResultKey& key = graph[job].key;
    const auto claim = claim_of(key);
    if (!claim) return false;
    const double cpu_before = thread_cpu_seconds();
    const auto wall_before = Clock::now();
    std::optional<ResultDraft> draft;
    try {
      if (is_there(job)) return true;
      const Scene scene = graph.cells().scene(graph.cell_of(job));
      draft.emplace(cache.draft());
      records::Result record = result_record(job, 1);
      make(job, scene, *draft, record);
      const double cpu = thread_cpu_seconds() - cpu_before;
      record.seconds = {std::chrono::duration<double>(Clock::now() - wall_before).count(), cpu};
      record.peak_memory_bytes = peak_memory_of(::getpid());
      count_kernel(cpu);
      publish(job, *draft, std::move(record));
    } catch (const Error& error) {
      if ((draft && !draft->is_there()) || dynamic_cast<const LostInput*>(&error) ||
          discard_unreadable_inputs(job)) {
        settle_lost(job);
        return true;
      }
      // A disk that is full ends the farm; whatever is wrong with this job is its own result.
      if (error.code() != ExitCode::kEngine && error.code() != ExitCode::kInput) throw;
      const auto* failure = dynamic_cast<const ResultFailure*>(&error);
      settle_failed(job, {failure ? failure->kind() : FailureClass::kRefused, error.what(), 1}, {});
      return true;
    }
    return true;
  }

  /// Somebody made it since the farm looked: then it is settled.
  bool is_there(JobIndex job) {
    if (!find_result(graph, cache, job)) {
      // It is damaged, or of other pictures.
      if (find_result(graph, cache, job, ResultCache::Look::kName)) cache.discard(graph[job].key);
      return false;
    }
    {
      const std::scoped_lock lock(mutex);
      ++work.found;
    }
    settle_done(job);
    return true;
  }

  /// So that they are made again. Whether there were any.
  bool discard_unreadable_inputs(JobIndex job) {
    bool any = false;
    for (const JobIndex input : graph.inputs(job)) {
      if (state_of(input) != JobState::kDone ||
          find_result(graph, cache, input, ResultCache::Look::kThorough))
        continue;
      cache.discard(graph[input].key);
      any = true;
    }
    return any;
  }

  void count_kernel(double cpu_seconds) {
    const std::scoped_lock lock(mutex);
    work.kernel_cpu_seconds += cpu_seconds;
  }

  // ---- our own threads ----
  void kernel_thread() {
    oneapi::tbb::task_arena alone(1);  // what divides itself elsewhere stays on this thread
    try {
      while (true) {
        JobIndex job = 0;
        {
          std::unique_lock lock(mutex);
          while (true) {
            if (over() || (kernel_jobs_left == 0)) return;
            const auto now = Clock::now();
            while (!held.empty() && held.front().first <= now) {
              make_ready(held.front().second);
              held.pop_front();
            }
            if (!ready.empty()) break;
            changed.wait_for(lock, kLookAgain);
          }
          job = ready.top().job;
          ready.pop();
        }
        bool settled = false;
        alone.execute([&] { settled = do_kernel_job(job); });
        if (!settled) {
          const std::scoped_lock lock(mutex);
          held.emplace_back(Clock::now() + kLookAgain, job);
        }
        settle_cells();
      }
    } catch (...) {
      break_off();
    }
  }

  // ---- engines ----
  void engine_thread(std::size_t e, std::vector<JobIndex> todo) {
    try {
      if (const std::string why = why_not_as_planned(graph.engines()[e]); !why.empty()) {
        for (const JobIndex job : todo)
          settle_failed(job, {FailureClass::kEngineMissing, why, 1}, {});
        settle_cells();
        return;
      }
      EngineState state;
      while (!todo.empty()) {
        {
          const std::scoped_lock lock(mutex);
          if (over()) return;
        }
        if (state.given_up) {
          give_up(e, todo, state.losses);
          break;
        }
        // What has failed comes first, so that it shows soon whether anything works.
        const auto fresh = std::ranges::stable_partition(
            todo, [&](JobIndex job) { return state.attempts.contains(job); });
        if (fresh.begin() == todo.begin()) state.losses.attempts = 0;
        const bool more_memory = state.short_of_memory.contains(todo.front());
        auto end = todo.begin();
        while (end != todo.end() && state.short_of_memory.contains(*end) == more_memory) ++end;
        const std::vector<JobIndex> batch(todo.begin(), end);
        todo.erase(todo.begin(), end);
        const std::size_t before = todo.size();
        const std::vector<JobIndex> left = render_batch(e, batch, state, more_memory);
        todo.insert(todo.end(), left.begin(), left.end());
        settle_cells();
        // Nothing but what others are making: let them.
        if (before == 0 && left.size() == batch.size()) std::this_thread::sleep_for(kLookAgain);
      }
      settle_cells();
    } catch (...) {
      break_off();
    }
  }

  /// A plan may be of another machine.
  static std::string why_not_as_planned(const FarmEngine& here) {
    const EngineStatus& status = here.engine->status();
    if (!status.available()) return status.why;
    return status.version == here.version
               ? ""
               : fmt::format("{} is {} on this machine, and was to be {}",
                             here.engine->info().title, status.version, here.version);
  }

  /// Of an engine's thread.
  struct EngineState {
    std::map<JobIndex, int> attempts;
    std::set<JobIndex> short_of_memory;  ///< they get twice as much
    Losses losses;
    bool given_up = false;
  };

  void give_up(std::size_t e, const std::vector<JobIndex>& jobs, const Losses& losses) {
    const std::string why = fmt::format(
        "{} is not tried any more on {}: it failed at {} pictures in a row, at every attempt; the "
        "last time: {}",
        graph.engines()[e].engine->info().title, host_name(), losses.pictures, losses.last);
    if (options.leave_undone) {
      const std::scoped_lock lock(mutex);
      work.engines_given_up.push_back({graph.engines()[e].name, why});
    }
    for (const JobIndex job : jobs) {
      if (is_there(job)) continue;
      if (!options.leave_undone) {
        settle_failed(job, {FailureClass::kGivenUp, why, 0}, {});
        continue;
      }
      const std::scoped_lock lock(mutex);
      ++work.undone;
      settle(job, JobState::kAbsent);
    }
  }

  /// Takes note of a picture or a failure. Returns whether the job is to be tried again.
  bool is_for_another_attempt(JobIndex job, const JobFailure& failure, bool had_more_memory,
                              EngineState& state) const {
    if (failure.message.empty()) {
      state.losses = {};
      return false;
    }
    if (!worth_retrying(failure.kind)) return false;
    state.losses.last = failure.message;
    ++state.losses.attempts;
    bool again = failure.attempts < options.attempts && !options.fail_fast;
    if (failure.kind == FailureClass::kOutOfMemory) {
      again = again && !had_more_memory && memory_of_job(true) > memory_of_job(false);
      if (again) state.short_of_memory.insert(job);
    }
    if (!again) ++state.losses.pictures;
    if (options.give_up_after > 0 && state.losses.pictures >= options.give_up_after)
      state.given_up = true;
    return again;
  }

  std::uint64_t memory_of_job(bool more) const {
    return more ? std::max(options.memory, std::min(2 * options.memory, memory_of_machine()))
                : options.memory;
  }

  /// Several at a time. Returns what is to be tried again.
  std::vector<JobIndex> render_batch(std::size_t e, const std::vector<JobIndex>& batch,
                                     EngineState& state, bool more_memory) {
    ReferenceOptions reference;
    reference.threads = options.threads;
    reference.time_limit = options.time_limit;
    reference.no_progress_limit = options.no_progress_limit;
    reference.memory_limit = memory_of_job(more_memory);
    reference.disk_limit = options.disk;
    reference.scenes = batch.size();
    Session session(*graph.engines()[e].engine, reference);
    EngineBatch at_work{e, more_memory, reference, session, state};
    for_each_at_once(
        batch.size(), session.at_once(), [&](std::size_t k) { render_one(batch[k], at_work); },
        [&] { session.stop(); });
    return std::move(at_work.again);
  }

  struct EngineBatch {
    std::size_t engine;
    bool more_memory;
    const ReferenceOptions& options;
    Session& session;
    EngineState& state;
    std::vector<JobIndex> again = {};
    std::mutex mutex = {};     ///< of the two above
    std::mutex averages = {};  ///< one of them keeps the engine busy, and is enough for the memory
  };

  void render_one(JobIndex job, EngineBatch& batch) {
    const Scene scene = graph.cells().scene(graph.cell_of(job));
    const std::uint64_t needed = memory_to_average(scene, batch.options);
    if (batch.options.memory_limit > 0 && needed > memory_of_job(true)) {
      settle_failed(job, too_large(needed), {});
      return settle_cells();
    }
    std::unique_lock average(batch.averages, std::defer_lock);
    if (needs_replicates(scene)) average.lock();
    const std::unique_ptr<Claim> claim = claim_for(job, batch);
    if (!claim) return;
    ReferenceResult result = batch.session.render(scene);
    const double wall = std::chrono::duration<double>(Clock::now() - result.begun).count();
    const std::string log = std::move(result.log);
    JobFailure failure{result.failure, result.error, 0};
    {
      const std::scoped_lock lock(batch.mutex);
      failure.attempts = ++batch.state.attempts[job];
    }
    if (result.error.empty()) {
      try {
        result.log = log;
        keep_reference(job, scene, graph.engines()[batch.engine], std::move(result),
                       failure.attempts, wall);
      } catch (const ResultFailure& what) {
        failure = {what.kind(), what.what(), failure.attempts};
      }
    }
    bool is_for_again = false;
    {
      const std::scoped_lock lock(batch.mutex);
      is_for_again = is_for_another_attempt(job, failure, batch.more_memory, batch.state);
      if (is_for_again) batch.again.push_back(job);
    }
    if (!failure.message.empty() && !is_for_again) settle_failed(job, std::move(failure), log);
    settle_cells();
  }

  /// To make it now; null if it is not to be made, or only later.
  std::unique_ptr<Claim> claim_for(JobIndex job, EngineBatch& batch) {
    {
      const std::scoped_lock lock(mutex);
      if (over()) return nullptr;
    }
    {
      const std::scoped_lock lock(batch.mutex);
      // After many failures those that have failed are tried again before any other.
      const bool doubtful =
          options.give_up_after > 0 && batch.state.losses.attempts >= options.give_up_after;
      if (batch.state.given_up || (doubtful && !batch.state.attempts.contains(job))) {
        batch.again.push_back(job);
        return nullptr;
      }
    }
    auto claim = claim_of(graph[job].key);
    if (claim) return is_there(job) ? nullptr : std::move(claim);
    const std::scoped_lock lock(batch.mutex);
    batch.again.push_back(job);
    return nullptr;
  }

  JobFailure too_large(std::uint64_t needed) const {
    return {FailureClass::kOutOfMemory,
            fmt::format("its pictures, of which it is the average, need {} of memory; allowed: {}",
                        size_text(needed), size_text(options.memory)),
            0};
  }

  void keep_reference(JobIndex job, const Scene& scene, const FarmEngine& here,
                      ReferenceResult result, int attempt, double wall) {
    const auto given = options.programs.find(here.name);
    const std::string program = given == options.programs.end() ? "" : given->second.string();
    records::Result record = result_record(job, attempt);
    const records::Reference& made_by = result.record;
    record.threads = made_by.threads.value_or(1);
    record.seconds = {wall, made_by.cpu_seconds.value_or(0)};
    record.peak_memory_bytes = made_by.peak_memory_bytes.value_or(0);
    ResultDraft draft = cache.draft();
    try {
      const double cpu_before = thread_cpu_seconds();
      make_reference(scene, here, program, std::move(result), draft, record);
      count_kernel(thread_cpu_seconds() - cpu_before);
      publish(job, draft, std::move(record));
    } catch (const Error&) {
      if (draft.is_there()) throw;
      settle_lost(job);
    }
  }

  // ---- all of it ----
  void run(const std::vector<std::size_t>& order) {
    const auto wall_before = Clock::now();
    const double own_before = cpu_seconds_of(RUSAGE_SELF),
                 engines_before = cpu_seconds_of(RUSAGE_CHILDREN);
    rank.assign(graph.cell_count(), 0);
    std::vector<std::vector<JobIndex>> of_engine(graph.engines().size());
    for (std::size_t place = 0; place < order.size(); ++place) {
      const std::size_t cell = order[place];
      rank[cell] = std::uint32_t(place);
      for (JobIndex job = graph.render(cell); job < graph.render(cell) + graph.stride(); ++job) {
        if (states[job] != JobState::kWaiting) continue;
        ++waiting_in_cell[cell];
        expect(job);
        if (is_kernel(job)) {
          ++kernel_jobs_left;
          if (inputs_are_settled(job)) make_ready(job);
        } else {
          of_engine[graph[job].engine].push_back(job);
        }
      }
    }
    // One that could not be started would keep the others waiting for ever.
    const int engines =
        int(std::ranges::count_if(of_engine, [](const auto& jobs) { return !jobs.empty(); }));
    work.processors =
        std::min(options.threads > 0 ? options.threads : usual_threads(),
                 startable_threads(engines + std::max(options.threads, usual_threads())) - engines);
    if (work.processors < 1) throw failure_of("the farm's threads", EAGAIN, ExitCode::kInternal);
    if (steps > 0) code_pictures_on_calling_threads();
    {
      std::vector<std::jthread> threads;
      for (std::size_t e = 0; e < of_engine.size(); ++e)
        if (!of_engine[e].empty())
          threads.emplace_back(
              [this, e, &of_engine] { engine_thread(e, std::move(of_engine[e])); });
      for (int i = 0; i < work.processors; ++i) threads.emplace_back([this] { kernel_thread(); });
    }
    work.wall_seconds = std::chrono::duration<double>(Clock::now() - wall_before).count();
    work.engine_cpu_seconds = cpu_seconds_of(RUSAGE_CHILDREN) - engines_before;
    work.own_cpu_seconds = cpu_seconds_of(RUSAGE_SELF) - own_before - work.kernel_cpu_seconds;
    if (broken) std::rethrow_exception(broken);
    throw_if_interrupted();
    tell_of_failures();
    settle_cells();
  }

  /// Of cells that are not finished because a failure has ended it all.
  void tell_of_failures() {
    const std::scoped_lock lock(mutex);
    for (const auto& [cell, waiting] : waiting_in_cell) {
      const auto jobs = std::span(states).subspan(graph.render(cell), graph.stride());
      if (waiting > 0 && std::ranges::find(jobs, JobState::kFailed) != jobs.end())
        cells_done.push_back(cell);
    }
  }
};

JobRun::JobRun(JobGraph& graph, const ResultCache& cache, const JobRunOptions& options,
               std::vector<JobState> states)
    : impl_(std::make_unique<Impl>(graph, cache, options, std::move(states))) {}
JobRun::~JobRun() = default;

void JobRun::run(const std::vector<std::size_t>& order,
                 const std::function<void(std::size_t)>& on_cell) {
  impl_->on_cell = on_cell;
  impl_->run(order);
}

JobState JobRun::state(JobIndex job) const { return impl_->state_of(job); }
const JobRunWork& JobRun::work() const { return impl_->work; }

}  // namespace lobelia
