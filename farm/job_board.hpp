// The jobs of a run: which can begin and which are done. For any thread.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <queue>

#include "base/system/interrupt.hpp"
#include "farm/job_run.hpp"

namespace lobelia {

/// Pause before asking again whether another process has made a result.
inline constexpr auto kLookAgain = std::chrono::milliseconds(50);

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class JobBoard {
 public:
  JobBoard(const JobGraph& graph, const JobRunOptions& options, std::vector<JobState>& states,
           std::function<void(std::size_t)> on_cell)
      : graph_(graph), options_(options), on_cell_(std::move(on_cell)), states_(states) {}

  /// Takes all waiting jobs, cells in this order. Returns the jobs of each engine that is a program.
  std::vector<std::vector<JobIndex>> plan(const std::vector<std::size_t>& order) {
    const std::scoped_lock lock(mutex_);
    rank_.assign(graph_.cell_count(), 0);
    std::vector<std::vector<JobIndex>> of_engine(graph_.engines().size());
    for (std::size_t place = 0; place < order.size(); ++place) {
      const std::size_t cell = order[place];
      rank_[cell] = std::uint32_t(place);
      for (const JobIndex job : graph_.jobs(cell)) {
        if (states_[job] != JobState::kWaiting) continue;
        ++waiting_in_cell_[cell];
        ++planned_;
        ++stage_of(job).count;
        if (!is_made_here(job)) {
          of_engine[graph_[job].engine].push_back(job);
          continue;
        }
        ++left_here_;
        if (inputs_are_settled(job)) make_ready(job);
      }
    }
    return of_engine;
  }
  std::size_t planned() const { return planned_; }

  JobState state(JobIndex job) const {
    const std::scoped_lock lock(mutex_);
    return states_[job];
  }
  /// Whether a thread of this process makes the result.
  bool is_made_here(JobIndex job) const {
    const Job& one = graph_[job];
    return one.kind != JobKind::kReference ||
           !graph_.engines()[one.engine].engine->info().is_program;
  }
  /// Waits for a job that is made here and can begin, and finishes cells meanwhile; empty once there will be no more.
  std::optional<JobIndex> next() {
    std::unique_lock lock(mutex_);
    while (!is_over_locked() && left_here_ > 0) {
      for (const auto now = Clock::now(); !put_back_.empty() && put_back_.front().first <= now;
           put_back_.pop_front())
        make_ready(put_back_.front().second);
      if (!finished_cells_.empty()) {
        lock.unlock();
        finish_cells();
        lock.lock();
        continue;
      }
      if (!ready_.empty()) {
        const JobIndex job = ready_.top().job;
        ready_.pop();
        return job;
      }
      changed_.wait_for(lock, kLookAgain);
    }
    return std::nullopt;
  }
  /// Another process is making it: next() gives it again later.
  void put_back(JobIndex job) {
    const std::scoped_lock lock(mutex_);
    put_back_.emplace_back(Clock::now() + kLookAgain, job);
  }
  /// Jobs that depend on it can begin, or become kBlocked or kAbsent.
  void settle(JobIndex job, JobState state) {
    const std::scoped_lock lock(mutex_);
    settle_locked(job, state);
  }
  /// Calls `on_cell` for cells with nothing left to wait for.
  void finish_cells() {
    while (true) {
      std::size_t cell = 0;
      {
        const std::scoped_lock lock(mutex_);
        if (finished_cells_.empty()) return;
        cell = finished_cells_.front();
        finished_cells_.pop_front();
      }
      on_cell_(cell);
    }
  }

  /// ends the run early
  void stop() {
    const std::scoped_lock lock(mutex_);
    stopped_ = true;
  }
  /// likewise; end() throws the first such error
  void break_off(std::exception_ptr error) {
    const std::scoped_lock lock(mutex_);
    if (!broken_) broken_ = std::move(error);
    changed_.notify_all();
  }
  bool is_over() const {
    const std::scoped_lock lock(mutex_);
    return is_over_locked();
  }
  /// After the last job: finishes the cells with the failure that ended the run.
  void finish_failed_cells() {
    if (broken_ || interrupted()) return;
    for (const auto& [cell, waiting] : waiting_in_cell_)
      if (waiting > 0 && std::ranges::any_of(graph_.jobs(cell), [&](JobIndex job) {
            return states_[job] == JobState::kFailed;
          }))
        finished_cells_.push_back(cell);
    finish_cells();
  }
  /// Throws the error that broke the run.
  void end() const {
    if (broken_) std::rethrow_exception(broken_);
    throw_if_interrupted();
  }

  void count(const std::function<void(JobRunWork&)>& change) {
    const std::scoped_lock lock(mutex_);
    change(work_);
  }
  const JobRunWork& work() const { return work_; }

 private:
  struct Ready {
    std::pair<int, std::uint32_t> order;
    JobIndex job;
    bool operator<(const Ready& other) const { return other.order < order; }
  };
  struct Stage {
    std::string name;
    std::size_t done = 0, count = 0;
  };
  using Clock = std::chrono::steady_clock;

  bool is_over_locked() const { return broken_ || stopped_ || interrupted(); }
  bool inputs_are_settled(JobIndex job) const {
    return std::ranges::all_of(graph_.inputs(job), [&](JobIndex input) {
      return states_[input] == JobState::kDone ||
             (graph_.may_lack(job, input) && states_[input] == JobState::kFailed);
    });
  }
  void make_ready(JobIndex job) {
    // Comparisons and profiles first: they finish cells, and few are ready at a time.
    const int urgency = is_picture(graph_[job].kind) ? 1 : 0;
    ready_.push({{urgency, rank_[graph_.cell_of(job)]}, job});
  }
  void settle_locked(JobIndex job, JobState state) {
    states_[job] = state;
    if (is_made_here(job)) --left_here_;
    ++settled_;
    ++stage_of(job).done;
    show_progress();
    for (const JobIndex next : graph_.dependents(job)) {
      if (states_[next] != JobState::kWaiting) continue;
      // A picture that was lost is made again, so nothing is made without it.
      const bool can_be_lacking = state == JobState::kFailed && graph_.may_lack(next, job);
      if (state == JobState::kAbsent)
        settle_locked(next, state);
      else if (state != JobState::kDone && !can_be_lacking)
        settle_locked(next, JobState::kBlocked);
      else if (inputs_are_settled(next))
        make_ready(next);
    }
    const std::size_t cell = graph_.cell_of(job);
    if (--waiting_in_cell_[cell] == 0) finished_cells_.push_back(cell);
    changed_.notify_all();
  }
  Stage& stage_of(JobIndex job) {
    const Job& one = graph_[job];
    const std::string name = one.kind == JobKind::kReference ? graph_.engines()[one.engine].name
                             : one.kind == JobKind::kRender  ? kOurs
                                                             : kJobKindNames[int(one.kind)].data();
    const auto found = std::ranges::find(stages_, name, &Stage::name);
    return found == stages_.end() ? stages_.emplace_back(Stage{name}) : *found;
  }
  void show_progress() {
    if (!options_.on_progress) return;
    FarmProgress progress{settled_, planned_, ""};
    for (const Stage& stage : stages_)
      if (stage.done < stage.count)
        progress.running += fmt::format("{}{} {}/{}", progress.running.empty() ? "" : ", ",
                                        stage.name, stage.done, stage.count);
    options_.on_progress(progress);
  }

  const JobGraph& graph_;
  const JobRunOptions& options_;
  const std::function<void(std::size_t)> on_cell_;

  mutable std::mutex mutex_;  // of everything below
  std::condition_variable changed_;
  std::vector<JobState>& states_;
  JobRunWork work_;
  std::map<std::size_t, std::size_t> waiting_in_cell_;
  std::vector<std::uint32_t> rank_;  ///< by cell: its place in the order
  std::priority_queue<Ready> ready_;
  std::deque<std::pair<Clock::time_point, JobIndex>> put_back_;
  std::deque<std::size_t> finished_cells_;
  std::size_t left_here_ = 0;
  std::vector<Stage> stages_;
  std::size_t settled_ = 0, planned_ = 0;
  std::exception_ptr broken_;
  bool stopped_ = false;
};

}  // namespace lobelia
