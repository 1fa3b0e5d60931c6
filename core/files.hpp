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
};

/// Removes from `directory` the temporary files of write_file (".NAME.PID-N.part") whose process is
/// gone: what a killed run left behind.
void remove_abandoned_files(const std::filesystem::path& directory);

}  // namespace lobelia
