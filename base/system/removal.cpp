#include "base/system/removal.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/openat2.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <random>

#include "base/system/error.hpp"
#include "base/system/host.hpp"
#include "base/system/no_resources.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

/// Nested directories; each is held open.
constexpr int kMaxDepth = 128;
constexpr int kOpenDirectory = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK;

/// Whether a directory can have such an entry, hidden files among them. Names from elsewhere must be is_plain_name().
bool is_entry_name(std::string_view name) {
  return !name.empty() && name != "." && name != ".." && name.find('/') == name.npos &&
         name.find('\0') == name.npos;
}

bool is_on_one_device(int a, int b) {
  struct stat first {
  }, second{};
  return ::fstat(a, &first) == 0 && ::fstat(b, &second) == 0 && first.st_dev == second.st_dev;
}

/// A lack of memory or open files does not mean that the file is missing.
void throw_if_lacking(const fs::path& path, int error) {
  if (!lacking(error).empty()) throw failure_of(path.string(), error, ExitCode::kOutput);
}

/// Only openat2 notices a bind mount of the same file system: its device number is the same.
int open_directory(int parent, const std::string& name, HeldDirectory::Border border) {
  if (border == HeldDirectory::Border::kStay) {
    open_how how{};
    how.flags = kOpenDirectory;
    how.resolve = RESOLVE_NO_XDEV | RESOLVE_NO_SYMLINKS;
    const long fd = ::syscall(SYS_openat2, parent, name.c_str(), &how, sizeof how);
    if (fd >= 0 || (errno != ENOSYS && errno != EPERM && errno != EINVAL)) return int(fd);
  }
  Descriptor found(::openat(parent, name.c_str(), kOpenDirectory));
  if (!found || border == HeldDirectory::Border::kCross || is_on_one_device(parent, found.get()))
    return found.release();
  errno = EXDEV;
  return -1;
}

bool is_directory(int parent, const std::string& name) {
  struct stat status {};
  return ::fstatat(parent, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
         S_ISDIR(status.st_mode);
}

/// An engine may have made a directory that even its owner cannot read.
void allow_owner(int parent, const std::string& name) {
  const Descriptor there(::openat(parent, name.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC));
  struct stat status {};
  if (there && ::fstat(there.get(), &status) == 0 && S_ISDIR(status.st_mode))
    ::chmod(fmt::format("/proc/self/fd/{}", there.get()).c_str(), 0700);
}

bool is_temporary_name(std::string_view name) {
  constexpr std::size_t kPrefix = sizeof kTemporaryName - 1;
  return name.size() == kPrefix + 6 && name.starts_with(kTemporaryName) &&
         std::ranges::all_of(name.substr(kPrefix),
                             [](unsigned char c) { return std::isalnum(c) != 0; });
}

/// Removes a TemporaryDirectory, known by its name and its owner.
Removal removal_of_temporary(const fs::path& path) {
  return Removal(path.parent_path(), {[name = path.filename().string()](const HeldDirectory& root) {
                                        struct stat status {};
                                        const HeldDirectory there = root.below(name);
                                        return there && is_temporary_name(name) &&
                                               ::fstat(there.fd(), &status) == 0 &&
                                               status.st_uid == ::geteuid();
                                      },
                                      [name = path.filename()](const fs::path& relative) {
                                        return relative == name ? Owned::kTree : Owned::kNo;
                                      }});
}

constexpr long long kEnded = -1;

/// When a process began, in ticks of a clock modulo 2^31, which tells it from others that have had its PID. 0 if that cannot
/// be told. kEnded for one that was killed and whose parent does not ask for it.
long long start_of_process(long long process) {
  const bool is_own = process == ::getpid();
  // A /proc of another PID namespace has other processes under our numbers.
  if (!is_own && !proc_has_our_numbers()) return 0;
  const ProcessStat there = stat_of_process(is_own ? "self" : std::to_string(process));
  return there.has_ended() ? kEnded : (long long)(there.start & 0x7fffffff);
}

struct PartName {
  std::string_view of;    ///< the name of the finished file
  long long process = 0;  ///< 0: no name of part_path()
  long long number = 0;
};

PartName part_name(std::string_view name) {
  if (!name.starts_with('.') || !name.ends_with(".part")) return {};
  name.remove_suffix(5);
  const auto dash = name.rfind('-'), dot = name.rfind('.', dash);
  if (dash == name.npos || dot == name.npos || dot == 0) return {};
  PartName part{name.substr(1, dot - 1)};
  const bool is_one = parse_integer(name.substr(dot + 1, dash - dot - 1), part.process) &&
                      part.process > 0 && parse_integer(name.substr(dash + 1), part.number) &&
                      part.number >= 0;
  return is_one ? part : PartName{};
}

}  // namespace

