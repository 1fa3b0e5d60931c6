// A grid's jobs on a Slurm cluster, by farm/slurm/slurm_run.hpp.
#pragma once

#include "farm/chunk.hpp"
#include "farm/slurm/slurm_run.hpp"

namespace lobelia {

struct SlurmFarmSummary {
  FarmSummary farm;
  SlurmOutcome slurm;
  std::filesystem::path directory, gallery;  ///< the farm's, and FarmOptions::gallery
};

/// run_farm() on nodes that share the directory's and the cache's file system, and `grid_file`. Throws as run_on_slurm()
/// too.
SlurmFarmSummary run_farm_on_slurm(const Grid& grid, const std::filesystem::path& grid_file,
                                   const std::filesystem::path& directory,
                                   const FarmOptions& options, SlurmRunOptions slurm);

/// Goes on with the run that another client began in `directory`. Throws Error(kInput) if there is none, and Error(kUsage)
/// without leave for what its record says: the programs to start, and places outside of `directory` to write into.
SlurmFarmSummary attach_to_slurm_run(const std::filesystem::path& directory,
                                     const SlurmRunOptions& slurm, const Leave& leave);

/// DIRECTORY/runs/slurm: a farm has one run at a time.
std::filesystem::path slurm_run_directory(const std::filesystem::path& directory);

/// For an element: exec_chunk() of chunk NUMBER, as it was planned, with the threads that Slurm gave it, otherwise one.
ChunkSummary exec_slurm_chunk(const std::filesystem::path& run_directory, std::size_t number,
                              const Sha256Digest& planned, const Leave& leave);

/// For the last element: writes the farm's directory from the results of the others. `planned` is SlurmWork::run_record when
/// it was submitted. Throws as attach_to_slurm_run(), and Error(kInput) if the run's record says other things by now.
SlurmFarmSummary finish_slurm_run(const std::filesystem::path& run_directory,
                                  const Sha256Digest& planned, const Leave& leave);

/// About how many seconds a job takes on one processor, for the size of chunks. `engine` is null for our own picture.
double estimated_seconds(JobKind kind, const EngineInfo* engine, const Scene& scene);

}  // namespace lobelia
