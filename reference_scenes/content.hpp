// The content of a program: the files that it runs and loads, with one hash over all of them.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/records/result.hpp"
#include "base/system/files.hpp"
#include "base/system/sha256.hpp"
#include "reference_scenes/engine.hpp"

namespace lobelia {

/// Whether a file that could not be read is gone, is no regular file, may not be read or is over `max_bytes`: reasons that
/// stay, unlike a fault of its disk.
bool is_out_of_reach(const std::filesystem::path& file, std::uint64_t max_bytes = UINT64_MAX);

/// Hashes of files that seldom change, remembered from one run to the next. A hash stays valid while the file's device,
/// inode, size, and times of change of content and inode stay the same. A file changed within the last two seconds is not
/// remembered: it may change again within one tick of the clock.
class FileHashes {
 public:
  /// Reads what `file` remembers. A damaged, too large, foreign or absent file counts as empty.
  explicit FileHashes(std::filesystem::path file);
  /// The user's hashes on this machine: $XDG_CACHE_HOME/lobelia/file-hashes-HOST.json, or below ~/.cache. Remembers nothing
  /// if neither folder exists.
  static FileHashes& of_user();

  /// Throws as sha256_of_file().
  records::ContentFile hash(const std::filesystem::path& path);
  records::ContentFile hash(const InputFile& file,
                            std::chrono::duration<double> time_limit = kAnyTime);
  /// Writes new hashes and drops those of deleted files. If it cannot write, the next run reads the files again.
  void save();
  std::size_t read_count() const { return read_count_; }  ///< files hashed by reading them

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

/// Files by path. `sha256` covers each file's part, content and name (except of programs and directories); it is empty
/// without files.
using Content = records::Content;

class ContentReader {
 public:
  explicit ContentReader(FileHashes& hashes) : hashes_(hashes) {}
  /// `part` is "program", "library" and so on. `name` is the same wherever the file lies; empty if it makes no difference.
  /// A file that is gone or may not be read counts by its name only. Throws Error(kInput) if one has over kMostHashedBytes
  /// or cannot be read for another reason, such as a fault of the disk.
  void add(std::string_view part, std::string_view name, const std::filesystem::path& file);
  /// All regular files below `directory`, if it exists, by their relative names. Skips Python's caches and links to
  /// directories. Throws as add(), and if a directory cannot be listed.
  void add_directory(const std::filesystem::path& directory);
  Content content();

 private:
  FileHashes& hashes_;
  std::vector<std::string> parts_;
  std::vector<records::ContentFile> files_;
};

/// The files that differ: "/usr/bin/povray changed", "... is new", "... is gone". At most `most`, then the number of the
/// others.
std::vector<std::string> file_changes(const Content& before, const Content& now, std::size_t most);

// The files that an engine runs, loads and reads.

/// Finds the programs that a process tree runs and the libraries that it loads, including those of dlopen(), from the log of
/// glibc's loader (LD_DEBUG=files, ld.so(8)). Costs a few milliseconds.
class LoaderTrace {
 public:
  /// `directory` is private and exists while the processes run.
  explicit LoaderTrace(std::filesystem::path directory) : directory_(std::move(directory)) {}
  std::vector<std::string> environment() const;
  /// The files that the loader has named so far, without Lobelia's own programs. Their number is bounded.
  EngineFiles files() const;

 private:
  std::filesystem::path directory_;
};

/// The content of an engine that is ready; empty for one that is part of Lobelia. Reads only files that `hashes` does not
/// know.
Content engine_content(const EngineStatus& status, FileHashes& hashes);

}  // namespace lobelia
