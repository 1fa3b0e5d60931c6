#include "compare/accept/replacement_store.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "base/system/error.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/no_resources.hpp"
#include "base/words/text.hpp"
#include "compare/accept/held_files.hpp"
#include "compare/accept/replacement.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

constexpr char kLockFile[] = "lock";

/// Marks the directory as ours, tells people what it is, and keeps it out of their repository.
constexpr char kMark[] = ".gitignore";
constexpr std::string_view kMarkText =
    "# What the last 'lobelia compare --accept' replaced: 'lobelia accept --undo' puts it back.\n"
    "# Whoever does not want that may remove this folder, unless 'now' or 'back' is in it.\n"
    "*\n";
/// Somebody may have added lines to it.
constexpr std::uint64_t kMostMarkBytes = 1 << 16;

/// Where everybody may make entries, only our own directory counts. Elsewhere, whoever can make one can also replace the
/// files themselves.
bool is_trusted(const HeldDirectory& root, const HeldDirectory& store) {
  FileStatus folder{}, ours{};
  return ::fstat(root.fd(), &folder) == 0 && ::fstat(store.fd(), &ours) == 0 &&
         ((folder.st_mode & S_ISVTX) == 0 || ours.st_uid == ::geteuid());
}

bool is_marked(const HeldDirectory& store) {
  const auto text = store.read(kMark, kMostMarkBytes);
  return text && text->starts_with(kMarkText.substr(0, kMarkText.find('\n')));
}

/// Whether it is empty, but for a mark that a process was about to write when it ended.
bool is_new(const HeldDirectory& store) {
  for (const std::string& name : store.names())
    if (name != kMark) return false;
  return !status_in(store, kMark) ||
         kMarkText.starts_with(store.read(kMark, kMostMarkBytes).value_or("?"));
}

/// The bits of a directory that a directory of the group `group` may have beside it, so that it shows nobody more.
mode_t bits_for(const FileStatus& directory, gid_t group) {
  mode_t of_group = directory.st_mode >> 3 & 07u, of_others = directory.st_mode & 07u;
  // Its members are others there, and its own group is among the others here.
  if (directory.st_gid != group) of_group = of_others = of_group & of_others;
  // There nobody may remove the files of others, but here everybody could.
  if ((directory.st_mode & S_ISVTX) != 0) of_group &= 05u, of_others &= 05u;
  // Whoever cannot both list and search it does not know all names, which are plain in ours.
  for (mode_t* const bits : {&of_group, &of_others})
    if ((*bits & 05u) != 05u) *bits = 0;
  return of_group << 3 | of_others;
}

/// Lets those read and change what we made who may do that with the folder and with all of these directories in it.
void share_as(const HeldDirectory& root, std::span<const fs::path> directories,
              const HeldDirectory& made) {
  FileStatus status{};
  if (::fstat(root.fd(), &status) != 0) cannot_write(root.path(), errno);
  // Without the right to do so, the group stays another one, and gets less.
  [[maybe_unused]] const int given = ::fchown(made.fd(), uid_t(-1), status.st_gid);
  FileStatus ours{};
  if (::fstat(made.fd(), &ours) != 0) cannot_write(made.path(), errno);
  mode_t shared = bits_for(status, ours.st_gid);
  const mode_t more = status.st_mode & S_ISGID;
  std::set<fs::path> seen;
  for (const fs::path& directory : directories) {
    if (!seen.insert(directory).second) continue;
    HeldDirectory held = root.copy();
    for (const fs::path& name : directory) {
      held = held.below(name.string());
      if (!held) break;  // it is made later
      if (::fstat(held.fd(), &status) != 0) cannot_write(held.path(), errno);
      shared &= bits_for(status, ours.st_gid);
    }
  }
  if (::fchmod(made.fd(), more | 0700u | shared) != 0) cannot_write(made.path(), errno);
}

/// Only who made the lock can give it its mode, so that others of a group can open it, too.
void make_lock(const HeldDirectory& root, const HeldDirectory& store) {
  const Descriptor made(
      ::openat(store.fd(), kLockFile, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600));
  FileStatus folder{};
  if (!made || ::fstat(root.fd(), &folder) != 0) return;  // opened_lock() says what is wrong
  FileStatus ours{};
  [[maybe_unused]] const int given = ::fchown(made.get(), uid_t(-1), folder.st_gid);
  if (::fstat(made.get(), &ours) == 0)
    ::fchmod(made.get(), 0600u | (bits_for(folder, ours.st_gid) & 066u));
}

/// An entry is words and, at its end, a name. A NUL ends it, which no name has.
constexpr std::string_view kMadeWord = "made", kInWord = "in", kNoFileWord = "-";
/// The last entry, which says that none is lost.
constexpr std::string_view kEndWord = "end";

/// The text up to the first blank, which is taken off `text`. Nothing if there is no blank.
std::optional<std::string_view> take_word(std::string_view& text) {
  const std::size_t blank = text.find(' ');
  if (blank == text.npos) return std::nullopt;
  const std::string_view word = text.substr(0, blank);
  text.remove_prefix(blank + 1);
  return word;
}

