// The content of a program: the files that it runs and loads, and one hash of all of them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "records/result.hpp"
#include "reference_scenes/file_hashes.hpp"

namespace lobelia {

/// Files by path; `sha256` is of every file's part, name (not of programs, nor directories) and content, and empty
/// without files.
using Content = records::Content;

class ContentReader {
 public:
  explicit ContentReader(FileHashes& hashes) : hashes_(hashes) {}
  /// A file that cannot be read counts by its name alone. `part` is "program", "library"...; `name` what it is called
  /// wherever it lies, empty if that makes no difference.
  void add(std::string_view part, std::string_view name, const std::filesystem::path& file);
  /// All regular files below `directory`, by their relative names; without Python's caches, and not through links to
  /// directories. Nothing if it is not there.
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

}  // namespace lobelia
