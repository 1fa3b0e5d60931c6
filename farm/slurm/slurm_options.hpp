// A user's options of Slurm for the elements of a run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lobelia {

/// Handed on as sbatch's options of the same names; empty ones are left to Slurm.
struct SlurmOptions {
  std::string partition, time, memory, account, qos, constraint;
  std::string exclude;           ///< nodes, as a list of Slurm's: "n1,m[3-5]"
  bool exclusive = false;        ///< no other job on the node: for timings
  int processors = 1;            ///< of each element (--cpus-per-task)
  int throttle = 0;              ///< elements at once, 0: as many as there is room for
  std::vector<std::string> raw;  ///< further options of sbatch, "--name" or "--name=value"
};

/// An element's memory: so many bytes for the job of each processor, and 512 MiB for this program; "4608M".
std::string memory_of_element(std::uint64_t job_bytes, int processors);

/// Throws Error(kUsage) on a value with control characters or out of range, and on a raw option that does not begin with
/// "--" or that a run sets itself.
std::vector<std::string> sbatch_arguments(const SlurmOptions& options);

}  // namespace lobelia
