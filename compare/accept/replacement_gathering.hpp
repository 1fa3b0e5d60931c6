// Prepares a replacement of files (compare/accept/replacement.hpp), and looks at one that was interrupted.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/system/error.hpp"
#include "base/system/interrupt.hpp"
#include "compare/accept/held_files.hpp"
#include "compare/accept/replacement.hpp"
#include "compare/accept/replacement_store.hpp"

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

[[noreturn]] inline void refuse(std::vector<std::string> problems, const char* conclusion) {
  problems.emplace_back(conclusion);
  throw Error(ExitCode::kInput, std::move(problems));
}

/// Fills the stage "next": the new files, the old ones where there are hard links, and the journal. Throws as
/// replace_files().
class Gathering {
 public:
  Gathering(const HeldDirectory& root, const HeldDirectory& next) : root_(root), next_(next) {}

  GatheredReplacement gather(std::span<const Replacement> files) {
    std::vector<std::string> problems;
    for (const Replacement& file : files) {
      throw_if_interrupted();
      if (std::string problem = gather(file); !problem.empty())
        problems.push_back(std::move(problem));
    }
    if (!problems.empty()) refuse(std::move(problems), "nothing was replaced; compare again");
    done_.journal.directory = inode_of(next_);
    write_in(next_, kJournalFile, done_.journal.text());
    flush_names(next_);
    return std::move(done_);
  }

 private:
  /// Returns what is not as it has to be.
  std::string gather(const Replacement& file) {
    const std::filesystem::path place = root_.path() / file.to;
    if (!is_inner_path(file.to))
      return fmt::format("{}: does not lie in {}", place.string(), root_.path().string());
    const std::size_t i = done_.journal.entries.size();
    done_.journal.entries.push_back({file.to, file.bytes, file.before});
    SeenFiles& seen = done_.seen.emplace_back();
    const std::string name = file.to.filename().string();
    const HeldDirectory there = find_in(root_, file.to.parent_path());
    if (!there) note_missing(file.to.parent_path());
    const std::optional<FileStatus> old = there ? status_in(there, name) : std::nullopt;
    seen.old = old.value_or(FileStatus{});
    if (old && !S_ISREG(old->st_mode) && !S_ISLNK(old->st_mode))
      return fmt::format("{}: not a regular file", place.string());
    if (!old && file.before) return fmt::format("{}: is gone", place.string());
    if (old && !file.before)
      return fmt::format("{}: was made meanwhile, and was not compared", place.string());
    if (old && sha256_of_file(place) != *file.before) return changed(place);
    copy_in(next_, new_file_name(i), file.from, old ? status_behind(place) : std::nullopt);
    const auto fresh = status_if_holds(next_, new_file_name(i), file.bytes);
    if (!fresh) return changed(file.from);
    seen.fresh = *fresh;
    // Without hard links the old file is moved instead, when its turn comes.
    if (!old || !link_file(there, name, next_, old_file_name(i))) return "";
    const std::optional<FileStatus> kept = status_in(next_, old_file_name(i));
    return kept && is_unchanged(*kept, *old) ? "" : changed(place);
  }

  static std::string changed(const std::filesystem::path& path) {
    return fmt::format("{}: was changed after it was compared", path.string());
  }

  void note_missing(const std::filesystem::path& directory) {
    std::vector<std::filesystem::path>& made = done_.journal.made;
    std::filesystem::path part;
    for (const std::filesystem::path& name : directory) {
      part /= name;
      if (!find_in(root_, part) && std::ranges::count(made, part) == 0) made.push_back(part);
    }
  }

  const HeldDirectory& root_;
  const HeldDirectory& next_;
  GatheredReplacement done_;
};

/// The files of an interrupted process in the stage "now".
struct InterruptedReplacement {
  std::vector<SeenFiles> seen;  ///< by entry
  bool is_sound = true;         ///< all files are what the journal says, here and in their places
  /// One for each file here that is wrong: "PATH: is not what was accepted".
  std::vector<std::string> problems = {};
};

/// Whether the entry `name`, perhaps a link, leads to these bytes.
inline bool leads_to(const HeldDirectory& directory, const std::string& name,
                     const Sha256Digest& bytes) {
  const std::filesystem::path path = directory.path() / name;
  const std::optional<FileStatus> behind = status_behind(path);
  return behind && S_ISREG(behind->st_mode) && sha256_of_file(path) == bytes;
}

/// The old file of an entry: kept beside the journal, or not yet moved there, or under both names. Nothing if it is not what
/// the journal says, or somebody has put another one in its place.
inline std::optional<FileStatus> old_file(const HeldDirectory& there, const std::string& name,
                                          const HeldDirectory& now, const std::string& kept_name,
                                          const Sha256Digest& bytes) {
  const std::optional<FileStatus> target = there ? status_in(there, name) : std::nullopt;
  const std::optional<FileStatus> kept = status_in(now, kept_name);
  if (!kept) return target && leads_to(there, name, bytes) ? target : std::nullopt;
  if (target && !is_one_file(*target, *kept)) return std::nullopt;
  // A link leads elsewhere from here.
  if (S_ISLNK(kept->st_mode)) return kept;
  return status_if_holds(now, kept_name, bytes);
}

/// Reads all files. Throws Error(kOutput), and as sha256_of_file(), if one cannot be looked at.
inline InterruptedReplacement look_at(const HeldDirectory& root, const HeldDirectory& now,
                                      const ReplacementJournal& journal) {
  InterruptedReplacement found;
  for (std::size_t i = 0; i < journal.entries.size(); ++i) {
    const ReplacementJournal::Entry& entry = journal.entries[i];
    SeenFiles& seen = found.seen.emplace_back();
    const HeldDirectory there = find_in(root, entry.name.parent_path());
    const std::string name = entry.name.filename().string();
    if (!status_in(now, new_file_name(i))) {  // it has its place already
      found.is_sound = found.is_sound && there && status_if_holds(there, name, entry.bytes);
      continue;
    }
    if (const auto fresh = status_if_holds(now, new_file_name(i), entry.bytes))
      seen.fresh = *fresh;
    else
      found.problems.push_back(
          fmt::format("{}: is not what was accepted", (now.path() / new_file_name(i)).string()));
    if (entry.before) {
      const auto old = old_file(there, name, now, old_file_name(i), *entry.before);
      seen.old = old.value_or(FileStatus{});
      found.is_sound = found.is_sound && old;
    } else {
      found.is_sound = found.is_sound && !(there && status_in(there, name));
    }
  }
  found.is_sound = found.is_sound && found.problems.empty();
  return found;
}

}  // namespace lobelia
