// Makes the results of single jobs and publishes them, or keeps why there is none. For any thread.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "farm/failed_jobs.hpp"
#include "farm/job_board.hpp"
#include "farm/make_result.hpp"

namespace lobelia {

struct JobFailure {
  FailureClass kind = FailureClass::kNone;
  std::string message;  ///< empty: it has not failed
  int attempts = 0;
};

class JobMaker {
 public:
  JobMaker(JobGraph& graph, const ResultCache& cache, const JobRunOptions& options, JobBoard& board)
      : graph_(graph),
        cache_(cache),
        options_(options),
        board_(board),
        failed_(options.failed_directory) {}

  /// The right to make a result, among all processes and among the threads of this one: two cells may have one scene.
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
  /// Null while somebody else has it.
  std::unique_ptr<Claim> claim(JobIndex job);
  /// Settles the job if somebody has made its result since the farm looked.
  bool is_there(JobIndex job);

  /// Settles a job that is made in this process; false while somebody else is at work on it.
  bool make_here(JobIndex job);
  /// Publishes an engine's picture. Throws ResultFailure if it is none.
  void keep_reference(JobIndex job, const Scene& scene, ReferenceResult result, int attempt,
                      double wall_seconds);
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
  void publish(JobIndex job, ResultDraft& draft, records::Result record);

  JobGraph& graph_;
  const ResultCache& cache_;
  const JobRunOptions& options_;
  JobBoard& board_;
  FailedJobs failed_;
  std::mutex mutex_;
  std::set<ResultKey> claimed_;  ///< by threads of this process
};

}  // namespace lobelia
