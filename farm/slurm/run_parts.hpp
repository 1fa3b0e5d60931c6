// The parts of a run on Slurm besides its client and its submissions.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

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
  /// Notes a job once, also in what a second Ctrl-C says.
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

/// Empty if there is none.
records::SlurmRun read_run_record(const std::filesystem::path& run_directory);
/// Adds the elements that squeue shows.
void count_elements(const std::vector<SlurmElement>& elements, SlurmProgress& progress);
/// False if interrupted meanwhile and that is looked at.
bool wait_for(std::chrono::duration<double> time, bool until_interrupted = true);
/// "job 7", "jobs 7, 8"
std::string ids_text(const std::vector<SlurmJobId>& ids);
/// "1 element", "2 elements"
std::string count_text(std::size_t count, std::string_view what);
/// With a comma before it, unless it is the first.
void append_item(std::string& list, std::string_view item);

/// Nodes that handed jobs of a run back: they get no more of that engine's jobs.
class NodeReports {
 public:
  explicit NodeReports(const RunContext& run) : run_(run) {}

  /// Reads the reports of this run's chunks, and says what is new.
  void read(const std::string& partition);
  /// Nodes that jobs of this batch stay away from.
  NodeNames nodes_without(const std::string& batch) const;
  /// Why, as "n1 handed it back (...)".
  std::string reasons(const NodeNames& nodes, const std::string& batch) const;
  /// False also where Slurm does not say. `states` gets those of the other nodes.
  bool no_other_node_is_usable(const std::string& partition, const NodeNames& without,
                               std::string& states) const;

 private:
  const std::string* reason_of(const std::string& engine, const std::string& node) const;
  void say_once(const std::string& problem);

  const RunContext& run_;
  /// By engine (empty: all), then by node: why it hands its jobs back.
  std::map<std::string, std::map<std::string, std::string>> without_engine_;
  std::set<std::string> told_;  ///< problems
};

/// The elements' request for time and memory. If they ran out of either, the next round asks for more.
class ElementRequest {
 public:
  explicit ElementRequest(const RunContext& run);

  const SlurmOptions& options() const { return asked_; }
  /// Jobs of an earlier client may ask for more already.
  void take_over(const std::vector<SlurmJobId>& ids);
  /// Notes and says how the elements of a job ended.
  void note_endings(SlurmJobId id, const std::vector<SlurmElement>& elements);
  /// Somebody cancelled elements: says so, and nothing more is to be submitted.
  bool was_ended_by_somebody() const;
  void say_what_was_too_little() const;
  /// Asks for twice as much of what was too little.
  void raise();

 private:
  std::size_t ended(SlurmEnding end) const;
  std::string what_ended(SlurmEnding end, const char* where = "") const;
  SlurmPartition partition() const;
  std::optional<long long> most_memory() const;

  const RunContext& run_;
  SlurmOptions asked_;
  std::map<SlurmEnding, std::size_t> endings_;  ///< of elements since the last round was submitted
};

}  // namespace lobelia
