// The directory that a replacement of files needs in their folder (compare/accept/replacement.hpp), and the journal in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/byte_locks.hpp"
#include "base/system/removal.hpp"
#include "base/system/sha256.hpp"

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

/// Directories in it, each with a journal and the files of its entries.
inline constexpr char kNextStage[] = "next", kNowStage[] = "now", kLastStage[] = "last",
                      kBackStage[] = "back";
inline constexpr char kJournalFile[] = "journal";

/// The directory of a folder. Holds none if there is none that counts, as of somebody else where everybody may make entries.
HeldDirectory trusted_store(const std::filesystem::path& folder);
/// The same, and makes it. Throws Error(kOutput) if it is somebody else's, or has not our mark: nothing in it is ours then.
HeldDirectory made_store(const HeldDirectory& root);
/// Whether the directory of the folder `root` has our mark.
bool has_our_mark(const HeldDirectory& root);

/// The lock that keeps out other processes. Throws Error(kOutput) if it cannot be opened.
ByteLocks opened_lock(const HeldDirectory& root, const HeldDirectory& store);
/// Waits while another process has it. Throws Error(kOutput) if it cannot be had; Error(kInterrupted).
ByteLocks::Claim claimed(const HeldDirectory& store, const ByteLocks& locks);

/// Makes the stage "next" for files of these directories below `root`. Only who may read all of them may read it.
HeldDirectory make_next(const HeldDirectory& root, const HeldDirectory& store,
                        std::span<const std::filesystem::path> directories);

/// Throws Error(kInput) if it is missing, damaged or a copy from another place.
ReplacementJournal read_journal(const HeldDirectory& store, const char* stage);
/// The inode of an open directory; 0 if that cannot be told.
std::uint64_t inode_of(const HeldDirectory& held);

}  // namespace lobelia
