// Keeping a cache and a farm's directory in order: `lobelia farm status`, `verify`, `gc`, `clean` and `explain`.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>

#include "base/records/farm.hpp"

namespace lobelia {

struct CachePlace {
  std::filesystem::path cache;
  bool is_there = false;
  bool of_farm = false;  ///< found through a farm's directory
};

/// The cache at `path`, or that of the farm's directory `path`. Throws Error(kInput) if it is neither.
CachePlace cache_of(const std::filesystem::path& path);

struct VerifyReport {
  std::size_t results = 0, files = 0;
  std::uint64_t bytes = 0;
  std::vector<std::string> damaged;  ///< "KEY (render of n16): lobelia.exr has another content"
  std::size_t missing = 0;           ///< results that a farm's cells name and its cache lacks
};
using OnProgress = std::function<void(std::size_t done, std::size_t all)>;

/// Compares every file of every result with its hash, and opens every picture and record. `remove` removes damaged results,
/// which the next farm makes again. Throws Error(kInterrupted).
VerifyReport verify_cache(const std::filesystem::path& cache, bool remove,
                          const OnProgress& on_progress);
/// Likewise for the cache of a farm and every file under cells/, by the hashes in the cells' records. With `remove`, throws
/// Error(kOutput) while a farm is at work.
VerifyReport verify_farm(const std::filesystem::path& directory, bool remove,
                         const OnProgress& on_progress);

struct RemovalOptions {
  bool dry_run = false;  ///< removes and writes nothing
  std::function<void(const std::filesystem::path&)>
      on_removed;  ///< gets every path that goes, or would go
};

struct GcReport {
  std::size_t removed = 0, kept = 0, abandoned = 0;
  std::size_t others = 0;  ///< drafts of other machines, which stay
  std::uint64_t removed_bytes = 0, kept_bytes = 0;
  std::vector<std::string> stays;  ///< "PATH: why it cannot be removed"
};

/// Removes drafts of killed farms, failures of results that are there, and the least recently used results until the rest
/// has at most `max_bytes`. Throws Error(kOutput) while a farm uses the cache.
GcReport collect_garbage(const std::filesystem::path& cache, std::optional<std::uint64_t> max_bytes,
                         const RemovalOptions& options = {});

/// "10G", "1.5T", "500 MB"... in bytes, by powers of 1024. Throws Error(kUsage).
std::uint64_t parse_size(const std::string& text);

struct CleanReport {
  std::size_t cells = 0, files = 0;
  std::vector<std::string> stays;  ///< "PATH: why", for files that no farm and no gallery wrote
};

/// Removes cells that are not of the farm's grid, and temporary files of killed farms; with `all` every cell and the record.
/// Throws Error(kInput) if it is no farm's directory, Error(kOutput) while a farm is at work there.
CleanReport clean_farm(const std::filesystem::path& directory, bool all,
                       const RemovalOptions& options = {});

/// How many cells have each status.
records::StatusCounts count_statuses(const std::vector<std::string>& statuses);

/// The state of every cell. May be called while a farm is running there.
records::FarmStatus farm_status(const std::filesystem::path& directory);

/// The parts of the keys of a cell's results, or only of `job` ("reference-povray"), and which have changed. Engines are
/// those in $PATH, or at `programs`. Writes nothing. Throws Error(kInput) if there is no such farm, cell or job.
records::FarmExplanation explain_cell(const std::filesystem::path& directory,
                                      const std::string& cell, const std::string& job,
                                      const std::map<std::string, std::filesystem::path>& programs);

}  // namespace lobelia
