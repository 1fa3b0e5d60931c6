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
  std::filesystem::path gallery;  ///< FarmOptions::gallery
};

struct SlurmEnd {
  FarmSummary farm;
  std::filesystem::path directory, gallery;
};

/// As run_farm(), by the nodes of a cluster that share the file system of `directory` and of the cache. `grid_file` is
/// where the grid was read from: the last element reads it again. Throws as run_on_slurm() besides.
SlurmFarmSummary run_farm_on_slurm(const Grid& grid, const std::filesystem::path& grid_file,
                                   const std::filesystem::path& directory,
                                   const FarmOptions& options, SlurmRunOptions slurm);

/// The same for the run that was begun in `directory`, by whichever client: waits for its jobs, and goes on with what
/// they leave. Throws Error(kInput) if there is none.
SlurmFarmSummary attach_to_slurm_run(const std::filesystem::path& directory,
                                     const SlurmRunOptions& slurm);

/// DIRECTORY/runs/slurm: one at a time for each farm.
std::filesystem::path slurm_run_directory(const std::filesystem::path& directory);

/// What an element does: chunk NUMBER of the run. As many threads as Slurm gave it, otherwise one.
ChunkSummary exec_slurm_chunk(const std::filesystem::path& run_directory, std::size_t number);

/// What the last element does: puts the farm's directory together from what the others made.
SlurmEnd finish_slurm_run(const std::filesystem::path& run_directory);

/// The program that runs, by the path under which the nodes find it too.
std::filesystem::path own_program();

/// Seconds that a job takes on one processor, about: what chunks are cut by.
double estimated_seconds(JobKind kind, std::string_view engine, const Scene& scene);

}  // namespace lobelia