HeldDirectory::HeldDirectory(const fs::path& path)
    : open_(::open(path.empty() ? "." : path.c_str(),
                   O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NONBLOCK)),
      error_(open_ ? 0 : errno),
      path_(path) {
  throw_if_lacking(path_, error_);
}

HeldDirectory HeldDirectory::below(const std::string& name, Border border) const {
  HeldDirectory found;
  found.path_ = path_ / name;
  found.error_ = !open_ ? error_ : !is_entry_name(name) ? EINVAL : 0;
  if (found.error_ != 0) return found;
  found.open_ = Descriptor(open_directory(fd(), name, border));
  if (found) return found;
  found.error_ = errno;
  throw_if_lacking(found.path_, found.error_);
  if (is_link(name)) found.error_ = ELOOP;
  return found;
}

HeldDirectory HeldDirectory::make_below(const std::string& name, Border border) const {
  HeldDirectory made = below(name, border);
  if (made.is_missing() && open_) {
    if (::mkdirat(fd(), name.c_str(), 0777) != 0 && errno != EEXIST)
      throw Error(ExitCode::kOutput, "{}: cannot make the directory: {}", made.path().string(),
                  std::strerror(errno));
    made = below(name, border);
  }
  if (!made)
    throw Error(ExitCode::kOutput, "{}: cannot write: {}", made.path().string(), made.why_not());
  return made;
}

std::string HeldDirectory::why_not() const {
  if (error_ == ELOOP) return "a symbolic link, which is not followed";
  if (error_ == EXDEV) return "another file system";
  return std::strerror(error_);
}

bool HeldDirectory::is_missing() const { return !open_ && error_ == ENOENT; }

bool HeldDirectory::is_fault() const {
  return !open_ && error_ != ENOENT && error_ != ELOOP && error_ != ENOTDIR && error_ != EXDEV;
}

