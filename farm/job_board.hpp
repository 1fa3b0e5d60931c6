// The jobs of a run: the board knows which can begin and which are done; the maker makes results. Both for any thread.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <queue>

#include "core/group_flush.hpp"
#include "farm/failed_jobs.hpp"
#include "farm/job_run.hpp"
#include "farm/make_result.hpp"

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
  std::vector<std::vector<JobIndex>> plan(const std::vector<std::size_t>& order);
  std::size_t planned() const { return planned_; }

  JobState state(JobIndex job) const;
  /// Whether a thread of this process makes the result.
  bool is_made_here(JobIndex job) const;
  /// Waits for a job that is made here and can begin, and finishes cells meanwhile; empty once there will be no more.
  std::optional<JobIndex> next();
  /// Another process is making it: next() gives it again later.
  void put_back(JobIndex job);
  /// Jobs that depend on it can begin, or become kBlocked or kAbsent.
  void settle(JobIndex job, JobState state);
  /// Calls `on_cell` for cells with nothing left to wait for.
  void finish_cells();

  void stop();                               ///< ends the run early
  void break_off(std::exception_ptr error);  ///< likewise; end() throws the first such error
  bool is_over() const;
  /// After the last job: finishes the cells with the failure that ended the run.
  void finish_failed_cells();
  /// Throws the error that broke the run.
  void end() const;

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
    ~Claim();
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

   private:
    friend class JobMaker;
    JobMaker& maker_;
    ResultKey key_;
    std::optional<ByteLocks::Claim> lock_;
  };
  /// Null while another process or thread has it.
  std::unique_ptr<Claim> claim(JobIndex job);
  /// Settles the job if its result has been made since the farm looked.
  bool is_there(JobIndex job);

  /// Makes the result in this process; false while another process or thread makes it. The job is settled once its
  /// files are on the disk.
  bool make_here(JobIndex job);
  /// Likewise for an engine's picture, whose claim it takes. Throws ResultFailure if it is not a valid one.
  void keep_reference(JobIndex job, const Scene& scene, ReferenceResult result, int attempt,
                      double wall_seconds, std::unique_ptr<Claim>& claim);
  void fail(JobIndex job, JobFailure failure, const std::string& log = {});

 private:
  using Hashes = records::Named<std::string>;
  const std::string& cell_id(JobIndex job) const {
    return graph_.cells().cells[graph_.cell_of(job)].id;
  }
  void settle_done(JobIndex job);
  void settle_lost(JobIndex job);
  std::string keep_input(JobIndex job, const std::string& log);
  records::Result result_record(JobIndex job, int attempts) const;
  MadePicture input_picture(JobIndex job, Hashes& from) const;
  bool discard_unreadable_inputs(JobIndex job) const;
  void make(JobIndex job, ResultDraft& draft, records::Result& record) const;
  struct Made {
    std::unique_ptr<Claim> claim;
    ResultDraft draft;
    records::Result record;
  };
  void publish(JobIndex job, std::unique_ptr<Claim>& claim, ResultDraft& draft,
               records::Result record);
  void place(JobIndex job, Made& made);

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
