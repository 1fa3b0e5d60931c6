// A user's options for the elements of a run, and their time and memory as sbatch takes them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lobelia {

/// Passed to sbatch as the options of the same names, unless empty.
struct SlurmOptions {
  std::string partition, time, memory, account, qos, constraint;
  std::string exclude;           ///< nodes, as a list of Slurm's: "n1,m[3-5]"
  bool exclusive = false;        ///< no other job on the node: for timings
  int processors = 1;            ///< of each element (--cpus-per-task)
  int throttle = 0;              ///< elements at once; 0: no limit
  std::vector<std::string> raw;  ///< further options of sbatch, "--name" or "--name=value"
};

/// An element's memory, "4608M": `job_bytes` for each processor, and 512 MiB for this program.
std::string memory_of_element(std::uint64_t job_bytes, int processors);

/// Throws Error(kUsage) for control characters, values out of range, and raw options without "--" or set by a run itself.
std::vector<std::string> sbatch_arguments(const SlurmOptions& options);

/// Seconds of "90" (minutes), "90:30", "1:30:00", "2-12", "2-12:30" or "2-12:30:00". Empty for others, "0" and "UNLIMITED".
std::optional<long long> parse_slurm_time(std::string_view text);
/// "1:30:00", "2-12:30:00"
std::string slurm_time_text(long long seconds);

/// Mebibytes of "4000", "4000M", "4G", "1T" or "512K", rounded up. Empty for anything else, including "0" (all of a node's).
std::optional<long long> parse_slurm_memory(std::string_view text);
/// "4G", "1500M"
std::string slurm_memory_text(long long mebibytes);

/// Moves --time, --mem and --exclude from the raw options into their own fields.
SlurmOptions with_own_fields(SlurmOptions options);

/// Twice a request, at most `most`. Empty if that is no more than before.
std::optional<long long> twice_at_most(long long asked, std::optional<long long> most);

}  // namespace lobelia
