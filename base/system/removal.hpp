// The only code of the program that removes files and directories. It removes what lies below a directory that is held
// open, is reached without following a symbolic link or entering another file system, and is known as ours.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/descriptor.hpp"

namespace lobelia {

/// A directory that is held open, whatever becomes of its path. Names in it are looked up without following links.
/// Everything that opens a file throws Error(kNoResources) for lack of memory or open files, instead of "not there".
class HeldDirectory {
 public:
  HeldDirectory() = default;  ///< holds none
  /// Follows links on the way to `path`, which a user chose. Holds none if it cannot be opened.
  explicit HeldDirectory(const std::filesystem::path& path);

  explicit operator bool() const { return bool(open_); }
  int fd() const { return open_.get(); }
  const std::filesystem::path& path() const { return path_; }

  enum class Border { kStay, kCross };  ///< whether to enter another file system
  /// The directory `name` in it. Holds none if `name` is missing, a link, no directory or, with kStay, the root of another
  /// file system; why_not() says which.
  HeldDirectory below(const std::string& name, Border border = Border::kStay) const;
  /// The same, and makes a missing directory. Throws Error(kOutput) if it holds none.
  HeldDirectory make_below(const std::string& name, Border border = Border::kStay) const;
  /// Why it holds none: "a symbolic link, which is not followed".
  std::string why_not() const;
  bool is_missing() const;
  /// Whether the system could not open it: it is neither missing nor of another kind.
  bool is_fault() const;

  std::vector<std::string> names() const;       ///< all entries, sorted
  bool is_link(const std::string& name) const;  ///< whether an entry is a symbolic link
  /// The text of a regular file; nothing if it is no such file, is over `max_bytes` or cannot be opened.
  std::optional<std::string> read(const std::string& name, std::uint64_t max_bytes) const;
  bool is_same_as(const HeldDirectory& other) const;
  HeldDirectory copy() const;

 private:
  Descriptor open_;
  int error_ = 0;
  std::filesystem::path path_;
};

/// The kind of entry that may be removed under a name.
enum class Owned {
  kNo,
  kFile,       ///< anything but a directory; a link itself, not its target
  kDirectory,  ///< once it is empty
  kTree,       ///< with everything in it
};

/// Tells what was made by us.
struct Ownership {
  /// Whether the root is ours, by a marker: a file that only we put there.
  std::function<bool(const HeldDirectory& root)> is_ours;
  /// The kind of `relative`, a path of plain names below the root, by its name.
  std::function<Owned(const std::filesystem::path& relative)> owned;
};

/// Removes what is ours from a directory, or in a dry run tells what it would remove.
class Removal {
 public:
  enum class Mode { kForReal, kDryRun };
  /// Removes nothing if the root is not ours.
  Removal(const std::filesystem::path& root, Ownership ours, Mode mode = Mode::kForReal);

  /// False if it is not there or is kept; kept() says why.
  bool remove(const std::filesystem::path& relative);
  /// The same for a tree, which is first renamed to `away`, so that nobody sees it half removed.
  bool remove_at_once(const std::filesystem::path& relative, const std::filesystem::path& away);

  /// Calls `listener` with the path of everything that is removed, or would be.
  void on_removed(std::function<void(const std::filesystem::path&)> listener);
  struct Kept {
    std::filesystem::path path;
    std::string why;
    bool is_fault = false;  ///< whether the system failed; otherwise it is foreign or not empty
  };
  const std::vector<Kept>& kept() const { return kept_; }

  /// Holds none if the root is not ours.
  const HeldDirectory& root() const { return root_; }
  /// A directory below the root, by plain names; the root itself if `relative` is empty.
  HeldDirectory directory(const std::filesystem::path& relative) const;

 private:
  bool remove_from(const HeldDirectory& parent, const std::string& name,
                   const std::filesystem::path& shown, Owned kind, int depth);
  bool keep(const std::filesystem::path& path, std::string why);
  bool keep(const std::filesystem::path& path, int error);
  bool keep(const HeldDirectory& missing);
  bool would_be_gone(std::filesystem::path relative) const;

  Ownership ours_;
  Mode mode_;
  HeldDirectory root_;
  std::function<void(const std::filesystem::path&)> on_removed_;
  std::set<std::filesystem::path> would_go_;  ///< in a dry run, what remove() was asked for
  std::vector<Kept> kept_;
};

/// A new name beside `path` for an unfinished file: ".NAME.PID-N.part". N says when the process began, because a later
/// one may have its PID, and has random bits, because one of another machine may have it.
std::filesystem::path part_path(const std::filesystem::path& path);
bool is_part_name(std::string_view name);
/// Removes a file of part_path() if it can, and nothing with another name. Throws nothing.
void remove_part(const std::filesystem::path& path);
/// Locks an unfinished file if its process is gone, here and on other machines; otherwise returns none.
Descriptor lock_abandoned_part(const HeldDirectory& directory, const std::string& name);
/// Removes what killed runs left behind of the files with these names: unfinished files of processes that are gone.
void remove_abandoned_parts(const HeldDirectory& directory, const std::set<std::string>& names);
/// The same for files of any name, in a directory where only ours are written.
void remove_abandoned_parts(const HeldDirectory& directory);

inline constexpr char kTemporaryName[] = "lobelia-temporary-";  ///< and six letters or digits

/// Removes a TemporaryDirectory of this process, or the file of a TemporaryPath. False if anything is left.
bool remove_temporary(const std::filesystem::path& path);
/// Removes a file or a directory in one of this user's temporary directories.
void remove_in_temporary_directory(const std::filesystem::path& path);
/// Removes from `parent` the TemporaryDirectories that killed processes of this user left behind. Returns their paths.
std::vector<std::filesystem::path> remove_dead_temporaries(const std::filesystem::path& parent);

}  // namespace lobelia
