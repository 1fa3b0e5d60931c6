// Two folders of pictures, paired by name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lobelia {

/// Paths relative to the folder ("lights/area.exr"), sorted by their bytes.
struct FolderPairs {
  std::vector<std::string> both;
  std::vector<std::string> missing;  ///< only in the second folder, which is the reference
  std::vector<std::string> extra;    ///< only in the first
  std::size_t passed_over = 0;       ///< files of either without a picture's ending
  /// Links of either to a folder outside it, or to nothing; their paths begin with the folder's.
  std::vector<std::string> not_followed;
};

/// Whether an absolute, canonical path is the folder or lies in it.
bool is_below(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Walks both and the folders inside them. Follows a link to a folder inside, but never to one that contains the link.
/// Throws Error(kInput) if a folder cannot be read or holds over `most_files`, probably the wrong folder.
FolderPairs pair_by_name(const std::filesystem::path& a, const std::filesystem::path& b,
                         std::size_t most_files = 1'000'000);

}  // namespace lobelia
