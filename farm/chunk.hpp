// Some of a farm's jobs as a file for another machine, which needs no grid: scenes, engines, names of jobs.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "farm/chunk_report.hpp"
#include "farm/farm_session.hpp"
#include "farm/job_run.hpp"

namespace lobelia {

/// The jobs of one chunk.
records::FarmChunk chunk_record(FarmWork& work, const ResultCache& cache,
                                const FarmOptions& options, std::span<const JobIndex> jobs);

struct ChunkSummary {
  std::size_t jobs = 0;    ///< that the chunk names
  std::size_t done = 0;    ///< whose results are in the cache now
  std::size_t failed = 0;  ///< whose failures are
  std::size_t undone = 0;  ///< left for another machine
  JobRunWork work;
  /// Why: this machine is not as planned, or an engine failed again and again.
  std::vector<LeftUndone> left;
};

/// Does the jobs of the file whose inputs are there. Throws Error: kInput (no such chunk), kOutput, kInterrupted.
ChunkSummary exec_chunk(const std::filesystem::path& file, int threads);

}  // namespace lobelia