bool HeldDirectory::is_link(const std::string& name) const {
  struct stat status {};
  return ::fstatat(fd(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
         S_ISLNK(status.st_mode);
}

std::vector<std::string> HeldDirectory::names() const {
  std::vector<std::string> found;
  if (!open_) return found;
  // Opened again, because descriptors of one open file share its position in the list.
  Descriptor again(::openat(fd(), ".", kOpenDirectory));
  DIR* const directory = again ? ::fdopendir(again.get()) : nullptr;
  if (!directory) {
    throw_if_lacking(path_, errno);
    return found;
  }
  again.release();  // closedir() closes it
  while (const dirent* entry = ::readdir(directory))
    if (is_entry_name(entry->d_name)) found.emplace_back(entry->d_name);
  ::closedir(directory);
  std::ranges::sort(found);
  return found;
}

std::optional<std::string> HeldDirectory::read(const std::string& name,
                                               std::uint64_t max_bytes) const {
  if (!open_ || !is_entry_name(name)) return std::nullopt;
  const Descriptor file(
      ::openat(fd(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
  if (!file) throw_if_lacking(path_ / name, errno);
  struct stat status {};
  if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
      std::uint64_t(status.st_size) > max_bytes)
    return std::nullopt;
  std::string text(std::size_t(status.st_size), '\0');
  text.resize(read_at(file.get(), text.data(), text.size()));
  return text;
}

bool HeldDirectory::is_same_as(const HeldDirectory& other) const {
  struct stat a {
  }, b{};
  return ::fstat(fd(), &a) == 0 && ::fstat(other.fd(), &b) == 0 && a.st_dev == b.st_dev &&
         a.st_ino == b.st_ino;
}

HeldDirectory HeldDirectory::copy() const {
  HeldDirectory held;
  held.path_ = path_;
  held.error_ = error_;
  if (!open_) return held;
  held.open_ = Descriptor(::fcntl(fd(), F_DUPFD_CLOEXEC, 0));
  if (!held) held.error_ = errno;
  throw_if_lacking(path_, held.error_);
  return held;
}

Removal::Removal(const fs::path& root, Ownership ours, Mode mode)
    : ours_(std::move(ours)), mode_(mode), root_(root) {
  if (root_ && !ours_.is_ours(root_)) root_ = HeldDirectory();
}

void Removal::on_removed(std::function<void(const fs::path&)> listener) {
  on_removed_ = std::move(listener);
}

bool Removal::keep(const fs::path& path, std::string why) {
  kept_.push_back({path, std::move(why)});
  return false;
}

bool Removal::keep(const fs::path& path, int error) {
  kept_.push_back({path, std::strerror(error), true});
  return false;
}

bool Removal::keep(const HeldDirectory& missing) {
  kept_.push_back({missing.path(), missing.why_not(), missing.is_fault()});
  return false;
}

HeldDirectory Removal::directory(const fs::path& relative) const {
  HeldDirectory held = root_.copy();
  for (const fs::path& name : relative) held = held.below(name.string());
  return held;
}

bool Removal::would_be_gone(fs::path relative) const {
  for (; !would_go_.empty() && !relative.empty(); relative = relative.parent_path())
    if (would_go_.contains(root_.path() / relative)) return true;
  return false;
}

bool Removal::remove(const fs::path& relative) {
  const fs::path shown = root_.path() / relative;
  const std::string name = relative.filename().string();
  const HeldDirectory parent = directory(relative.parent_path());
  if (!parent) return root_ && !parent.is_missing() ? keep(parent) : false;
  struct stat status {};
  if (!is_entry_name(name) || would_be_gone(relative)) return false;
  if (::fstatat(parent.fd(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
    return errno == ENOENT ? false : keep(shown, errno);
  const Owned kind = ours_.owned(relative);
  if (kind == Owned::kNo) return keep(shown, "not a file of this program");
  if (S_ISDIR(status.st_mode) && kind == Owned::kFile) return keep(shown, "a directory");
  if (!S_ISDIR(status.st_mode) && kind == Owned::kDirectory) return keep(shown, "not a directory");
  return remove_from(parent, name, shown, kind, 0);
}

bool Removal::remove_at_once(const fs::path& relative, const fs::path& away) {
  if (mode_ == Mode::kDryRun) return remove(relative);
  // A dry run first: what must stay is not moved.
  Removal first(root_.path(), ours_, Mode::kDryRun);
  std::vector<fs::path> paths;
  first.on_removed([&](const fs::path& path) { paths.push_back(path); });
  const bool goes = first.remove(relative);
  for (const Kept& one : first.kept()) kept_.push_back(one);
  if (!goes) return false;
  const HeldDirectory from = directory(relative.parent_path()), to = directory(away.parent_path());
  if (!from || !to || ours_.owned(away) != Owned::kTree) return remove(relative);
  if (::renameat(from.fd(), relative.filename().c_str(), to.fd(), away.filename().c_str()) != 0)
    return errno == ENOENT ? false : keep(root_.path() / relative, errno);
  const auto listener = std::exchange(on_removed_, nullptr);
  const bool gone = remove(away);
  on_removed_ = listener;
  if (on_removed_)
    for (const fs::path& path : paths) on_removed_(path);
  return gone;
}

bool Removal::remove_from(const HeldDirectory& parent, const std::string& name,
                          const fs::path& shown, Owned kind, int depth) {
  const bool for_real = mode_ == Mode::kForReal;
  if (would_go_.contains(shown)) return true;
  const bool is_a_directory = is_directory(parent.fd(), name);
  if (is_a_directory) {
    HeldDirectory inner = parent.below(name);
    if (!inner && for_real && kind == Owned::kTree) {
      allow_owner(parent.fd(), name);
      inner = parent.below(name);
    }
    if (!inner) return inner.is_missing() || keep(inner);
    bool is_empty = true;
    for (const std::string& inside : inner.names()) {
      if (kind == Owned::kTree && depth == kMaxDepth)
        return keep(shown, fmt::format("more than {} directories in one another", kMaxDepth));
      is_empty = (kind == Owned::kTree ? remove_from(inner, inside, shown / inside, kind, depth + 1)
                                       : would_go_.contains(shown / inside)) &&
                 is_empty;
    }
    if (!is_empty) return kind == Owned::kTree ? false : keep(shown, "it is not empty");
  }
  if (for_real) {
    const int flags = is_a_directory ? AT_REMOVEDIR : 0;
    int result = ::unlinkat(parent.fd(), name.c_str(), flags);
    if (result != 0 && errno == EACCES && depth > 0 && ::fchmod(parent.fd(), 0700) == 0)
      result = ::unlinkat(parent.fd(), name.c_str(), flags);
    if (result != 0) return errno == ENOENT || keep(shown, errno);
  } else if (depth == 0) {
    would_go_.insert(shown);
  }
  if (on_removed_) on_removed_(shown);
  return true;
}

fs::path part_path(const fs::path& path) {
  static std::atomic<std::uint32_t> count = std::random_device()();
  return path.parent_path() / fmt::format(".{}.{}-{}.part", path.filename().string(), ::getpid(),
                                          start_of_process(::getpid()) << 32 | count++);
}

bool is_part_name(std::string_view name) { return part_name(name).process > 0; }

void remove_part(const fs::path& path) try {
  Removal(path.parent_path(), {[](const HeldDirectory&) { return true; },
                               [](const fs::path& relative) {
                                 return is_part_name(relative.native()) ? Owned::kFile : Owned::kNo;
                               }})
      .remove(path.filename());
} catch (const Error&) {  // it stays, and the next farm removes it
}

Descriptor lock_abandoned_part(const HeldDirectory& directory, const std::string& name) {
  const PartName part = part_name(name);
  if (part.process == 0) return Descriptor();
  if (::kill(pid_t(part.process), 0) == 0 || errno != ESRCH) {
    // In a container the next command often has the PID of the one that was killed.
    const long long start = start_of_process(part.process);
    if (start == 0 || start == part.number >> 32) return Descriptor();
  }
  // No such process runs here. One on another machine would hold the lock.
  Descriptor file(
      ::openat(directory.fd(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (file && (::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
               ::flock(file.get(), LOCK_EX | LOCK_NB) != 0))
    file.close();
  return file;
}

namespace {

void remove_if_abandoned(const HeldDirectory& directory, const std::string& part) {
  if (const Descriptor lock = lock_abandoned_part(directory, part))
    ::unlinkat(directory.fd(), part.c_str(), 0);
}

}  // namespace

void remove_abandoned_parts(const HeldDirectory& directory, const std::set<std::string>& names) {
  for (const std::string& part : directory.names())
    if (names.contains(std::string(part_name(part).of))) remove_if_abandoned(directory, part);
}

void remove_abandoned_parts(const HeldDirectory& directory) {
  for (const std::string& part : directory.names()) remove_if_abandoned(directory, part);
}

bool remove_temporary(const fs::path& path) try {
  if (is_part_name(path.filename().native())) {
    remove_part(path);
    return true;
  }
  Removal removal = removal_of_temporary(path);
  removal.remove(path.filename());
  return removal.kept().empty();
} catch (const Error&) {
  return false;
}

void remove_in_temporary_directory(const fs::path& path) {
  // Split at the first TemporaryDirectory in the path.
  fs::path temporary, below;
  for (const fs::path& part : path)
    (is_temporary_name(temporary.filename().native()) ? below : temporary) /= part;
  if (below.empty() || !removal_of_temporary(temporary).root()) return;
  Removal(temporary,
          {[](const HeldDirectory&) { return true; }, [](const fs::path&) { return Owned::kTree; }})
      .remove(below);
}

std::vector<fs::path> remove_dead_temporaries(const fs::path& parent) {
  std::vector<fs::path> removed;
  const HeldDirectory held(parent);
  for (const std::string& name : held.names()) {
    if (!is_temporary_name(name)) continue;
    Removal removal = removal_of_temporary(parent / name);
    // The lock is kept until it is gone: its maker locks it too, and then looks whether it is still there.
    const HeldDirectory dead = removal.directory(name);
    if (dead && ::flock(dead.fd(), LOCK_EX | LOCK_NB) == 0 && removal.remove(name))
      removed.push_back(parent / name);
  }
  return removed;
}

}  // namespace lobelia
