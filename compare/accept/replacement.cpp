#include "compare/accept/replacement.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "base/system/byte_locks.hpp"
#include "base/system/error.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/removal.hpp"
#include "compare/accept/held_files.hpp"
#include "compare/accept/replacement_gathering.hpp"
#include "compare/accept/replacement_store.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

using Journal = ReplacementJournal;

std::vector<fs::path> places_of(const Journal& journal, const fs::path& folder) {
  std::vector<fs::path> places;
  for (const Journal::Entry& entry : journal.entries) places.push_back(folder / entry.name);
  return places;
}

/// The folder and our directory in it, which no other process of ours changes meanwhile.
class ReplacedFolder {
 public:
  explicit ReplacedFolder(const HeldDirectory& root)
      : root_(root.copy()),
        store_(made_store(root_)),
        locks_(opened_lock(root_, store_)),
        claim_(claimed(store_, locks_)) {}

  ReplacementOutcome finish() {
    discard(kNextStage);
    if (has(kBackStage)) return finish_back();
    if (!has(kNowStage)) return {};
    const Journal journal = read_journal(store_, kNowStage);
    InterruptedReplacement found = look_at(root_, store_.below(kNowStage), journal);
    // Who has changed a file since then may not want the others to be replaced.
    if (!found.is_sound || !put({journal, std::move(found.seen)}).empty()) {
      move_file(store_, kNowStage, store_, kBackStage);
      flush_names(store_);
      ReplacementOutcome done = finish_back();
      done.problems.insert(done.problems.begin(), found.problems.begin(), found.problems.end());
      return done;
    }
    keep_as_last();
    return {ReplacementOutcome::Way::kReplaced, places(journal), {}};
  }

  void replace(std::span<const Replacement> files) {
    finish();
    GatheredReplacement gathered;
    std::optional<EndDelay> delay;
    try {
      std::vector<fs::path> directories;
      for (const Replacement& file : files) directories.push_back(file.to.parent_path());
      gathered = Gathering(root_, make_next(root_, store_, directories)).gather(files);
      delay.emplace();
      throw_if_interrupted();
      move_file(store_, kNextStage, store_, kNowStage);
    } catch (...) {
      try {
        discard(kNextStage);
      } catch (const Error&) {  // the next replacement discards it
      }
      throw;
    }
    put_all_or_none(gathered);
    interrupts_come_too_late();
    try {
      keep_as_last();
    } catch (const Error& error) {
      throw Error(error.code(), "{}; all files are replaced", error.what());
    }
  }

  ReplacementOutcome undo() {
    // An undo that was interrupted, or a replacement that failed, has left this to be put back.
    if (ReplacementOutcome done = finish(); done.way == ReplacementOutcome::Way::kPutBack)
      return done;
    if (!has(kLastStage))
      throw Error(ExitCode::kInput, "{}: no acceptance to undo", root_.path().string());
    const Journal journal = read_journal(store_, kLastStage);
    require_undoable(journal);
    const EndDelay delay;
    throw_if_interrupted();
    move_file(store_, kLastStage, store_, kBackStage);
    try {
      flush_names(store_);
      put_back(journal, Check::kNone);
      drop_back();
    } catch (const Error& error) {
      throw Error(error.code(), "{}; the same command puts back the rest", error.what());
    }
    interrupts_come_too_late();
    return {ReplacementOutcome::Way::kPutBack, places(journal), {}};
  }

 private:
  /// How to tell whether somebody else has changed a file since it was put in its place.
  enum class Check : std::uint8_t {
    kNone,   ///< nobody has: that was looked at just now
    kHashes  ///< time has passed: read it
  };

  std::vector<fs::path> places(const Journal& journal) const {
    return places_of(journal, root_.path());
  }

  bool has(const char* stage) const {
    return bool(find_in(root_, fs::path(kReplacedName) / stage));
  }

