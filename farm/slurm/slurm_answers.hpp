// Reads the output of Slurm's programs, whole answers or none. Formats: the manual pages of Slurm 22.05.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lobelia {

using SlurmJobId = std::uint32_t;  ///< never 0

/// One line of squeue: an element of an array, or several in compact form.
struct SlurmElement {
  enum class State { kPending, kRunning, kEnded };  ///< running: neither of the others
  State state = State::kPending;
  std::size_t count = 1;   ///< elements that the line stands for, or shows ("1_[3-9,...]")
  std::string state_name;  ///< as printed: "RUNNING"
  std::string reason;      ///< why it waits, or how it ended
  std::string nodes;
  std::optional<std::size_t> task = {};  ///< place in the array, if the line shows one element
};

enum class SlurmEnding {
  kWell,
  kFailed,     ///< its own exit code or signal, or it could not be started
  kTime,       ///< its time limit
  kMemory,     ///< it used more than it had requested
  kNode,       ///< the node was lost, or did not start
  kPreempted,  ///< it made room for others, or another cluster took it
  kDeadline,   ///< --deadline
  kCancelled,
};

/// By an element's state. FAILED includes OverMemoryKill, the end by Slurm's accounting: only the log says so.
SlurmEnding end_of(const SlurmElement& element);
/// "time limit reached". Empty if the state's name says it.
std::string_view words_for(SlurmEnding end);
/// Whether this line of a log is slurmstepd's message that the element used too much memory.
bool tells_of_memory(std::string_view line);

/// A job that has not ended, by `squeue -o '%F|%T|%k'`.
struct SlurmLivingJob {
  SlurmJobId id = 0;
  std::string state_name, comment;
};

/// One line of `sinfo -h -N -o '%N|%P|%a|%t|%m|%C'`: a node, once for each of its partitions.
struct SlurmNode {
  std::string name, partition, state;
  bool is_default = false;     ///< the partition
  bool usable = false;         ///< it runs jobs, now or after its present ones
  long long mebibytes = 0;     ///< of memory
  std::size_t processors = 0;  ///< idle or allocated
};

/// Limits of a partition, by `scontrol -o show partition NAME`; empty: no limit.
struct SlurmPartition {
  std::optional<long long> most_seconds, most_mebibytes;
};

/// Letters, digits, "-", "_" and ".", a letter or digit first.
bool is_node_name(std::string_view text);

/// The number of elements of "7", "3-9", "[1,3-9:2%4]" or "N/A"; empty for other text.
std::optional<std::size_t> count_of_array_tasks(std::string_view text);

/// Reads `sbatch --parsable`: "12" or "12;cluster", among lines of warnings.
std::optional<SlurmJobId> parse_submission(std::span<const std::string> lines);

/// Reads `squeue -h -r -o '%K|%T|%r|%N'`. Lines that begin with "squeue: " are its warnings.
std::optional<std::vector<SlurmElement>> parse_elements(std::span<const std::string> lines);
/// Each job once, by id, however many lines its array has.
std::optional<std::vector<SlurmLivingJob>> parse_living_jobs(std::span<const std::string> lines);

std::optional<std::vector<SlurmNode>> parse_node_list(std::span<const std::string> lines);
std::optional<SlurmPartition> parse_partition(std::span<const std::string> lines);

/// "Key = value" of `scontrol show config`, at least one.
std::optional<std::map<std::string, std::string>> parse_config(std::span<const std::string> lines);
/// The number that a value begins with, such as "30 sec"; `otherwise` if there is none.
long long config_number(const std::map<std::string, std::string>& config, const std::string& key,
                        long long otherwise);

/// Whether a pending element is held or refused, and never starts unless somebody acts.
bool waits_for_somebody(const SlurmElement& element);
/// False for reasons that name nodes: "ReqNodeNotAvail, UnavailableNodes:n2" may also mean waiting for another node.
bool waits_for_somebody(std::string_view reason);

}  // namespace lobelia
