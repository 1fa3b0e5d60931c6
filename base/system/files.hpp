// Files: bounded reading, and writing that never leaves half a file under its final name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/system/descriptor.hpp"
#include "base/system/error.hpp"
#include "base/system/interrupt.hpp"

namespace lobelia {

/// A regular file, open for reading.
class InputFile {
 public:
  /// Does not wait for the writer of a pipe. Throws Error(kInput) if it is missing, cannot be read or is no regular file.
  explicit InputFile(const std::filesystem::path& path);
  const std::filesystem::path& path() const { return path_; }  ///< as it was given
  int descriptor() const { return file_.get(); }
  std::uint64_t size() const { return size_; }  ///< in bytes, when it was opened
  /// Where the open file lies, absolute and without links. Throws Error(kInput) if path() leads to another file by now.
  std::filesystem::path real_path() const;
  Descriptor release() { return std::move(file_); }

 private:
  std::filesystem::path path_;
  Descriptor file_;
  std::uint64_t size_ = 0;
};

/// Whether a path is the folder or lies in it; both are absolute and without links.
bool is_below(const std::filesystem::path& path, const std::filesystem::path& folder);

/// The whole file. Throws Error(kInput) if it is missing, not a regular file or over `max_bytes`, and Error(kInterrupted)
/// as read_in_pieces().
std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes);
std::string read_file(const InputFile& file, std::uint64_t max_bytes);

/// Gives the pieces of the file to `take`, in order. Throws Error(kInput) if it cannot be read, or has over `max_bytes` or
/// grows beyond them; Error(kInterrupted) as read_in_pieces().
void read_pieces(const InputFile& file, std::uint64_t max_bytes,
                 const std::function<void(std::string_view)>& take);

/// Bytes that are read or hashed between two looks for an interruption. Smaller files are read to the end.
inline constexpr std::size_t kBytesBetweenLooks = std::size_t{16} << 20;

/// As read_at(), for files of others, which may be large. Throws Error(kInterrupted) if interrupted().
std::size_t read_in_pieces(int file, void* target, std::size_t size, std::size_t offset = 0);

/// The type of what is at `path`, behind all links; not_found if nothing is. Throws an error of the code `otherwise` where
/// the system cannot tell, as on a fault of the disk or in a folder that may not be searched.
std::filesystem::file_type file_type_at(const std::filesystem::path& path,
                                        ExitCode otherwise = ExitCode::kInput);

/// `path` as an absolute path without links, as far as it exists. Throws as file_type_at().
std::filesystem::path real_path(const std::filesystem::path& path,
                                ExitCode otherwise = ExitCode::kInput);

/// All regular files below `directory`, in no order. Throws Error(kInput) if a part of it cannot be listed.
std::vector<std::filesystem::path> regular_files_below(const std::filesystem::path& directory);

/// The file that a write replaces if its path is a symbolic link.
enum class AtLink {
  kFollow,  ///< the file that the link leads to: for paths that a user chose
  kReplace  ///< the link itself: for names of ours
};

/// Writes to a temporary name beside `path`, flushes it to the disk, then renames.
/// Throws Error(kOutput) with the system's reason; then neither file is left behind.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                AtLink at_link = AtLink::kFollow);
void write_file(const std::filesystem::path& path, std::string_view text,
                AtLink at_link = AtLink::kFollow);

/// A file that is written piece by piece, under a temporary name beside `path`. finish() renames it to `path`; without
/// that nothing is left behind. Throws as write_file does.
class PartFile {
 public:
  explicit PartFile(const std::filesystem::path& path, AtLink at_link = AtLink::kFollow);
  PartFile(PartFile&&) = default;
  ~PartFile();
  void append(std::span<const std::uint8_t> bytes);
  void append(std::string_view text);
  /// Appends the content of another file. Throws as sha256_of_file().
  void append_file(const std::filesystem::path& path);
  /// Overwrites bytes that are there already.
  void write_at(std::uint64_t offset, std::span<const std::uint8_t> bytes);
  std::uint64_t size() const { return size_; }
  const std::filesystem::path&
  part();  ///< its temporary name. The file holds all that was appended so far
  /// Flushes to the disk, then renames. If there is a FilesTogether, its commit() does both instead.
  void finish();

 private:
  friend class FilesTogether;
  [[noreturn]] void fail(int error);
  void flush();
  void close();
  void write(std::uint64_t offset, std::span<const std::uint8_t> bytes);
  void write_waiting();
  Descriptor file_;
  std::filesystem::path path_, target_;
  TemporaryPath part_;
  std::vector<std::uint8_t>
      waiting_;  ///< the last bytes of size_, not yet written: appended pieces may be tiny
  std::uint64_t size_ = 0;
};

/// While this lives, files that its thread finishes are not flushed to the disk: whoever has it does that (GroupFlush).
class FlushLater {
 public:
  FlushLater();
  ~FlushLater();
  FlushLater(const FlushLater&) = delete;
  FlushLater& operator=(const FlushLater&) = delete;
};

/// Publishes all files of a command at once: while this lives, finished PartFiles keep their temporary names until
/// commit() flushes and renames them all. Without commit() none is left behind. A process has at most one at a time.
class FilesTogether {
 public:
  FilesTogether();
  ~FilesTogether();
  FilesTogether(const FilesTogether&) = delete;
  FilesTogether& operator=(const FilesTogether&) = delete;
  /// Throws Error(kInterrupted) if interrupted(), and as PartFile. Later interruptions come too late
  /// (base/system/interrupt.hpp).
  void commit();

 private:
  friend class PartFile;
  static FilesTogether* current_;
  std::mutex mutex_;
  std::vector<PartFile> finished_;
};

/// Throws Error(kOutput) unless a file can be created at `path`. For before long work starts. Removes what killed runs
/// left of such a file.
void require_writable(const std::filesystem::path& path);

/// As create_directories, but throws Error(kOutput).
void make_directories(const std::filesystem::path& path);

/// $TMPDIR, or else /tmp. Throws Error(kOutput) if that is no directory.
std::filesystem::path place_for_temporaries();

/// A directory that is removed with everything in it when this object goes.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  /// Below `parent`, for what is then renamed into it.
  explicit TemporaryDirectory(const std::filesystem::path& parent);
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::filesystem::path& path() const { return path_.path(); }

 private:
  Descriptor lock_;  ///< held until this object or its process ends
  TemporaryPath path_;
};

/// Removes the TemporaryDirectories in $TMPDIR that killed processes of this user left behind, once in each process.
void remove_abandoned_temporaries();

}  // namespace lobelia
