#include "core/replacement.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "core/byte_locks.hpp"
#include "core/error.hpp"
#include "core/held_files.hpp"
#include "core/interrupt.hpp"
#include "core/removal.hpp"
#include "core/replacement_journal.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

using Journal = ReplacementJournal;

constexpr char kNext[] = "next", kNow[] = "now", kLast[] = "last", kBack[] = "back";
constexpr char kJournalFile[] = "journal";

/// Marks the directory as ours, tells people what it is, and keeps it out of their repository.
constexpr char kMark[] = ".gitignore";
constexpr char kMarkText[] =
    "# What the last 'lobelia compare --accept' replaced: 'lobelia accept --undo' puts it back.\n"
    "# Whoever does not want that may remove this folder, unless 'now' or 'back' is in it.\n"
    "*\n";

/// Where everybody may make entries, only our own directory counts. Elsewhere, whoever can make one can also replace the
/// files themselves.
bool is_trusted(const HeldDirectory& root, const HeldDirectory& store) {
  FileStatus folder{}, ours{};
  return ::fstat(root.fd(), &folder) == 0 && ::fstat(store.fd(), &ours) == 0 &&
         ((folder.st_mode & S_ISVTX) == 0 || ours.st_uid == ::geteuid());
}

/// Our directory of the folder. Holds none if there is none that counts.
HeldDirectory trusted_store(const fs::path& folder) {
  const HeldDirectory root(folder);
  HeldDirectory store = root.below(kReplacedName);
  if (store && !is_trusted(root, store)) return {};
  return store;
}

/// Lets those change what we made who may change the folder.
void share_as(const HeldDirectory& root, const HeldDirectory& made) {
  FileStatus folder{}, ours{};
  if (::fstat(root.fd(), &folder) == 0 && ::fstat(made.fd(), &ours) == 0 &&
      ours.st_uid == ::geteuid())
    ::fchmod(made.fd(), folder.st_mode & 02777u);
}

HeldDirectory made_store(const HeldDirectory& root) {
  HeldDirectory store = root.make_below(kReplacedName);
  if (!is_trusted(root, store))
    throw Error(ExitCode::kOutput,
                fmt::format("{}: cannot write: it belongs to another user", store.path().string()));
  share_as(root, store);
  if (store.read(kMark, sizeof kMarkText) != kMarkText) write_in(store, kMark, kMarkText);
  return store;
}

bool has_our_mark(const HeldDirectory& root) {
  return root.below(kReplacedName).read(kMark, sizeof kMarkText).has_value();
}

std::optional<ByteLocks::Claim> claimed(const ByteLocks& locks) {
  constexpr std::chrono::milliseconds kBetweenTries{20};
  for (;;) {
    if (auto claim = locks.try_claim(0)) return claim;
    throw_if_interrupted();
    std::this_thread::sleep_for(kBetweenTries);
  }
}

std::uint64_t inode_of(const HeldDirectory& held) {
  FileStatus status{};
  return ::fstat(held.fd(), &status) == 0 ? status.st_ino : 0;
}

Journal read_journal(const HeldDirectory& store, const char* stage) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 28;
  const HeldDirectory held = store.below(stage);
  const std::optional<std::string> text = held.read(kJournalFile, kMostBytes);
  std::optional<Journal> journal = text ? Journal::read(*text) : std::nullopt;
  if (!journal)
    throw Error(ExitCode::kInput,
                fmt::format("{}: is missing or damaged; once the files in {} are what they should "
                            "be, remove {}",
                            (held.path() / kJournalFile).string(),
                            store.path().parent_path().string(), store.path().string()));
  if (journal->directory != inode_of(held))
    throw Error(ExitCode::kInput,
                fmt::format("{}: is a copy from another place and is not acted upon; remove {}",
                            (held.path() / kJournalFile).string(), store.path().string()));
  return std::move(*journal);
}

std::vector<fs::path> places_of(const Journal& journal, const fs::path& folder) {
  std::vector<fs::path> places;
  for (const Journal::Entry& entry : journal.entries) places.push_back(folder / entry.name);
  return places;
}