  void discard(const char* stage) const {
    const fs::path relative = fs::path(kReplacedName) / stage;
    Removal removal(root_.path(), {has_our_mark, [&](const fs::path& one) {
                                     return one == relative ? Owned::kTree : Owned::kNo;
                                   }});
    // It opens the folder by its path.
    if (!removal.root().is_same_as(root_))
      throw Error(ExitCode::kOutput, "{}: cannot write: it was moved meanwhile",
                  root_.path().string());
    removal.remove(relative);
    if (!removal.kept().empty())
      throw Error(ExitCode::kOutput, "{}: cannot remove: {}", removal.kept().front().path.string(),
                  removal.kept().front().why);
  }

  /// In one step first: a "back" without its journal could not be finished.
  void drop_back() const {
    move_file(store_, kBackStage, store_, kNextStage);
    discard(kNextStage);
  }

  void keep_as_last() const {
    discard(kLastStage);
    move_file(store_, kNowStage, store_, kLastStage);
    flush_names(store_);
  }

  ReplacementOutcome finish_back() const {
    const Journal journal = read_journal(store_, kBackStage);
    ReplacementOutcome done = put_back(journal, Check::kHashes);
    drop_back();
    return done;
  }

  /// Puts each new file of "now" in its place. Returns the places that are not what they were, which stay.
  std::vector<fs::path> put(const GatheredReplacement& gathered) const {
    const HeldDirectory now = store_.below(kNowStage);
    const std::vector<Journal::Entry>& entries = gathered.journal.entries;
    std::vector<fs::path> left;
    for (std::size_t i = 0; i < entries.size(); ++i)
      if (!put(entries[i], i, now, gathered.seen[i]))
        left.push_back(root_.path() / entries[i].name);
    flush_places(gathered.journal);
    return left;
  }

  bool put(const Journal::Entry& entry, std::size_t i, const HeldDirectory& now,
           const SeenFiles& seen) const {
    const std::string fresh_name = new_file_name(i), kept_name = old_file_name(i);
    const std::optional<FileStatus> fresh = status_in(now, fresh_name);
    if (!fresh) return true;  // it has its place already
    if (!is_unchanged(seen.fresh, *fresh)) return false;
    const HeldDirectory there = make_in(root_, entry.name.parent_path());
    const std::string name = entry.name.filename().string();
    const std::optional<FileStatus> target = status_in(there, name);
    if (entry.before) {
      const std::optional<FileStatus> kept = status_in(now, kept_name);
      if (kept && (!is_unchanged(seen.old, *kept) || (target && !is_one_file(*target, *kept))))
        return false;
      if (!kept && !(target && keep_without_links(there, name, now, kept_name, seen.old)))
        return false;
    } else if (target) {
      return false;
    }
    move_file(now, fresh_name, there, name);
    return true;
  }

  /// False if it is not the old file, which then stays.
  static bool keep_without_links(const HeldDirectory& there, const std::string& name,
                                 const HeldDirectory& now, const std::string& kept_name,
                                 const FileStatus& old) {
    const auto is_old = [&](const HeldDirectory& where, const std::string& what) {
      const std::optional<FileStatus> status = status_in(where, what);
      return status && is_unchanged(old, *status);
    };
    if (!is_old(there, name)) return false;
    move_file(there, name, now, kept_name);
    if (is_old(now, kept_name)) return true;
    move_file(now, kept_name, there, name);  // it came between the look and the move
    return false;
  }

  void put_all_or_none(const GatheredReplacement& gathered) const {
    try {
      flush_names(root_);  // our directory may be new in it
      flush_names(store_);
      std::vector<std::string> problems;
      for (const fs::path& place : put(gathered))
        problems.push_back(fmt::format("{}: was changed meanwhile", place.string()));
      if (!problems.empty()) refuse(std::move(problems), "nothing was replaced; compare again");
    } catch (const Error& error) {
      put_back_after(error, gathered.journal);
      throw;
    }
  }

