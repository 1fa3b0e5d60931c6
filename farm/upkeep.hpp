// Keeping a cache and a farm's directory in order: what `lobelia farm status`, `verify`, `gc` and `clean` do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/record.hpp"

namespace lobelia {

/// The cache at `path`, which is one or a farm's directory. Throws Error(kInput) if it is neither.
std::filesystem::path cache_of(const std::filesystem::path& path);

struct VerifyReport {
  std::size_t results = 0, files = 0;
  std::uint64_t bytes = 0;
  std::vector<std::string> damaged;  ///< "KEY (render of n16): lobelia.exr has another content"
};

/// Reads every byte of every result again, compares it with its hash, and opens every picture and record, on all
/// processors. With `remove` what is damaged is taken away, so that the next farm makes it again. Throws
/// Error(kInterrupted).
VerifyReport verify_cache(
    const std::filesystem::path& cache, bool remove,
    const std::function<void(std::size_t done, std::size_t all)>& on_progress);

struct GcReport {
  std::size_t removed = 0, kept = 0, abandoned = 0;
  std::uint64_t removed_bytes = 0, kept_bytes = 0;
};

/// Takes away what killed farms left half-made, failures of results that are there, and the results that were not used
/// for longest until the rest is at most `max_bytes`. Throws Error(kOutput) while a farm uses the cache.
GcReport collect_garbage(const std::filesystem::path& cache,
                         std::optional<std::uint64_t> max_bytes);

/// "10G", "1.5T", "500 MB"... in bytes, by powers of 1024. Throws Error(kUsage).
std::uint64_t parse_size(const std::string& text);

struct CleanReport {
  std::size_t cells = 0, files = 0;
};

/// Takes away from a farm's directory the cells that are not of its grid and what killed farms left behind;
/// with `all` every cell, and its record. The cache stays. Throws Error(kInput) if it is no farm's directory.
CleanReport clean_farm(const std::filesystem::path& directory, bool all);

/// What has become of every cell so far: kind "farm-status", docs/records.md. Also while a farm is at work there.
Json farm_status(const std::filesystem::path& directory);

}  // namespace lobelia
