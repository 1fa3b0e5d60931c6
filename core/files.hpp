// Files: bounded reading, and writing that never leaves half a file under its final name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/interrupt.hpp"

namespace lobelia {

/// The whole file. Throws Error(kInput) if it is missing, not a regular file or over `max_bytes`.
std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes);

/// What to do if the path to write is a symbolic link.
enum class AtLink {
  kFollow,  ///< the file that it leads to is replaced: for paths that a user chose
  kReplace  ///< the link itself: for names of ours
};

/// Writes to a temporary name beside `path`, flushes it to the disk, then renames.
/// Throws Error(kOutput) with the system's reason; then neither file is left behind.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes,
                AtLink at_link = AtLink::kFollow);
void write_file(const std::filesystem::path& path, std::string_view text,
                AtLink at_link = AtLink::kFollow);

/// A file in the making, for what is too large or too slow to be written at once: under a temporary name
/// beside `path`, which it gets by finish(). Without that nothing is left behind. Throws as write_file does.
class PartFile {
 public:
  explicit PartFile(const std::filesystem::path& path, AtLink at_link = AtLink::kFollow);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  void append(std::span<const std::uint8_t> bytes);
  /// Over what is there already.
  void write_at(std::uint64_t offset, std::span<const std::uint8_t> bytes);
  std::uint64_t size() const { return size_; }
  /// Flushes to the disk, then renames; where there is a FilesTogether, its commit() renames.
  void finish();

 private:
  friend class FilesTogether;
  [[noreturn]] void fail(int error);
  int fd_ = -1;
  std::filesystem::path path_, target_;
  TemporaryPath part_;
  std::uint64_t size_ = 0;
};

/// The files of one command: while this lives, each finished PartFile keeps its temporary name until commit()
/// gives all of them their own. Without commit() none is left behind. One at a time in a process.
class FilesTogether {
 public:
  FilesTogether();
  ~FilesTogether();
  FilesTogether(const FilesTogether&) = delete;
  FilesTogether& operator=(const FilesTogether&) = delete;
  /// Throws Error(kInterrupted) if interrupted(), and as PartFile. An interruption that comes later is
  /// too late (core/interrupt.hpp).
  void commit();

 private:
  friend class PartFile;
  struct State;
  /// False where there is none.
  static bool add(PartFile& file);
  static FilesTogether* current_;
  std::unique_ptr<State> state_;
};

/// Throws Error(kOutput) unless a file could be created at `path`; asked before long work starts.
void require_writable(const std::filesystem::path& path);

/// create_directories, but as Error(kOutput).
void make_directories(const std::filesystem::path& path);

/// A directory that is removed with everything in it when this object goes.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::filesystem::path& path() const { return path_->path(); }

 private:
  std::optional<TemporaryPath> path_;
  int alive_ = -1;  ///< locked until this object or its process ends
};

/// Removes the directories of TemporaryDirectory that a killed process of this user has left behind.
void remove_abandoned_temporaries();

/// Removes from `directory` the temporary files of write_file (".NAME.PID-N.part") whose process is
/// gone, on this machine or another: what a killed run left behind.
void remove_abandoned_files(const std::filesystem::path& directory);

}  // namespace lobelia
