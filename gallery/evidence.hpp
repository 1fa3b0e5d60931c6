// Whether the files of a cell are still those that its verdict was made of.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gallery/status.hpp"
#include "records/farm.hpp"

namespace lobelia::gallery {

/// The fault of a file that a verdict depends on.
struct Flaw {
  std::string file;     ///< a plain name
  CellStatus status;    ///< kDamaged, kLost or kChanged
  std::string message;  ///< a sentence that names the file
};

class Evidence {
 public:
  /// Hashes every file of `directory` that its record lists. Throws Error(kInput) where it lists one twice.
  Evidence(std::filesystem::path directory, const std::vector<records::CellFile>& files);

  /// In the order of the list.
  const std::vector<Flaw>& flaws() const { return flaws_; }
  bool has(const std::string& file) const { return hashes_.contains(file); }
  /// The SHA-256 of a file without a flaw. Throws Error(kInput) if it cannot be read.
  std::string hash_of(const std::string& file) const;

 private:
  std::filesystem::path directory_;
  std::map<std::string, std::string> hashes_;  ///< of those listed, by name
  std::vector<Flaw> flaws_;
};

}  // namespace lobelia::gallery
