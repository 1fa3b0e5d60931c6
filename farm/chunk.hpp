// A part of a farm's jobs as a file that another machine can do without the grid: scenes, engines, names of jobs.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/record.hpp"
#include "farm/farm_session.hpp"
#include "farm/job_run.hpp"

namespace lobelia {

/// The jobs of one chunk (kind "farm-chunk", docs/records.md).
Json chunk_record(FarmWork& work, const ResultCache& cache, const FarmOptions& options,
                  std::span<const JobIndex> jobs);

struct ChunkSummary {
  std::size_t jobs = 0;    ///< that the chunk names
  std::size_t done = 0;    ///< whose results are in the cache now
  std::size_t failed = 0;  ///< whose failures are
  JobRunWork work;
  /// Why this machine left jobs undone that another one can do: in what it is not as the plan has it, one sentence each.
  /// They have not failed.
  std::vector<std::string> handed_back;
};

/// Does what the file says, with `threads` threads. Jobs that are done already cost nothing; those whose inputs are neither there
/// nor have failed are left alone. What is handed back is told in a record beside the file, too (kind
/// "farm-handed-back", docs/records.md). Throws Error: kInput (no such chunk), kOutput, kInterrupted.
ChunkSummary exec_chunk(const std::filesystem::path& file, int threads);

}  // namespace lobelia
