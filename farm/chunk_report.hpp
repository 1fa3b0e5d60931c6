// Reports of elements about their nodes: RUN/reports/NUMBER.json, with the number of the chunk.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "records/cluster.hpp"

namespace lobelia {

/// Jobs that an element left undone because of its node: another node may do them.
using records::LeftUndone;

struct ChunkReport {
  std::size_t number = 0;  ///< of the chunk
  std::string node;        ///< holds for is_node_name()
  std::vector<LeftUndone> left;
};

/// The node that this process runs on: $SLURMD_NODENAME, otherwise the host's name.
std::string own_node_name();

/// Writes nothing where nothing was left. Throws Error(kOutput), also where a link lies in the way or the node has no
/// proper name.
void write_chunk_report(const std::filesystem::path& run_directory, std::size_t number,
                        std::span<const LeftUndone> left);

struct ChunkReports {
  std::vector<ChunkReport> reports;   ///< by number
  std::vector<std::string> problems;  ///< sentences on files that are no such reports; at most ten
};

/// The reports of chunks from `first` to before `end`. Links, special files and files over 64 KiB are not read.
ChunkReports read_chunk_reports(const std::filesystem::path& run_directory, std::size_t first = 0,
                                std::size_t end = std::numeric_limits<std::size_t>::max());

}  // namespace lobelia
