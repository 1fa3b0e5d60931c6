// The layout of a cache's directory (result_cache.hpp): what is in it, and what of that a program may remove.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/byte_locks.hpp"
#include "core/removal.hpp"

namespace lobelia {

inline constexpr char kCacheMarkerFile[] = "lobelia-cache";  ///< by which a cache is known
inline constexpr char kCacheLocksFile[] = "locks";
inline constexpr std::string_view kCacheLayout = "1\n";  ///< the marker's text

/// By its marker. A directory that lost it and holds nothing but a cache's files is a cache too.
bool is_cache(const std::filesystem::path& directory);
/// Throws Error(kInput) if it is none, or of another layout.
void require_cache(const HeldDirectory& root);
/// Makes what is missing, except with kLook. Throws as the constructor of ResultCache.
HeldDirectory open_cache(const std::filesystem::path& directory, ByteLocks::Opening opening);

/// Whether it is the name of a directory in results/ or failures/: two hexadecimal digits.
bool is_cache_shelf(std::string_view name);
/// Drafts, results and kept failures.
Owned owned_in_cache(const std::filesystem::path& relative);
Ownership cache_ownership();

}  // namespace lobelia