[[noreturn]] void refuse(std::vector<std::string> problems, const char* conclusion) {
  problems.emplace_back(conclusion);
  throw Error(ExitCode::kInput, std::move(problems));
}

/// Makes "next": the new files, the old ones where there are hard links, and the journal.
class Gathering {
 public:
  Gathering(const HeldDirectory& root, const HeldDirectory& next) : root_(root), next_(next) {}

  void gather(std::span<const Replacement> files) {
    std::vector<std::string> problems;
    for (const Replacement& file : files) {
      throw_if_interrupted();
      if (std::string problem = gather(file); !problem.empty())
        problems.push_back(std::move(problem));
    }
    if (!problems.empty()) refuse(std::move(problems), "nothing was replaced; compare again");
    journal_.directory = inode_of(next_);
    write_in(next_, kJournalFile, journal_.text());
    flush_names(next_);
  }

  const Journal& journal() const { return journal_; }
  /// The status of each old file, by entry.
  const std::vector<FileStatus>& seen() const { return seen_; }

 private:
  /// Returns what is not as it has to be.
  std::string gather(const Replacement& file) {
    const fs::path place = root_.path() / file.to;
    if (!is_inner_path(file.to))
      return fmt::format("{}: does not lie in {}", place.string(), root_.path().string());
    const std::size_t i = journal_.entries.size();
    journal_.entries.push_back({file.to, file.bytes, file.before});
    const std::string name = file.to.filename().string();
    const HeldDirectory there = find_in(root_, file.to.parent_path());
    if (!there) note_missing(file.to.parent_path());
    const std::optional<FileStatus> old = there ? status_in(there, name) : std::nullopt;
    seen_.push_back(old.value_or(FileStatus{}));
    if (old && !S_ISREG(old->st_mode) && !S_ISLNK(old->st_mode))
      return fmt::format("{}: not a regular file", place.string());
    if (!old && file.before) return fmt::format("{}: is gone", place.string());
    if (old && !file.before)
      return fmt::format("{}: was made meanwhile, and was not compared", place.string());
    if (old && sha256_of_file(place) != *file.before) return changed(place);
    copy_in(next_, new_file_name(i), file.from, old ? status_behind(place) : std::nullopt);
    if (sha256_of_file(next_.path() / new_file_name(i)) != file.bytes) return changed(file.from);
    // Without hard links the old file is moved instead, when its turn comes.
    if (!old || !link_file(there, name, next_, old_file_name(i))) return "";
    const std::optional<FileStatus> kept = status_in(next_, old_file_name(i));
    return kept && is_unchanged(*kept, *old) ? "" : changed(place);
  }

  static std::string changed(const fs::path& path) {
    return fmt::format("{}: was changed after it was compared", path.string());
  }

  void note_missing(const fs::path& directory) {
    fs::path part;
    for (const fs::path& name : directory) {
      part /= name;
      if (!find_in(root_, part) && std::ranges::count(journal_.made, part) == 0)
        journal_.made.push_back(part);
    }
  }

  const HeldDirectory& root_;
  const HeldDirectory& next_;
  Journal journal_;
  std::vector<FileStatus> seen_;
};

/// The folder and our directory in it, which no other process of ours changes meanwhile.
class ReplacedFolder {
 public:
  explicit ReplacedFolder(const fs::path& path)
      : root_(path), store_(made_store(root_)), locks_(store_, "lock"), claim_(claimed(locks_)) {}

  ReplacementOutcome finish() {
    discard(kNext);
    if (has(kBack)) {
      const Journal journal = read_journal(store_, kBack);
      ReplacementOutcome done{ReplacementOutcome::Way::kPutBack, places(journal),
                              put_back(journal, Check::kHashes)};
      drop_back();
      return done;
    }
    if (!has(kNow)) return {};
    const Journal journal = read_journal(store_, kNow);
    ReplacementOutcome done{ReplacementOutcome::Way::kReplaced, places(journal),
                            put(journal, nullptr)};
    keep_as_last();
    return done;
  }

