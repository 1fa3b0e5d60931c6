// Slurm's own programs, each run with a time limit and in a clean environment.
#pragma once

#include <chrono>
#include <filesystem>

#include "farm/slurm/slurm_answers.hpp"

namespace lobelia {

struct SlurmSubmission {
  std::optional<SlurmJobId> job;
  std::string why;       ///< Slurm's words, if there is no job
  bool unclear = false;  ///< the controller did not answer: it may have taken the job
};

/// An answer, or why there is none.
template <class T>
struct SlurmAnswer {
  std::optional<T> value;
  std::string why;
  explicit operator bool() const { return value.has_value(); }
  const T& operator*() const { return *value; }
  const T* operator->() const { return &*value; }
};

class SlurmClient {
 public:
  /// `time_limit` is for each call.
  explicit SlurmClient(std::chrono::duration<double> time_limit = std::chrono::seconds(15))
      : time_limit_(time_limit) {}

  /// Needed programs of Slurm that are not in $PATH.
  static std::vector<std::string> absent_programs();

  /// Runs sbatch with `arguments` and a script. An interruption does not cut it short.
  SlurmSubmission submit(const std::vector<std::string>& arguments,
                         const std::filesystem::path& script) const;
  /// Every element that Slurm still knows, including ended ones; none if the job of that id has another name by now.
  SlurmAnswer<std::vector<SlurmElement>> elements(SlurmJobId job, const std::string& name) const;
  /// The user's own jobs of that name that have not ended.
  SlurmAnswer<std::vector<SlurmLivingJob>> living_jobs(const std::string& name) const;
  /// Cancels all of the user's jobs of that name. Returns why not; empty on success.
  std::string cancel(const std::string& name) const;
  /// Returns why the controller does not answer; empty if it does.
  std::string ping() const;
  SlurmAnswer<std::map<std::string, std::string>> config() const;
  /// The nodes of `partition`, which may be several, separated by commas; of the default one if empty.
  SlurmAnswer<std::vector<SlurmNode>> node_list(const std::string& partition) const;
  SlurmAnswer<SlurmPartition> partition(const std::string& name) const;

 private:
  struct Output {
    std::vector<std::string> lines;
    std::string why;  ///< it failed; empty if not
    bool in_time = true;
  };
  Output run(std::vector<std::string> arguments) const;
  template <class T>
  SlurmAnswer<T> ask(const std::vector<std::string>& arguments,
                     std::optional<T> (*parse)(std::span<const std::string>)) const;

  std::chrono::duration<double> time_limit_;
};

}  // namespace lobelia
