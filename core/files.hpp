// Files: bounded reading, and writing that never leaves half a file under its final name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace lobelia {

/// The whole file. Throws Error(kInput) if it is missing, not a regular file or over `max_bytes`.
std::string read_file(const std::filesystem::path& path, std::uint64_t max_bytes);

/// Writes to a temporary name beside `path`, flushes it to the disk, then renames.
/// Throws Error(kOutput) with the system's reason; then neither file is left behind.
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

/// A file in the making, for what is too large or too slow to be written at once: under a temporary name
/// beside `path`, which it gets by finish(). Without that nothing is left behind. Throws as write_file does.
class PartFile {
 public:
  explicit PartFile(const std::filesystem::path& path);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  void append(std::span<const std::uint8_t> bytes);
  /// Over what is there already.
  void write_at(std::uint64_t offset, std::span<const std::uint8_t> bytes);
  std::uint64_t size() const { return size_; }
  /// Flushes to the disk, then renames.
  void finish();

 private:
  [[noreturn]] void fail(int error);
  std::filesystem::path path_, target_, part_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
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
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int alive_ = -1;  ///< locked until this object or its process ends
};

/// Removes the directories of TemporaryDirectory that a killed process of this user has left behind.
void remove_abandoned_temporaries();

/// Removes from `directory` the temporary files of write_file (".NAME.PID-N.part") whose process is
/// gone, on this machine or another: what a killed run left behind.
void remove_abandoned_files(const std::filesystem::path& directory);

}  // namespace lobelia
