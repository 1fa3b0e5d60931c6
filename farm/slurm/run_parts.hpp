// The parts of a run on Slurm: its record, the nodes' reports, the elements' request, and the submission of rounds.
#pragma once

#include <set>

#include "farm/slurm/slurm_client.hpp"
#include "farm/slurm/slurm_run.hpp"
#include "records/cluster.hpp"

namespace lobelia {

struct RunContext {
  RunContext(const SlurmWork& w, const SlurmRunOptions& o)
      : work(w), options(o), client(o.call_limit) {}

  void say(const std::string& sentence) const {
    if (options.say) options.say(sentence);
  }
  /// Notes a job, once; a second Ctrl-C says that it is left running.
  void note(SlurmJobId id);
  void write_record() const;

  const SlurmWork& work;
  const SlurmRunOptions& options;
  const SlurmClient client;
  std::filesystem::path directory;  ///< absolute
  records::SlurmRun record;
  SlurmOutcome outcome;
};

using NodeNames = std::set<std::string>;

/// The name of all jobs of a run, by which they are found and cancelled: "lobelia-" and a hash of the directory's real path.
std::string job_name(const std::filesystem::path& run_directory);
/// Without a name if there is no record. One that names jobs of another directory, as a copied or forged record does, gets
/// the name of this one and no arrays; `foreign` then is a sentence about it.
records::SlurmRun read_run_record(const std::filesystem::path& run_directory, std::string& foreign);
/// Adds the elements that squeue shows to the counts.
void count_elements(const std::vector<SlurmElement>& elements, SlurmProgress& progress);
/// False if interrupted and `until_interrupted`.
bool wait_for(std::chrono::duration<double> time, bool until_interrupted = true);
/// "job 7", "jobs 7, 8"
std::string ids_text(const std::vector<SlurmJobId>& ids);
/// "1 element", "2 elements"
std::string count_text(std::size_t count, std::string_view what);
/// Adds an item, after a comma unless it is the first.
void append_item(std::string& list, std::string_view item);

/// Nodes that handed back jobs of a run. They get no more jobs of that engine.
class NodeReports {
 public:
  explicit NodeReports(const RunContext& run) : run_(run) {}

  /// Reads the reports of this run's chunks, and says which are new.
  void read(const std::string& partition);
  /// Nodes that jobs of this batch avoid.
  NodeNames nodes_without(const std::string& batch) const;
  /// Why they do: "n1 handed it back (...)".
  std::string reasons(const NodeNames& nodes, const std::string& batch) const;
  /// False also if Slurm does not answer. `states` gets the states of the other nodes.
  bool no_other_node_is_usable(const std::string& partition, const NodeNames& without,
                               std::string& states) const;

 private:
  void say_once(const std::string& problem);

  const RunContext& run_;
  /// By engine (empty: all), then by node: why it handed jobs back.
  std::map<std::string, std::map<std::string, std::string>> without_engine_;
  std::set<std::string> told_;  ///< problems
};

/// The elements' request for time and memory, which grows in the next round if they ran out of either.
class ElementRequest {
 public:
  explicit ElementRequest(const RunContext& run);

  const SlurmOptions& options() const { return asked_; }
  /// Takes over the larger requests of an earlier client's jobs.
  void take_over(const std::vector<SlurmJobId>& ids);
  /// Notes and says how the elements of a job ended.
  void note_endings(SlurmJobId id, const std::vector<SlurmElement>& elements);
  /// Whether somebody cancelled elements, which is said: then nothing more is to be submitted.
  bool was_ended_by_somebody() const;
  void say_what_was_too_little() const;
  /// Doubles the request for time or memory that was too little.
  void raise();

 private:
  std::string what_ended(SlurmEnding end, const char* where = "") const;
  SlurmPartition partition() const;
  std::optional<long long> most_memory() const;

  const RunContext& run_;
  SlurmOptions asked_;
  std::map<SlurmEnding, std::size_t> endings_;  ///< of elements since the last round was submitted
};

/// Submits rounds of a run: jobs as arrays of chunks, each with its script.
class Submitter {
 public:
  Submitter(RunContext& run, const NodeReports& reports, const ElementRequest& request);

  /// Returns the arrays. Gives up jobs without a node.
  std::vector<SlurmJobId> submit_round(const std::vector<SlurmJob>& jobs);
  /// Gives up jobs if no usable node accepts their engine. Whether there were any.
  bool give_up_where_no_node_is_left(const std::vector<SlurmJob>& jobs);
  /// Nodes that an array avoids.
  NodeNames nodes_without(SlurmJobId array) const {
    const auto found = without_.find(array);
    return found == without_.end() ? NodeNames() : found->second;
  }

 private:
  ChunkRule rule() const;
  void give_up(const std::vector<SlurmJob>& jobs, const std::vector<std::size_t>& places,
               const std::string& why);
  std::string script_of(const records::SlurmArray& array,
                        const std::vector<Sha256Digest>& chunks) const;
  SlurmJobId submit(records::SlurmArray array, const std::vector<Sha256Digest>& chunks,
                    const std::vector<SlurmJobId>& after, const NodeNames& without,
                    std::string& refusal);
  std::optional<SlurmJobId> call_sbatch(const std::vector<std::string>& arguments,
                                        const std::filesystem::path& script,
                                        const std::string& comment, bool excludes,
                                        std::string& refusal) const;

  RunContext& run_;
  const NodeReports& reports_;
  const ElementRequest& request_;
  const std::vector<std::string> finish_arguments_;
  std::map<SlurmJobId, NodeNames> without_;
};

}  // namespace lobelia
