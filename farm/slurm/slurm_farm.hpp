// The farm's jobs on a Slurm cluster: farm/slurm/slurm_run.hpp with a grid's jobs in it.
#pragma once

#include <filesystem>
#include <string>

#include "farm/chunk.hpp"
#include "farm/farm.hpp"
#include "farm/slurm/slurm_run.hpp"

namespace lobelia {

struct SlurmFarmSummary {
  FarmSummary farm;
  SlurmOutcome slurm;
  std::filesystem::path directory, gallery;  ///< the farm's, and FarmOptions::gallery
};

/// As run_farm(), by nodes that share the file system of `directory` and of the cache. The last element reads
/// `grid_file` again. Throws as run_on_slurm() besides.
SlurmFarmSummary run_farm_on_slurm(const Grid& grid, const std::filesystem::path& grid_file,
                                   const std::filesystem::path& directory,
                                   const FarmOptions& options, SlurmRunOptions slurm);

/// Goes on with the run that some client began in `directory`. Throws Error(kInput) if there is none.
SlurmFarmSummary attach_to_slurm_run(const std::filesystem::path& directory,
                                     const SlurmRunOptions& slurm);

/// DIRECTORY/runs/slurm: one at a time for each farm.
std::filesystem::path slurm_run_directory(const std::filesystem::path& directory);

/// For an element: does chunk NUMBER with as many threads as Slurm gave it, otherwise one.
ChunkSummary exec_slurm_chunk(const std::filesystem::path& run_directory, std::size_t number);

/// For the last element: writes the farm's directory from what the others made.
SlurmFarmSummary finish_slurm_run(const std::filesystem::path& run_directory);

/// The program that runs, by the path under which the nodes find it too.
std::filesystem::path own_program();

/// About how many seconds a job takes on one processor, to cut chunks by.
double estimated_seconds(JobKind kind, std::string_view engine, const Scene& scene);

}  // namespace lobelia
