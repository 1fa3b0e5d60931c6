// The layout of a cache's directory (result_cache.hpp): its parts, its drafts, and what may be removed from it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/system/byte_locks.hpp"
#include "base/system/removal.hpp"

namespace lobelia {

inline constexpr char kCacheMarkerFile[] = "lobelia-cache";
inline constexpr char kCacheLocksFile[] = "locks";
inline constexpr std::string_view kCacheLayout = "1\n";  ///< the marker's text

/// A process among all that may share a cache.
struct ProcessIdentity {
  std::string host;  ///< at most 40 of [A-Za-z0-9_-], and a hash of the machine's own number
  std::string boot;  ///< 32 hexadecimal digits, new ones after each start of the machine
  std::uint64_t pid_namespace = 0;
  std::uint64_t pid = 0;
  std::uint64_t start = 0;  ///< ticks since the boot
  bool operator==(const ProcessIdentity&) const = default;
};

/// The calling process.
ProcessIdentity this_process();

/// The name of a result in the making, which tells whether its maker lives:
/// "draft.HOST.BOOT.PIDNAMESPACE.PID.START.INODE.RANDOM", less than 200 characters.
struct DraftName {
  ProcessIdentity maker;
  std::uint64_t locks_inode = 0;  ///< of the lock file that the maker holds open
  std::uint64_t random = 0;

  std::string text() const;
  /// Empty for anything that text() does not write.
  static std::optional<DraftName> parse(std::string_view name);
};

/// 16 hexadecimal digits: names of drafts in earlier versions.
bool is_old_draft_name(std::string_view name);

enum class Life { kAlive, kDead, kUnknown };
/// kUnknown: the process belongs to another machine or namespace.
Life life_of(const ProcessIdentity& maker, const ProcessIdentity& self);

/// By its marker, or if that is lost, because it holds nothing but parts of a cache.
bool is_cache(const std::filesystem::path& directory);
/// Throws Error(kInput) if it is no cache, or has another layout.
void require_cache(const HeldDirectory& root);
/// Makes missing parts, except with kLook. Throws as the constructor of ResultCache.
HeldDirectory open_cache(const std::filesystem::path& directory, ByteLocks::Opening opening);

/// Whether it is the name of a directory in results/ or failures/: two hexadecimal digits.
bool is_cache_shelf(std::string_view name);
/// Owned are drafts, results and failures.
Owned owned_in_cache(const std::filesystem::path& relative);
Ownership cache_ownership();

}  // namespace lobelia