/// False if it is damaged.
bool read_entry(std::string_view text, ReplacementJournal& journal) {
  const std::optional<std::string_view> first = take_word(text);
  if (first == kMadeWord) {
    journal.made.emplace_back(text);
    return is_inner_path(journal.made.back());
  }
  if (first == kInWord) {
    long long inode = 0;
    const bool is_number = parse_integer(text, inode);
    journal.directory = std::uint64_t(inode);
    return is_number;
  }
  ReplacementJournal::Entry entry;
  const std::optional<std::string_view> before = take_word(text);
  if (!first || !before || !from_hex(*first, entry.bytes)) return false;
  if (*before != kNoFileWord && !from_hex(*before, entry.before.emplace())) return false;
  entry.name = text;
  const bool is_inside = is_inner_path(entry.name);
  journal.entries.push_back(std::move(entry));
  return is_inside;
}

}  // namespace

HeldDirectory trusted_store(const fs::path& folder) {
  const HeldDirectory root(folder);
  HeldDirectory store = root.below(kReplacedName);
  if (store && !is_trusted(root, store)) return {};
  return store;
}

HeldDirectory made_store(const HeldDirectory& root) {
  const bool was_missing = root.below(kReplacedName).is_missing();
  HeldDirectory store = root.make_below(kReplacedName);
  if (!is_trusted(root, store))
    throw Error(ExitCode::kOutput, "{}: cannot write: it belongs to another user",
                store.path().string());
  if (was_missing) share_as(root, {}, store);
  if (is_marked(store)) return store;
  // Another process may have written it meanwhile.
  if (!is_new(store) && !is_marked(store))
    throw Error(ExitCode::kOutput,
                "{}: cannot write: its {} is not that of lobelia compare --accept, so "
                "what is in it may be somebody else's; move it away",
                store.path().string(), kMark);
  write_in(store, kMark, kMarkText);
  return store;
}

bool has_our_mark(const HeldDirectory& root) { return is_marked(root.below(kReplacedName)); }

ByteLocks opened_lock(const HeldDirectory& root, const HeldDirectory& store) {
  make_lock(root, store);
  ByteLocks locks(store, kLockFile);
  if (!locks.is_open())
    throw Error(ExitCode::kOutput, "{}: cannot write: {}", store.path().string(), locks.why_not());
  return locks;
}

ByteLocks::Claim claimed(const HeldDirectory& store, const ByteLocks& locks) {
  constexpr std::chrono::milliseconds kBetweenTries{20};
  for (;;) {
    if (auto claim = locks.try_claim(0)) {
      // It is also granted if the system could not lock.
      const ByteLocks other(store, kLockFile, ByteLocks::Opening::kLook);
      if (locks.works() && !other.is_claimed(0))
        throw Error(ExitCode::kOutput, "{}: cannot lock", (store.path() / kLockFile).string());
      return std::move(*claim);
    }
    throw_if_interrupted();
    std::this_thread::sleep_for(kBetweenTries);
  }
}

HeldDirectory make_next(const HeldDirectory& root, const HeldDirectory& store,
                        std::span<const fs::path> directories) {
  HeldDirectory next = store.make_below(kNextStage);
  share_as(root, directories, next);
  return next;
}

ReplacementJournal read_journal(const HeldDirectory& store, const char* stage) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 28;
  const HeldDirectory held = store.below(stage);
  const std::optional<std::string> text = held.read(kJournalFile, kMostBytes);
  std::optional<ReplacementJournal> journal = text ? ReplacementJournal::read(*text) : std::nullopt;
  if (!journal)
    throw Error(ExitCode::kInput,
                "{}: is missing or damaged; once the files in {} are what they should "
                "be, remove {}",
                (held.path() / kJournalFile).string(), store.path().parent_path().string(),
                store.path().string());
  if (journal->directory != inode_of(held))
    throw Error(ExitCode::kInput,
                "{}: is a copy from another place and is not acted upon; remove {}",
                (held.path() / kJournalFile).string(), store.path().string());
  return std::move(*journal);
}

std::uint64_t inode_of(const HeldDirectory& held) {
  FileStatus status{};
  return ::fstat(held.fd(), &status) == 0 ? status.st_ino : 0;
}

std::string ReplacementJournal::text() const {
  std::string text;
  const auto add = [&](const std::string& entry) { (text += entry) += '\0'; };
  add(fmt::format("{} {}", kInWord, directory));
  for (const fs::path& one : made) add(fmt::format("{} {}", kMadeWord, one.native()));
  for (const Entry& entry : entries)
    add(fmt::format("{} {} {}", hex(entry.bytes),
                    entry.before ? hex(*entry.before) : std::string(kNoFileWord),
                    entry.name.native()));
  add(std::string(kEndWord));
  return text;
}

std::optional<ReplacementJournal> ReplacementJournal::read(std::string_view text) {
  ReplacementJournal journal;
  for (;;) {
    const std::size_t end = text.find('\0');
    if (end == text.npos) return std::nullopt;
    const std::string_view entry = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (entry == kEndWord) break;
    if (!read_entry(entry, journal)) return std::nullopt;
  }
  if (!text.empty()) return std::nullopt;
  return journal;
}

std::string new_file_name(std::size_t i) { return fmt::format("new-{}", i); }
std::string old_file_name(std::size_t i) { return fmt::format("old-{}", i); }

bool is_inner_path(const fs::path& path) {
  if (path.empty() || path.is_absolute()) return false;
  for (const fs::path& part : path)
    if (part.empty() || part == "." || part == ".." || part == kReplacedName) return false;
  return true;
}

}  // namespace lobelia
