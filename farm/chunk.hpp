// Chunks: some of a farm's jobs as a file for another machine. It reports to RUN/reports/NUMBER.json, by the chunk's number.
#pragma once

#include <limits>
#include <optional>

#include "base/system/sha256.hpp"
#include "farm/farm_session.hpp"

namespace lobelia {

using records::LeftUndone;

records::FarmChunk chunk_record(FarmWork& work, const ResultCache& cache,
                                const FarmOptions& options, std::span<const JobIndex> jobs);

struct ChunkSummary {
  std::size_t jobs = 0;    ///< named in the chunk
  std::size_t done = 0;    ///< with a result in the cache now
  std::size_t failed = 0;  ///< with a failure in the cache now
  std::size_t undone = 0;  ///< left for another machine
  JobRunWork work;
  /// Why jobs were left: this machine is not as planned, or an engine failed again and again.
  std::vector<LeftUndone> left;
};

/// Does the jobs of the file that have their inputs. A chunk says what is started, what is read and where it is written,
/// so it needs leave. With `planned`, it also has to be the file that was planned: of that hash. Throws Error: kUsage (no
/// leave), kInput (no such chunk, or another one than was planned), kOutput, kInterrupted.
ChunkSummary exec_chunk(const std::filesystem::path& file, int threads, const Leave& leave,
                        const std::optional<Sha256Digest>& planned = {});

/// Its `node` is a valid node name.
struct ChunkReport : records::FarmChunkReport {
  std::size_t number = 0;  ///< of the chunk
};

/// The node that this process runs on: $SLURMD_NODENAME, otherwise the host's name.
std::string own_node_name();

/// Writes nothing if nothing was left. Throws Error(kOutput), also if a link is in the way or the node's name is no valid
/// one.
void write_chunk_report(const std::filesystem::path& run_directory, std::size_t number,
                        std::span<const LeftUndone> left);

struct ChunkReports {
  std::vector<ChunkReport> reports;   ///< by number
  std::vector<std::string> problems;  ///< sentences on invalid files; at most ten
};

/// The reports of chunks from `first` to before `end`. Does not read links, special files and files over 64 KiB.
ChunkReports read_chunk_reports(const std::filesystem::path& run_directory, std::size_t first = 0,
                                std::size_t end = std::numeric_limits<std::size_t>::max());

}  // namespace lobelia
