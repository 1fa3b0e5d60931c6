// Removing files and directories: nothing else in the program does. What goes lies below a directory that is held open,
// is reached without following a symbolic link or entering another file system, and is known as ours.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lobelia {

/// A directory that is held open, whatever becomes of its path. Names in it are looked up without following links.
/// Whatever opens something throws Error(kNoResources) for want of memory or open files: that is no "not there".
class HeldDirectory {
 public:
  HeldDirectory() = default;  ///< holds none
  /// Links on the way to `path` are followed: it is where somebody said. Holds none if that fails.
  explicit HeldDirectory(const std::filesystem::path& path);
  ~HeldDirectory();
  HeldDirectory(HeldDirectory&& other) noexcept;
  HeldDirectory& operator=(HeldDirectory&& other) noexcept;

  explicit operator bool() const { return fd_ >= 0; }
  int fd() const { return fd_; }
  const std::filesystem::path& path() const { return path_; }

  enum class Border { kStay, kCross };  ///< of file systems
  /// The directory of that name in it. Holds none if that is a link, anything else or, unless `border` is kCross, the
  /// root of another file system; why_not() says which.
  HeldDirectory below(const std::string& name, Border border = Border::kStay) const;
  /// Likewise, and makes it if there is nothing of that name. Throws Error(kOutput) where there is a link or something
  /// else, or it cannot be made.
  HeldDirectory make_below(const std::string& name, Border border = Border::kStay) const;
  /// Why it holds none: "a symbolic link, which is not followed".
  std::string why_not() const;
  /// Nothing is there.
  bool is_missing() const;

  std::vector<std::string> names() const;  ///< in it, sorted
  std::vector<std::string> links() const;  ///< of these the symbolic links
  /// A regular file's text; empty if it is none, is longer than that or cannot be opened.
  std::optional<std::string> read(const std::string& name, std::uint64_t max_bytes) const;
  bool is_same_as(const HeldDirectory& other) const;
  HeldDirectory copy() const;

 private:
  std::vector<std::string> list(bool links_only) const;
  int fd_ = -1;
  int error_ = 0;
  std::filesystem::path path_;
};

/// What of a directory may be removed.
enum class Owned {
  kNo,
  kFile,       ///< anything but a directory; of a link the link
  kDirectory,  ///< once it is empty
  kTree,       ///< with all that is in it
};

/// Whose a directory is, and what in it was made by us.
struct Ownership {
  /// By its marker: a file that nobody else puts there.
  std::function<bool(const HeldDirectory& root)> is_ours;
  /// By its name: `relative` is plain names below the root.
  std::function<Owned(const std::filesystem::path& relative)> owned;
};

/// Removes what is ours from a directory, or tells what it would remove.
class Removal {
 public:
  enum class Mode { kForReal, kDryRun };
  /// Of a root that is not ours it removes nothing.
  Removal(const std::filesystem::path& root, Ownership ours, Mode mode = Mode::kForReal);

  /// False if it is not there, or stays: then kept() says why.
  bool remove(const std::filesystem::path& relative);
  /// The same for a tree, which is renamed to `away` first: nobody sees it half removed.
  bool remove_at_once(const std::filesystem::path& relative, const std::filesystem::path& away);

  /// Gets every file and directory that goes, or would go.
  void on_removed(std::function<void(const std::filesystem::path&)> listener);
  struct Kept {
    std::filesystem::path path;
    std::string why;
  };
  const std::vector<Kept>& kept() const { return kept_; }

  /// None if it is not ours.
  const HeldDirectory& root() const { return root_; }
  /// What is in the root or, by its plain names, below it.
  HeldDirectory directory(const std::filesystem::path& relative) const;

 private:
  bool remove_from(const HeldDirectory& parent, const std::string& name,
                   const std::filesystem::path& shown, Owned kind, int depth);
  bool keep(const std::filesystem::path& path, std::string why);
  bool would_be_gone(std::filesystem::path relative) const;

  Ownership ours_;
  Mode mode_;
  HeldDirectory root_;
  std::function<void(const std::filesystem::path&)> on_removed_;
  std::set<std::filesystem::path> would_go_;  ///< of a dry run, as it was asked for
  std::vector<Kept> kept_;
};

/// A new name beside `path` for a file in the making: ".NAME.PID-N.part". N is by chance, because another machine may have
/// a process of that number too.
std::filesystem::path part_path(const std::filesystem::path& path);
/// Whether `name` is such a name; `pid` gets its process.
bool is_part_name(std::string_view name, long long& pid);
/// Removes such a file of this process, if it can. Nothing else of any name. Throws nothing.
void remove_part(const std::filesystem::path& path);

/// A file in the making whose process is gone, here and on other machines; locked while this lives.
class AbandonedPart {
 public:
  AbandonedPart(const HeldDirectory& directory, const std::string& name);
  ~AbandonedPart();
  AbandonedPart(const AbandonedPart&) = delete;
  AbandonedPart& operator=(const AbandonedPart&) = delete;
  explicit operator bool() const { return fd_ >= 0; }

 private:
  int fd_ = -1;
};

/// Removes all of these from a directory.
void remove_abandoned_parts(const HeldDirectory& directory);

inline constexpr char kTemporaryName[] = "lobelia-temporary-";  ///< and six letters or digits

/// Removes a TemporaryDirectory of this process, or what a TemporaryPath names. False if something of it is left.
bool remove_temporary(const std::filesystem::path& path);
/// Removes a file or a directory in one of this user's temporary directories.
void remove_in_temporary_directory(const std::filesystem::path& path);
/// Removes from `parent` the temporary directories that a killed process of this user left behind. Returns their paths.
std::vector<std::filesystem::path> remove_dead_temporaries(const std::filesystem::path& parent);

}  // namespace lobelia
