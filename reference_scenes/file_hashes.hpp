// Hashes of files that seldom change, remembered from one run to the next.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "records/result.hpp"

namespace lobelia {

/// A hash is known again as long as the file has the same device, inode, size, and times of change of content and
/// inode. What changed within the last two seconds is not remembered: it may change again within one tick of the clock.
class FileHashes {
 public:
  /// Reads what `file` remembers. What is damaged, too large, not ours or not there is the same as nothing.
  explicit FileHashes(std::filesystem::path file);
  /// The user's hashes on this machine: $XDG_CACHE_HOME/lobelia/file-hashes-HOST.json, or below ~/.cache. Remembers nothing if
  /// neither folder exists.
  static FileHashes& of_user();

  /// Throws Error(kInput) if it cannot be read or is no regular file.
  records::ContentFile hash(const std::filesystem::path& path);
  /// Writes what is new, as far as that is possible, without files that are gone. Else the next run reads them again.
  void save();
  std::size_t read_count() const { return read_count_; }  ///< of files whose bytes were read

 private:
  struct Entry {
    std::string identity, sha256;
  };
  std::filesystem::path file_;
  std::mutex mutex_;
  std::map<std::string, Entry> entries_;  ///< by path
  bool changed_ = false;
  std::size_t read_count_ = 0;
};

}  // namespace lobelia
