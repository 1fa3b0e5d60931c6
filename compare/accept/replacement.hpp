// Replaces files of a folder by others: all of them or none, whatever ends the process, and with a way back.
//
// A directory in the folder holds what this needs. Everything is gathered in its "next", where nothing is decided. Once that
// is on the disk it becomes "now": each old file is kept there, and each new one gets its place. Then "now" becomes "last",
// until the next replacement. What is taken back becomes "back" first. So a process that finds "now" goes on from there, and
// one that finds "back" puts back the rest.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/system/removal.hpp"
#include "base/system/sha256.hpp"

namespace lobelia {

/// The directory in the folder.
inline constexpr char kReplacedName[] = ".lobelia-accepted";

/// The hash of a file that others read meanwhile, if it stays as it is.
class SteadyFile {
 public:
  /// Looks at the file. Before the others read it.
  explicit SteadyFile(std::filesystem::path path);
  /// After the others have read it. Nothing if the file changed since. Throws as sha256_of_file().
  std::optional<Sha256Digest> digest() const;

 private:
  std::filesystem::path path_;
  std::optional<struct stat> began_;  ///< nothing if there is no such file
};

struct Replacement {
  std::filesystem::path from;  ///< the file whose bytes are copied
  Sha256Digest bytes{};        ///< what it has to hold
  /// Relative to the folder, without "..". No link on the way is followed, and one in its place is itself replaced.
  std::filesystem::path to;
  /// The content that `to` must have; empty if there must be no such file.
  std::optional<Sha256Digest> before;
};

/// Replaces all of them or none. A file keeps the mode of the one before, and its group if this user may set it. Finishes
/// first what another process left. Waits while one is at work.
///
/// Throws Error(kInput) with a line for each file that does not hold what it has to; Error(kOutput) if one cannot be
/// written; Error(kInterrupted). Each file is then what it was, unless the message says otherwise.
void replace_files(const HeldDirectory& folder, std::span<const Replacement> files);

/// Whether files of this very folder were replaced. In a folder where everybody may make entries, such as /tmp, a directory
/// of somebody else's does not count; with `only_own` nowhere.
bool has_replacements(const std::filesystem::path& folder, bool only_own = false);

/// The outcome of a replacement.
struct ReplacementOutcome {
  enum class Way : std::uint8_t { kNothing, kReplaced, kPutBack };
  Way way = Way::kNothing;
  std::vector<std::filesystem::path> files;
  /// "PATH: WHY" of each that is not among `files`, because somebody has changed it since, or what was kept for it; and why
  /// the others were put back.
  std::vector<std::string> problems;
};

/// Finishes what an interrupted process left under way, if has_replacements(): replaces the rest if every file is what it
/// left, else puts back all. Throws Error(kOutput) if it cannot, Error(kInput) if its journal is damaged,
/// Error(kInterrupted) while another process is at work.
ReplacementOutcome finish_replacement(const std::filesystem::path& folder);

struct LastReplacement {
  std::filesystem::file_time_type began;
  std::vector<std::filesystem::path> files;
};

/// The one that undo_replacement() undoes; nothing if there is none. Throws Error(kInput) if its journal is damaged,
/// Error(kOutput) if it may not be read.
std::optional<LastReplacement> last_replacement(const std::filesystem::path& folder);

/// Puts back what was there before the last replacement, all or none. A file that was not there before goes, and so do
/// directories that were made for it, if they are empty. Throws Error(kInput) if there is nothing to undo, or with a line
/// for each file that was changed since; otherwise as replace_files().
ReplacementOutcome undo_replacement(const std::filesystem::path& folder);

}  // namespace lobelia