  void replace(std::span<const Replacement> files) {
    finish();
    const HeldDirectory next = store_.make_below(kNext);
    share_as(root_, next);
    Gathering gathering(root_, next);
    std::optional<EndDelay> delay;
    try {
      gathering.gather(files);
      delay.emplace();
      throw_if_interrupted();
      move_file(store_, kNext, store_, kNow);
    } catch (...) {
      try {
        discard(kNext);
      } catch (const Error&) {  // the next replacement discards it
      }
      throw;
    }
    put_all_or_none(gathering);
    interrupts_come_too_late();
    try {
      keep_as_last();
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("{}; all files are replaced", error.what()));
    }
  }

  ReplacementOutcome undo() {
    // An undo that was interrupted, or a replacement that failed, has left this to be put back.
    if (ReplacementOutcome done = finish(); done.way == ReplacementOutcome::Way::kPutBack)
      return done;
    if (!has(kLast))
      throw Error(ExitCode::kInput,
                  fmt::format("{}: no acceptance to undo", root_.path().string()));
    const Journal journal = read_journal(store_, kLast);
    require_undoable(journal);
    const EndDelay delay;
    throw_if_interrupted();
    move_file(store_, kLast, store_, kBack);
    try {
      flush_names(store_);
      put_back(journal, Check::kNone);
      drop_back();
    } catch (const Error& error) {
      throw Error(error.code(),
                  fmt::format("{}; the same command puts back the rest", error.what()));
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
    removal.remove(relative);
    if (!removal.kept().empty())
      throw Error(ExitCode::kOutput,
                  fmt::format("{}: cannot remove: {}", removal.kept().front().path.string(),
                              removal.kept().front().why));
  }

  /// In one step first: a "back" without its journal could not be finished.
  void drop_back() const {
    move_file(store_, kBack, store_, kNext);
    discard(kNext);
  }

  void keep_as_last() const {
    discard(kLast);
    move_file(store_, kNow, store_, kLast);
    flush_names(store_);
  }

  /// Puts each new file of "now" in its place. Returns the places that are not what they were, which stay.
  /// `seen`: what the old files were a moment ago; without it they are read.
  std::vector<fs::path> put(const Journal& journal, const std::vector<FileStatus>* seen) const {
    const HeldDirectory now = store_.below(kNow);
    std::vector<fs::path> left;
    for (std::size_t i = 0; i < journal.entries.size(); ++i)
      if (!put(journal.entries[i], i, now, seen ? &(*seen)[i] : nullptr))
        left.push_back(root_.path() / journal.entries[i].name);
    flush_places(journal);
    return left;
  }

  bool put(const Journal::Entry& entry, std::size_t i, const HeldDirectory& now,
           const FileStatus* seen) const {
    if (!status_in(now, new_file_name(i))) return true;  // it has its place already
    const HeldDirectory there = make_in(root_, entry.name.parent_path());
    const std::string name = entry.name.filename().string();
    std::optional<FileStatus> target = status_in(there, name);
    if (entry.before) {
      std::optional<FileStatus> kept = status_in(now, old_file_name(i));
      if (!kept && target) {  // there are no hard links
        move_file(there, name, now, old_file_name(i));
        kept = std::exchange(target, std::nullopt);
      }
      const auto is_old = [&] {
        if (seen) return is_unchanged(*seen, *kept);
        return S_ISLNK(kept->st_mode) ||
               sha256_of_file(now.path() / old_file_name(i)) == *entry.before;
      };
      if (!kept || !is_old() || (target && !is_one_file(*target, *kept))) {
        if (kept && !target) move_file(now, old_file_name(i), there, name);
        return false;
      }
    } else if (target) {
      return false;
    }
    move_file(now, new_file_name(i), there, name);
    return true;
  }

  void put_all_or_none(const Gathering& gathering) const {
    try {
      flush_names(root_);  // our directory may be new in it
      flush_names(store_);
      std::vector<std::string> problems;
      for (const fs::path& place : put(gathering.journal(), &gathering.seen()))
        problems.push_back(fmt::format("{}: was changed meanwhile", place.string()));
      if (!problems.empty()) refuse(std::move(problems), "nothing was replaced; compare again");
    } catch (const Error& error) {
      put_back_after(error, gathering.journal());
      throw;
    }
  }

  void put_back_after(const Error& error, const Journal& journal) const {
    try {
      move_file(store_, kNow, store_, kBack);
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

  /// Puts back the old files of "back", and takes away the new ones that had none. Returns the places that somebody else
  /// has changed, which stay.
  std::vector<fs::path> put_back(const Journal& journal, Check check) const {
    const HeldDirectory back = store_.below(kBack);
    std::vector<fs::path> left;
    for (std::size_t i = 0; i < journal.entries.size(); ++i)
      if (!put_back(journal.entries[i], i, back, check))
        left.push_back(root_.path() / journal.entries[i].name);
    flush_places(journal);
    Removal removal(root_.path(), {has_our_mark, [&](const fs::path& one) {
                                     return std::ranges::count(journal.made, one) > 0
                                                ? Owned::kDirectory
                                                : Owned::kNo;
                                   }});
    for (auto made = journal.made.rbegin(); made != journal.made.rend(); ++made)
      removal.remove(*made);
    return left;
  }

  bool put_back(const Journal::Entry& entry, std::size_t i, const HeldDirectory& back,
                Check check) const {
    const HeldDirectory there = find_in(root_, entry.name.parent_path());
    if (!there) return true;
    const std::string name = entry.name.filename().string();
    const std::optional<FileStatus> target = status_in(there, name);
    if (target && status_in(back, new_file_name(i))) return true;  // nothing was put there
    const bool is_ours =
        !target || check == Check::kNone ||
        (S_ISREG(target->st_mode) && sha256_of_file(root_.path() / entry.name) == entry.bytes);
    if (!entry.before) {
      if (target && is_ours) move_file(there, name, back, new_file_name(i));
      return is_ours;
    }
    const std::optional<FileStatus> kept = status_in(back, old_file_name(i));
    if (!kept || (target && is_one_file(*target, *kept))) return true;  // it is back already
    if (is_ours) move_file(back, old_file_name(i), there, name);
    return is_ours;
  }

  void flush_places(const Journal& journal) const {
    std::set<fs::path> parents;
    for (const Journal::Entry& entry : journal.entries) parents.insert(entry.name.parent_path());
    for (const fs::path& made : journal.made) parents.insert(made.parent_path());
    for (const fs::path& parent : parents)
      if (const HeldDirectory there = find_in(root_, parent)) flush_names(there);
  }

  void require_undoable(const Journal& journal) const {
    const HeldDirectory last = store_.below(kLast);
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
  std::optional<ByteLocks::Claim> claim_;
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

void replace_files(const fs::path& folder, std::span<const Replacement> files) {
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
  if (!store || (!status_in(store, kNow) && !status_in(store, kBack))) return {};
  try {
    return ReplacedFolder(folder).finish();
  } catch (const Error& error) {
    if (error.code() == ExitCode::kInterrupted) throw;
    throw Error(error.code(),
                fmt::format("{}: an acceptance was interrupted and cannot be finished: {}",
                            folder.string(), error.what()));
  }
}

std::optional<LastReplacement> last_replacement(const fs::path& folder) {
  const HeldDirectory store = trusted_store(folder);
  // One that is under way is later than the last one that was finished.
  for (const char* stage : {kNow, kBack, kLast})
    if (const HeldDirectory held = store.below(stage)) {
      std::error_code unknown;
      return LastReplacement{fs::last_write_time(held.path() / kJournalFile, unknown),
                             places_of(read_journal(store, stage), folder)};
    }
  return std::nullopt;
}

ReplacementOutcome undo_replacement(const fs::path& folder) {
  if (!has_replacements(folder))
    throw Error(ExitCode::kInput, fmt::format("{}: no acceptance to undo", folder.string()));
  return ReplacedFolder(folder).undo();
}

}  // namespace lobelia