  void put_back_after(const Error& error, const Journal& journal) const {
    try {
      move_file(store_, kNowStage, store_, kBackStage);
      put_back(journal, Check::kNone);
      drop_back();
    } catch (const Error& second) {
      std::vector<std::string> lines = error.lines();
      lines.emplace_back(second.what());
      lines.push_back(
          fmt::format("{}: some files may be replaced and others not, until the next "
                      "comparison with them finishes this",
                      root_.path().string()));
      throw Error(ExitCode::kOutput, std::move(lines));
    }
  }

  /// Puts back the old files of "back", and takes away the new ones that had none.
  ReplacementOutcome put_back(const Journal& journal, Check check) const {
    const HeldDirectory back = store_.below(kBackStage);
    ReplacementOutcome done{ReplacementOutcome::Way::kPutBack, {}, {}};
    for (std::size_t i = 0; i < journal.entries.size(); ++i) {
      const fs::path place = root_.path() / journal.entries[i].name;
      if (const std::string why = put_back(journal.entries[i], i, back, check); why.empty())
        done.files.push_back(place);
      else
        done.problems.push_back(fmt::format("{}: {}", place.string(), why));
    }
    flush_places(journal);
    Removal removal(root_.path(), {has_our_mark, [&](const fs::path& one) {
                                     return std::ranges::count(journal.made, one) > 0
                                                ? Owned::kDirectory
                                                : Owned::kNo;
                                   }});
    if (removal.root().is_same_as(root_))
      for (auto made = journal.made.rbegin(); made != journal.made.rend(); ++made)
        removal.remove(*made);
    return done;
  }

  /// The state of a place that is to be restored.
  enum class Found : std::uint8_t { kNothing, kOld, kNew, kForeign };

  static Found found_in(const HeldDirectory& there, const Journal::Entry& entry, std::size_t i,
                        const HeldDirectory& back, Check check) {
    const std::string name = entry.name.filename().string();
    const std::optional<FileStatus> target = status_in(there, name),
                                    kept = status_in(back, old_file_name(i));
    const bool was_put = !status_in(back, new_file_name(i)),
               is_kept = target && kept && is_one_file(*target, *kept);
    if (!target) return Found::kNothing;
    if (check == Check::kNone) return is_kept || !was_put ? Found::kOld : Found::kNew;
    if (is_kept && S_ISLNK(target->st_mode)) return Found::kOld;
    if (entry.before && leads_to(there, name, *entry.before)) return Found::kOld;
    return was_put && status_if_holds(there, name, entry.bytes) ? Found::kNew : Found::kForeign;
  }

  /// Returns why the place is not what it was. Empty if it is.
  std::string put_back(const Journal::Entry& entry, std::size_t i, const HeldDirectory& back,
                       Check check) const {
    constexpr const char* kStays = "was changed since, and stays as it is";
    const std::string name = entry.name.filename().string(), kept_name = old_file_name(i);
    const HeldDirectory there = find_in(root_, entry.name.parent_path());
    if (!there) return entry.before ? kStays : "";
    switch (found_in(there, entry, i, back, check)) {
      case Found::kForeign:
        return kStays;
      case Found::kOld:
        return "";
      case Found::kNothing:
        if (!entry.before) return "";
        break;
      case Found::kNew:
        if (entry.before) break;
        move_file(there, name, back, new_file_name(i));
        return "";
    }
    const std::optional<FileStatus> kept = status_in(back, kept_name);
    const bool is_whole = kept && (check == Check::kNone || S_ISLNK(kept->st_mode) ||
                                   status_if_holds(back, kept_name, *entry.before));
    if (!is_whole) return "what was there before is damaged or gone";
    move_file(back, kept_name, there, name);
    return "";
  }

  void flush_places(const Journal& journal) const {
    std::set<fs::path> parents;
    for (const Journal::Entry& entry : journal.entries) parents.insert(entry.name.parent_path());
    for (const fs::path& made : journal.made) parents.insert(made.parent_path());
    for (const fs::path& parent : parents)
      if (const HeldDirectory there = find_in(root_, parent)) flush_names(there);
  }

