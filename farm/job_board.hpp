// The jobs of a run: which can be begun, which are done, and when a cell is finished. For any thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <queue>

#include "farm/job_run.hpp"

namespace lobelia {

/// Pause before asking again whether somebody else has made a result.
inline constexpr auto kLookAgain = std::chrono::milliseconds(50);

class JobBoard {
 public:
  JobBoard(const JobGraph& graph, const JobRunOptions& options, std::vector<JobState> states)
      : graph_(graph), options_(options), states_(std::move(states)) {}

  /// Takes what is waiting, cells in this order. Returns the jobs of each engine that is a program.
  std::vector<std::vector<JobIndex>> plan(const std::vector<std::size_t>& order,
                                          std::function<void(std::size_t)> on_cell);
  std::size_t planned() const { return planned_; }

  JobState state(JobIndex job) const;
  /// Whether a thread of this process makes the result.
  bool is_made_here(JobIndex job) const;
  /// Waits for a job that is made here and can begin; none if there will be no more.
  std::optional<JobIndex> next();
  /// Somebody else is at work on it: next() gives it again later.
  void put_back(JobIndex job);
  /// Jobs that depend on it can begin, or become kBlocked or kAbsent.
  void settle(JobIndex job, JobState state);
  /// Calls `on_cell` for cells with nothing left to wait for.
  void finish_cells();

  /// The run ends early.
  void stop();
  void break_off(std::exception_ptr error);  ///< the first is the one that end() throws
  bool is_over() const;
  /// After the last thread: throws what broke the run, and Error(kInterrupted). Finishes cells with a failure that ended it.
  void end();

  /// Changes the counts of what the run took.
  void count(const std::function<void(JobRunWork&)>& change);
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

  bool is_over_locked() const;
  bool inputs_are_settled(JobIndex job) const;
  void make_ready(JobIndex job);
  void settle_locked(JobIndex job, JobState state);
  Stage& stage_of(JobIndex job);
  void show_progress();

  const JobGraph& graph_;
  const JobRunOptions& options_;
  std::function<void(std::size_t)> on_cell_;

  mutable std::mutex mutex_;  // of everything below
  std::condition_variable changed_;
  std::vector<JobState> states_;
  JobRunWork work_;
  std::map<std::size_t, std::size_t> waiting_in_cell_;
  std::vector<std::uint32_t> rank_;  ///< of a cell in the order
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
