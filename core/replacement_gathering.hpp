// Prepares a replacement of files (core/replacement.hpp), and looks at one that was interrupted.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/held_files.hpp"
#include "core/replacement.hpp"
#include "core/replacement_journal.hpp"

namespace lobelia {

/// Both files of an entry when their bytes were known last. All zeros: there is none.
struct SeenFiles {
  FileStatus old{}, fresh{};
};

/// A replacement for which everything is in a stage, and nothing in its place.
struct GatheredReplacement {
  ReplacementJournal journal;
  std::vector<SeenFiles> seen;  ///< by entry
};

/// Fills the stage "next": the new files, the old ones where there are hard links, and the journal. Throws as
/// replace_files().
GatheredReplacement gather(const HeldDirectory& root, const HeldDirectory& next,
                           std::span<const Replacement> files);

/// The files of an interrupted process in the stage "now".
struct InterruptedReplacement {
  std::vector<SeenFiles> seen;  ///< by entry
  bool is_sound = true;         ///< all files are what the journal says, here and in their places
  /// One for each file here that is wrong: "PATH: is not what was accepted".
  std::vector<std::string> problems = {};
};

/// Reads all files. Throws Error(kOutput), and as sha256_of_file(), if one cannot be looked at.
InterruptedReplacement look_at(const HeldDirectory& root, const HeldDirectory& now,
                               const ReplacementJournal& journal);

/// Whether the entry `name`, perhaps a link, leads to these bytes.
bool leads_to(const HeldDirectory& directory, const std::string& name, const Sha256Digest& bytes);

[[noreturn]] void refuse(std::vector<std::string> problems, const char* conclusion);

}  // namespace lobelia