  void require_undoable(const Journal& journal) const {
    const HeldDirectory last = store_.below(kLastStage);
    std::vector<std::string> problems;
    for (std::size_t i = 0; i < journal.entries.size(); ++i) {
      const Journal::Entry& entry = journal.entries[i];
      const fs::path place = root_.path() / entry.name;
      const HeldDirectory there = find_in(root_, entry.name.parent_path());
      const std::optional<FileStatus> target =
          there ? status_in(there, entry.name.filename().string()) : std::nullopt;
      if (!target || !S_ISREG(target->st_mode) || sha256_of_file(place) != entry.bytes)
        problems.push_back(fmt::format("{}: was changed after it was accepted", place.string()));
      if (!entry.before) continue;
      const std::optional<FileStatus> kept = status_in(last, old_file_name(i));
      if (!kept || (!S_ISLNK(kept->st_mode) &&
                    sha256_of_file(last.path() / old_file_name(i)) != *entry.before))
        problems.push_back(
            fmt::format("{}: what was there before is damaged or gone", place.string()));
    }
    if (!problems.empty()) refuse(std::move(problems), "nothing was put back");
  }

  HeldDirectory root_, store_;
  ByteLocks locks_;
  ByteLocks::Claim claim_;
};

}  // namespace

SteadyFile::SteadyFile(fs::path path) : path_(std::move(path)), began_(status_behind(path_)) {}

std::optional<Sha256Digest> SteadyFile::digest() const {
  if (!began_) return std::nullopt;
  const Sha256Digest digest = sha256_of_file(path_);
  const std::optional<FileStatus> now = status_behind(path_);
  const bool is_steady = now && is_unchanged(*began_, *now) &&
                         began_->st_ctim.tv_sec == now->st_ctim.tv_sec &&
                         began_->st_ctim.tv_nsec == now->st_ctim.tv_nsec;
  return is_steady ? std::optional(digest) : std::nullopt;
}

void replace_files(const HeldDirectory& folder, std::span<const Replacement> files) {
  ReplacedFolder(folder).replace(files);
}

bool has_replacements(const fs::path& folder, bool only_own) {
  const HeldDirectory store = trusted_store(folder);
  FileStatus status{};
  return store &&
         (!only_own || (::fstat(store.fd(), &status) == 0 && status.st_uid == ::geteuid()));
}

ReplacementOutcome finish_replacement(const fs::path& folder) {
  const HeldDirectory store = trusted_store(folder);
  // The usual case: neither a lock nor the right to write is needed.
  if (!store || (!status_in(store, kNowStage) && !status_in(store, kBackStage))) return {};
  try {
    return ReplacedFolder(HeldDirectory(folder)).finish();
  } catch (const Error& error) {
    if (error.code() == ExitCode::kInterrupted) throw;
    throw Error(error.code(), "{}: an acceptance was interrupted and cannot be finished: {}",
                folder.string(), error.what());
  }
}

std::optional<LastReplacement> last_replacement(const fs::path& folder) {
  const HeldDirectory store = trusted_store(folder);
  if (!store) return std::nullopt;
  // One that is under way is later than the last one that was finished.
  for (const char* stage : {kNowStage, kBackStage, kLastStage}) {
    const HeldDirectory held = store.below(stage);
    if (held.is_fault())
      throw Error(ExitCode::kOutput, "{}: cannot be read: {}", held.path().string(),
                  held.why_not());
    if (held) {
      std::error_code unknown;
      return LastReplacement{fs::last_write_time(held.path() / kJournalFile, unknown),
                             places_of(read_journal(store, stage), folder)};
    }
  }
  return std::nullopt;
}

ReplacementOutcome undo_replacement(const fs::path& folder) {
  if (!has_replacements(folder))
    throw Error(ExitCode::kInput, "{}: no acceptance to undo", folder.string());
  return ReplacedFolder(HeldDirectory(folder)).undo();
}

}  // namespace lobelia
