#include "farm/cache_layout.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/sha256.hpp"
#include "farm/draft_name.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr const char* kParts[] = {"results", "failures", "contents", "making"};

bool is_key(std::string_view name) {
  Sha256Digest digest;
  return from_hex(name, digest);
}

/// Whether nothing is in it but what a cache consists of; an NFS client's own names for removed files aside.
bool has_only_our_names(const HeldDirectory& directory) {
  for (const std::string& name : directory.names()) {
    struct stat status {};
    if (name.starts_with(".nfs")) continue;
    if (::fstatat(directory.fd(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) continue;
    const bool is_part = std::ranges::find(kParts, name) != std::end(kParts);
    if (is_part ? S_ISREG(status.st_mode) : name != kCacheLocksFile || !S_ISREG(status.st_mode))
      return false;
  }
  return true;
}

}  // namespace

bool is_cache_shelf(std::string_view name) {
  return name.size() == 2 && name.find_first_not_of("0123456789abcdef") == name.npos;
}

Owned owned_in_cache(const fs::path& relative) {
  std::vector<std::string> parts;
  for (const fs::path& part : relative) parts.push_back(part.string());
  if (parts.size() == 2 && parts[0] == "making")
    return DraftName::parse(parts[1]) || is_old_draft_name(parts[1]) ? Owned::kTree : Owned::kNo;
  if (parts.size() != 3 || !is_cache_shelf(parts[1]) || !parts[2].starts_with(parts[1]))
    return Owned::kNo;
  if (parts[0] == "results" && is_key(parts[2])) return Owned::kTree;
  const fs::path name = parts[2];
  return parts[0] == "failures" && is_key(name.stem().native()) &&
                 (name.extension() == ".json" || name.extension() == ".log")
             ? Owned::kFile
             : Owned::kNo;
}

Ownership cache_ownership() {
  return {[](const HeldDirectory& root) { return root.read(kCacheMarkerFile, 64) == kCacheLayout; },
          owned_in_cache};
}

bool is_cache(const fs::path& directory) {
  const HeldDirectory root(directory);
  if (!root) return false;
  if (const auto marker = root.read(kCacheMarkerFile, 64)) return true;
  return !root.names().empty() && has_only_our_names(root);
}

/// Throws Error(kInput) if it is not.
void require_cache(const HeldDirectory& root) {
  if (const auto marker = root.read(kCacheMarkerFile, 64)) {
    if (*marker != kCacheLayout)
      throw Error(ExitCode::kInput,
                  fmt::format("{}: a cache of another layout; this program reads layout {}",
                              root.path().string(), kCacheLayout.substr(0, 1)));
  } else if (!has_only_our_names(root)) {
    throw Error(ExitCode::kInput, fmt::format("{}: not empty and not a cache (it has no file '{}')",
                                              root.path().string(), kCacheMarkerFile));
  }
}

HeldDirectory open_cache(const fs::path& directory, ByteLocks::Opening opening) {
  HeldDirectory root(directory);
  if (!root && opening == ByteLocks::Opening::kMake) {
    make_directories(directory);
    root = HeldDirectory(directory);
  }
  if (!root)
    throw Error(ExitCode::kInput, fmt::format("{}: {}", directory.string(), root.why_not()));
  require_cache(root);
  for (const char* part : kParts) {
    // One that may only be read stays as it is.
    if (opening == ByteLocks::Opening::kMake) ::mkdirat(root.fd(), part, 0777);
    const HeldDirectory there = root.below(part);
    const auto links = there.links();
    if ((there && links.empty()) || there.is_missing()) continue;
    throw Error(ExitCode::kOutput,
                there ? fmt::format("{}: a symbolic link, which a cache has none of",
                                    (there.path() / links.front()).string())
                      : fmt::format("{}: {}", there.path().string(), there.why_not()));
  }
  return root;
}

}  // namespace lobelia
