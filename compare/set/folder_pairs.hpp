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
};

/// By endings, in any case: ".exr", ".png", ".jpg" and the like.
bool has_picture_ending(const std::filesystem::path& file);

/// Walks both, and the folders inside them, but follows no link to a folder. Throws Error(kInput) where one
/// cannot be read or holds over kMaxFolderFiles.
FolderPairs pair_by_name(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace lobelia
