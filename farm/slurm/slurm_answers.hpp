// Reads what Slurm's programs print: an answer is understood whole, or not at all. Formats: the manual pages of
// sbatch, squeue, sinfo and scontrol, Slurm 22.05.
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
  enum class State { kPending, kRunning, kEnded };  ///< running: whatever is neither of the others
  State state = State::kPending;
  std::size_t count = 1;   ///< elements that the line stands for, or shows ("1_[3-9,...]")
  std::string state_name;  ///< as printed: "RUNNING"
  std::string reason;      ///< why it waits, or how it ended
  std::string nodes;
  std::optional<std::size_t> task = {};  ///< place in the array, if the line is of one element
};

enum class SlurmEnding {
  kWell,
  kFailed,     ///< its own exit code or signal, or it could not be started
  kTime,       ///< its time limit
  kMemory,     ///< it used more than it had asked for
  kNode,       ///< the node was lost, or did not come up
  kPreempted,  ///< it made room for others, or another cluster took it
  kDeadline,   ///< --deadline
  kCancelled,
};

/// By an element's state. It is FAILED also where Slurm's accounting ended it for its memory (OverMemoryKill); only the
/// log tells.
SlurmEnding end_of(const SlurmElement& element);
/// "time limit reached". Empty where the state's own name says it.
std::string_view words_for(SlurmEnding end);
/// Whether slurmstepd says in this line of a log that the element used too much memory.
bool tells_of_memory(std::string_view line);

/// A job that lives, by `squeue -o '%F|%T|%k'`.
struct SlurmLivingJob {
  SlurmJobId id = 0;
  std::string state_name, comment;
};

/// One line of `sinfo -h -o '%P|%a|%t|%D|%C'`: the nodes of a partition that are in one state.
struct SlurmNodes {
  std::string partition;
  bool is_default = false;
  bool up = false;      ///< the partition
  bool usable = false;  ///< such nodes run jobs, now or after those that they have
  std::string state;
  std::size_t nodes = 0, processors = 0;  ///< processors: idle or allocated
};

/// One line of `sinfo -h -N -o '%N|%P|%a|%t|%m'`: a node, once for each of its partitions.
struct SlurmNode {
  std::string name, partition, state;
  bool is_default = false;  ///< the partition
  bool usable = false;      ///< as of SlurmNodes, and the partition is up
  long long mebibytes = 0;  ///< of memory
};

/// Limits of a partition, by `scontrol -o show partition NAME`; empty where there is none.
struct SlurmPartition {
  std::optional<long long> most_seconds, most_mebibytes;
};

/// Letters, digits, "-", "_" and ".", with a letter or digit first.
bool is_node_name(std::string_view text);

/// Elements that "7", "3-9", "[1,3-9:2%4]" or "N/A" stand for; empty if it is none of them.
std::optional<std::size_t> count_of_array_tasks(std::string_view text);

/// Reads `sbatch --parsable`: "12" or "12;cluster", among lines of warnings.
std::optional<SlurmJobId> parse_submission(std::span<const std::string> lines);

/// Reads `squeue -h -r -o '%K|%T|%r|%N'`. Lines that begin with "squeue: " are its warnings.
std::optional<std::vector<SlurmElement>> parse_elements(std::span<const std::string> lines);
/// Each job once, whatever number of lines its array has.
std::optional<std::vector<SlurmLivingJob>> parse_living_jobs(std::span<const std::string> lines);

std::optional<std::vector<SlurmNodes>> parse_nodes(std::span<const std::string> lines);
std::optional<std::vector<SlurmNode>> parse_node_list(std::span<const std::string> lines);
std::optional<SlurmPartition> parse_partition(std::span<const std::string> lines);

/// "Key = value" of `scontrol show config`, at least one.
std::optional<std::map<std::string, std::string>> parse_config(std::span<const std::string> lines);

/// Whether a pending element is held or refused, so that it never starts until somebody does something.
bool waits_for_somebody(const SlurmElement& element);
/// Reasons that name nodes do not tell: "ReqNodeNotAvail, UnavailableNodes:n2" also stands where the job waits for
/// another node.
bool waits_for_somebody(std::string_view reason);

}  // namespace lobelia
