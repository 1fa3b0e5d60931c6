// The pictures that a scene file names: only from its own directory, each read once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "core/image.hpp"

namespace lobelia {

class EnvironmentMaps {
 public:
  /// Without a directory every picture is refused: the text came from memory.
  explicit EnvironmentMaps(const std::filesystem::path& directory);

  /// Throws Error(kInput) for a path that leaves the directory, also by a symbolic link, for what is no
  /// picture, and for values that are negative, not finite or beyond kBrightest.
  std::shared_ptr<const Image> read(const std::string& file);

 private:
  std::filesystem::path inside(const std::string& file) const;

  std::filesystem::path directory_;
  std::map<std::filesystem::path, std::shared_ptr<const Image>> images_;
  std::int64_t pixels_ = 0;
};

}  // namespace lobelia
