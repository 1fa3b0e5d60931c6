// The journal of a replacement of files (core/replacement.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/sha256.hpp"

namespace lobelia {

struct ReplacementJournal {
  struct Entry {
    std::filesystem::path name;               ///< from the folder; is_inner_path()
    Sha256Digest bytes{};                     ///< of the new file
    std::optional<Sha256Digest> before = {};  ///< of the old one, if there was one
  };
  std::vector<Entry> entries;
  /// Directories that were not there, each before what is in it.
  std::vector<std::filesystem::path> made = {};
  /// The inode of the directory that holds the journal. A copy, such as one that somebody sends, is in another directory.
  std::uint64_t directory = 0;

  std::string text() const;
  /// Nothing if the text is damaged, or names anything outside of the folder.
  static std::optional<ReplacementJournal> read(std::string_view text);
};

/// The files of entry i, beside the journal.
std::string new_file_name(std::size_t i);
std::string old_file_name(std::size_t i);

/// Whether it leads to something in the folder, by names alone, and into no directory of ours.
bool is_inner_path(const std::filesystem::path& path);

}  // namespace lobelia
