// Two folders of pictures, paired by name.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace lobelia {

/// More files than this in one folder are refused: somebody gave the wrong one.
inline constexpr std::size_t kMaxFolderFiles = 1'000'000;

/// Paths relative to the folder ("lights/area.exr"), sorted by their bytes.
struct FolderPairs {
  std::vector<std::string> both;
  std::vector<std::string> missing;  ///< only in the second folder, which is the reference
  std::vector<std::string> extra;    ///< only in the first
  std::size_t passed_over = 0;       ///< files of either whose ending is not that of a picture
  /// Links of either that lead to a folder outside it, or to nothing; with the folder's own path before.
  std::vector<std::string> not_followed;
};

/// By endings, in any case: ".exr", ".png", ".jpg" and the like.
bool has_picture_ending(const std::filesystem::path& file);

/// Whether an absolute, canonical path is the folder or lies in it.
bool is_below(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Walks both and the folders inside them. A link to a folder is followed if it stays inside, but never into
/// a folder that it lies in. Throws Error(kInput) where one cannot be read or holds over `most_files`.
FolderPairs pair_by_name(const std::filesystem::path& a, const std::filesystem::path& b,
                         std::size_t most_files = kMaxFolderFiles);

}  // namespace lobelia
