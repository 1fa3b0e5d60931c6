#include "compare/accept/held_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/no_resources.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

class NewFile {
 public:
  NewFile(const HeldDirectory& directory, const std::string& name, mode_t mode)
      : path_(directory.path() / name),
        file_(::openat(directory.fd(), name.c_str(),
                       O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, mode)) {
    if (!file_) cannot_write(path_, errno);
  }

  void append(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = retried([&] { return ::write(file_.get(), bytes.data(), bytes.size()); });
      if (n < 0) cannot_write(path_, errno);
      bytes.remove_prefix(std::size_t(n));
    }
  }

  /// If the group is not ours to give, its members may do what everybody may.
  void take_rights(const FileStatus& rights) {
    mode_t mode = rights.st_mode & 0777u;  // new bytes are not run as somebody else
    if (::fchown(file_.get(), uid_t(-1), rights.st_gid) != 0)
      mode = (mode & 0707u) | ((mode & 07u) << 3);
    if (::fchmod(file_.get(), mode) != 0) cannot_write(path_, errno);
  }

  void finish() {
    // Without fsync a full disk may be noticed only after the rename.
    if (::fsync(file_.get()) != 0 && errno != EINVAL) cannot_write(path_, errno);
    if (::close(file_.release()) != 0) cannot_write(path_, errno);
  }

 private:
  fs::path path_;
  Descriptor file_;
};

}  // namespace

bool is_one_file(const FileStatus& a, const FileStatus& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool is_unchanged(const FileStatus& a, const FileStatus& b) {
  return is_one_file(a, b) && a.st_size == b.st_size && a.st_mtim.tv_sec == b.st_mtim.tv_sec &&
         a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

std::optional<FileStatus> status_behind(const fs::path& path) {
  FileStatus status{};
  return ::stat(path.c_str(), &status) == 0 ? std::optional(status) : std::nullopt;
}

std::optional<FileStatus> status_in(const HeldDirectory& directory, const std::string& name) {
  FileStatus status{};
  if (::fstatat(directory.fd(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0) return status;
  if (errno != ENOENT) cannot_write(directory.path() / name, errno);
  return std::nullopt;
}

std::optional<FileStatus> status_if_holds(const HeldDirectory& directory, const std::string& name,
                                          const Sha256Digest& bytes) {
  const std::optional<FileStatus> before = status_in(directory, name);
  if (!before || !S_ISREG(before->st_mode) || sha256_of_file(directory.path() / name) != bytes)
    return std::nullopt;
  const std::optional<FileStatus> after = status_in(directory, name);
  return after && is_unchanged(*before, *after) ? after : std::nullopt;
}

HeldDirectory find_in(const HeldDirectory& root, const fs::path& relative) {
  HeldDirectory held = root.copy();
  for (const fs::path& name : relative) held = held.below(name.string());
  if (!held && !held.is_missing())
    throw Error(ExitCode::kOutput, "{}: cannot write: {}", held.path().string(), held.why_not());
  return held;
}

HeldDirectory make_in(const HeldDirectory& root, const fs::path& relative) {
  HeldDirectory held = root.copy();
  for (const fs::path& name : relative) held = held.make_below(name.string());
  return held;
}

void move_file(const HeldDirectory& from, const std::string& name, const HeldDirectory& to,
               const std::string& new_name) {
  if (::renameat(from.fd(), name.c_str(), to.fd(), new_name.c_str()) != 0)
    cannot_write(to.path() / new_name, errno);
}

bool link_file(const HeldDirectory& from, const std::string& name, const HeldDirectory& to,
               const std::string& new_name) {
  return ::linkat(from.fd(), name.c_str(), to.fd(), new_name.c_str(), 0) == 0;
}

void flush_names(const HeldDirectory& directory) {
  if (::fsync(directory.fd()) != 0 && errno != EINVAL) cannot_write(directory.path(), errno);
}

void write_in(const HeldDirectory& directory, const std::string& name, std::string_view text) {
  NewFile file(directory, name, 0666);
  file.append(text);
  file.finish();
}

void copy_in(const HeldDirectory& directory, const std::string& name, const fs::path& from,
             const std::optional<FileStatus>& rights) {
  const InputFile source(from);
  // Nobody may read what nobody could read before, not even for a moment.
  NewFile file(directory, name, rights ? 0600u : 0666u);
  read_pieces(source, kMostHashedBytes, [&](std::string_view piece) { file.append(piece); });
  if (rights) file.take_rights(*rights);
  file.finish();
}

}  // namespace lobelia
