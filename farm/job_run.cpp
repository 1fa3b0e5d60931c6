#include <fmt/format.h>
#include <oneapi/tbb/task_arena.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <thread>

#include "base/pictures/image_io.hpp"
#include "base/system/host.hpp"
#include "base/system/no_resources.hpp"
#include "base/system/threads.hpp"
#include "base/words/numbers.hpp"
#include "farm/job_maker.hpp"
#include "reference_scenes/at_once.hpp"
#include "reference_scenes/replicates.hpp"

namespace lobelia {
namespace {

double cpu_seconds_of(int who) {
  rusage usage{};
  ::getrusage(who, &usage);
  const auto seconds = [](const timeval& time) {
    return double(time.tv_sec) + double(time.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// One engine's pictures in a run: several at a time, and again after a failure that may not repeat itself.
class EngineRun {
 public:
  EngineRun(const JobGraph& graph, const JobRunOptions& options, JobBoard& board, JobMaker& maker,
            std::size_t engine)
      : graph_(graph),
        options_(options),
        board_(board),
        maker_(maker),
        engine_(graph.engines()[engine]) {}

  /// Settles these jobs. Its thread mostly waits.
  void run(std::vector<JobIndex> todo) {
    if (const std::string why = why_not_as_planned(); !why.empty()) {
      for (const JobIndex job : todo) maker_.fail(job, {FailureClass::kEngineMissing, why, 1});
      todo.clear();
    }
    while (!todo.empty() && !board_.is_over()) {
      if (given_up_) {
        give_up(todo);
        break;
      }
      // Failed jobs come first: they show soonest whether the engine works at all.
      const auto fresh = std::ranges::stable_partition(
          todo, [&](JobIndex job) { return attempts_.contains(job); });
      if (fresh.begin() == todo.begin()) failed_attempts_ = 0;
      const bool more_memory = short_of_memory_.contains(todo.front());
      const auto end = std::ranges::find_if(
          todo, [&](JobIndex job) { return short_of_memory_.contains(job) != more_memory; });
      const std::vector<JobIndex> batch(todo.begin(), end);
      todo.erase(todo.begin(), end);
      const bool is_last = todo.empty();
      render(batch, more_memory);
      todo.insert(todo.end(), again_.begin(), again_.end());
      board_.finish_cells();
      // Other processes are making all of these results.
      if (is_last && again_.size() == batch.size()) std::this_thread::sleep_for(kLookAgain);
    }
    board_.finish_cells();
  }

 private:
  /// The plan may come from another machine.
  std::string why_not_as_planned() const {
    const EngineStatus& status = engine_.engine->status();
    if (!status.available()) return status.why;
    return status.version == engine_.version
               ? ""
               : fmt::format("{} is {} on this machine, and was to be {}",
                             engine_.engine->info().title, status.version, engine_.version);
  }

  std::uint64_t memory_of_job(bool more) const {
    return more ? std::max(options_.memory, std::min(2 * options_.memory, memory_of_machine()))
                : options_.memory;
  }

  void render(const std::vector<JobIndex>& batch, bool more_memory) {
    ReferenceOptions reference;
    reference.threads = options_.threads;
    reference.time_limit = options_.time_limit;
    reference.no_progress_limit = options_.no_progress_limit;
    reference.memory_limit = memory_of_job(more_memory);
    reference.disk_limit = options_.disk;
    reference.scenes = batch.size();
    Session session(*engine_.engine, reference);
    again_.clear();
    for_each_at_once(
        batch.size(), session.at_once(),
        [&](std::size_t k) {
          render_one(batch[k], session, reference, more_memory);
          board_.finish_cells();
        },
        [&] { session.stop(); });
  }

  void render_one(JobIndex job, Session& session, const ReferenceOptions& reference,
                  bool more_memory) {
    const Scene scene = graph_.cells().scene(graph_.cell_of(job));
    const bool is_average = engine_.engine->averages(scene);
    const std::uint64_t needed = is_average ? memory_to_average(scene, reference) : 0;
    if (reference.memory_limit > 0 && needed > memory_of_job(true))
      return maker_.fail(
          job,
          {FailureClass::kOutOfMemory,
           fmt::format("its pictures, of which it is the average, need {} of memory; allowed: {}",
                       size_text(needed), size_text(options_.memory)),
           0});
    std::unique_lock average(averages_, std::defer_lock);
    if (is_average) average.lock();
    auto claimed = claim(job);
    if (!claimed) return;
    ReferenceResult result = session.render(scene, graph_.axes(graph_.cell_of(job)));
    const double wall = seconds_since(result.begun);
    const std::string log = result.log;
    JobFailure failure{result.failure, result.error, 0};
    {
      const std::scoped_lock lock(mutex_);
      failure.attempts = ++attempts_[job];
    }
    if (failure.message.empty()) try {
        maker_.keep_reference(job, scene, std::move(result), failure.attempts, wall, claimed);
      } catch (const ResultFailure& error) {
        failure.kind = error.kind();
        failure.message = error.what();
      }
    if (is_to_be_retried(job, failure, more_memory)) return;
    if (!failure.message.empty()) maker_.fail(job, std::move(failure), log);
  }

  /// Null if the job is not to be made now; it is in `again_` if it is to be made later.
  std::unique_ptr<JobMaker::Claim> claim(JobIndex job) {
    if (board_.is_over()) return nullptr;
    std::unique_lock lock(mutex_);
    // After many failures, only jobs that have failed are tried again.
    const bool doubtful = options_.give_up_after > 0 && failed_attempts_ >= options_.give_up_after;
    if (!given_up_ && (!doubtful || attempts_.contains(job))) {
      lock.unlock();
      if (auto claimed = maker_.claim(job))
        return maker_.is_there(job) ? nullptr : std::move(claimed);
      lock.lock();
    }
    again_.push_back(job);
    return nullptr;
  }

  /// Counts a picture or a failure; true if the job is in `again_` now.
  bool is_to_be_retried(JobIndex job, const JobFailure& failure, bool had_more_memory) {
    const std::scoped_lock lock(mutex_);
    if (failure.message.empty()) {
      failed_attempts_ = failed_pictures_ = 0;
      return false;
    }
    if (!worth_retrying(failure.kind)) return false;
    last_failure_ = failure.message;
    ++failed_attempts_;
    bool again = failure.attempts < options_.attempts && !options_.fail_fast;
    if (failure.kind == FailureClass::kOutOfMemory) {
      again = again && !had_more_memory && memory_of_job(true) > memory_of_job(false);
      if (again) short_of_memory_.insert(job);
    }
    if (again)
      again_.push_back(job);
    else
      ++failed_pictures_;
    if (options_.give_up_after > 0 && failed_pictures_ >= options_.give_up_after) given_up_ = true;
    return again;
  }

  void give_up(const std::vector<JobIndex>& jobs) {
    const std::string why = fmt::format(
        "{} is not tried any more on {}: it failed at {} pictures in a row, at every attempt; the "
        "last time: {}",
        engine_.engine->info().title, host_name(), failed_pictures_, last_failure_);
    if (options_.leave_undone)
      board_.count([&](JobRunWork& work) { work.engines_given_up.push_back({engine_.name, why}); });
    for (const JobIndex job : jobs) {
      if (maker_.is_there(job)) continue;
      if (!options_.leave_undone) {
        maker_.fail(job, {FailureClass::kGivenUp, why, 0});
        continue;
      }
      board_.count([](JobRunWork& work) { ++work.undone; });
      board_.settle(job, JobState::kAbsent);
    }
  }

  const JobGraph& graph_;
  const JobRunOptions& options_;
  JobBoard& board_;
  JobMaker& maker_;
  const FarmEngine& engine_;

  std::mutex averages_;  ///< one average at a time: it keeps the engine busy and fills its memory
  std::mutex mutex_;     // of everything below
  std::vector<JobIndex> again_;  ///< of the batch, for the next one
  std::map<JobIndex, int> attempts_;
  std::set<JobIndex> short_of_memory_;             ///< tried again with twice as much
  int failed_attempts_ = 0, failed_pictures_ = 0;  ///< in a row
  std::string last_failure_;
  bool given_up_ = false;
};

}  // namespace

JobRunWork run_jobs(JobGraph& graph, const ResultCache& cache, const JobRunOptions& options,
                    std::vector<JobState>& states, const std::vector<std::size_t>& order,
                    const std::filesystem::path& directory,
                    const std::function<void(std::size_t cell, GroupFlush&)>& on_cell) {
  const auto wall_before = std::chrono::steady_clock::now();
  const double own_before = cpu_seconds_of(RUSAGE_SELF),
               engines_before = cpu_seconds_of(RUSAGE_CHILDREN);
  GroupFlush* flush_of_cells = nullptr;
  JobBoard board(graph, options, states, [&](std::size_t cell) { on_cell(cell, *flush_of_cells); });
  GroupFlush flush({cache.directory(), directory},
                   [&](std::exception_ptr error) { board.break_off(std::move(error)); });
  flush_of_cells = &flush;
  JobMaker maker(graph, cache, options, board, flush);
  std::vector<std::vector<JobIndex>> of_engine = board.plan(order);
  // Threads are counted first: one that cannot be started would keep the others waiting for ever.
  const int engines =
      int(std::ranges::count_if(of_engine, [](const auto& jobs) { return !jobs.empty(); }));
  const int processors =
      std::min(options.threads > 0 ? options.threads : usual_threads(),
               startable_threads(engines + std::max(options.threads, usual_threads())) - engines);
  if (processors < 1) throw failure_of("the farm's threads", EAGAIN, ExitCode::kInternal);
  if (board.planned() > 0) code_pictures_on_calling_threads();
  {
    std::vector<std::jthread> threads;
    const auto start = [&](auto work) {
      threads.emplace_back([&board, work = std::move(work)]() mutable {
        try {
          work();
        } catch (...) {
          board.break_off(std::current_exception());
        }
      });
    };
    for (std::size_t e = 0; e < of_engine.size(); ++e)
      if (!of_engine[e].empty())
        start([&, e, jobs = std::move(of_engine[e])]() mutable {
          EngineRun(graph, options, board, maker, e).run(std::move(jobs));
        });
    for (int i = 0; i < processors; ++i)
      start([&] {
        oneapi::tbb::task_arena alone(1);  // keeps work that TBB would divide on this thread
        while (const auto job = board.next()) {
          bool settled = false;
          alone.execute([&] { settled = maker.make_here(*job); });
          if (!settled) board.put_back(*job);
        }
        board.finish_cells();
      });
  }
  board.finish_failed_cells();
  flush.finish();
  board.count([&](JobRunWork& work) {
    work.processors = processors;
    work.wall_seconds = seconds_since(wall_before);
    work.engine_cpu_seconds = cpu_seconds_of(RUSAGE_CHILDREN) - engines_before;
    work.own_cpu_seconds = cpu_seconds_of(RUSAGE_SELF) - own_before - work.kernel_cpu_seconds;
  });
  board.end();
  return board.work();
}

}  // namespace lobelia
