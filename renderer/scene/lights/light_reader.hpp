// Reads the emitters of a scene file by the tables of the lights, and the pictures that they name.
#pragma once

#include <filesystem>
#include <map>

#include "renderer/scene/element_reader.hpp"
#include "renderer/scene/lights/lights.hpp"

namespace lobelia {

/// The pictures of a scene file, only from its own directory, each read once.
class EnvironmentMaps {
 public:
  /// Without a directory, for a text from memory, every picture is refused.
  explicit EnvironmentMaps(const std::filesystem::path& directory);

  /// Throws Error(kInput) for a path that leaves the directory, also by a symbolic link, for a file that is no
  /// picture, and for values that are negative, not finite or beyond kBrightest.
  std::shared_ptr<const Image> read(const std::string& file);

 private:
  std::filesystem::path inside(const std::string& file) const;
  void require_inside(const std::string& file, const std::filesystem::path& real_path) const;

  std::filesystem::path directory_;
  std::map<std::filesystem::path, std::shared_ptr<const Image>> images_;
  std::int64_t pixels_ = 0;
};

class LightReader {
 public:
  LightReader(ElementReader& reader, const std::filesystem::path& directory)
      : reader_(reader), maps_(directory) {}

  /// Nothing if the element's type is no light, or for one environment too many.
  std::optional<Light> read(pugi::xml_node node);
  /// Counts an environment; false and an error for one too many.
  bool count_environment(pugi::xml_node node);
  /// Reports an error at the scene's element if so many lights and shapes are too many together.
  void check_pairs(pugi::xml_node node, std::size_t lights, std::size_t shapes);

 private:
  ElementReader& reader_;
  EnvironmentMaps maps_;
  std::int64_t environments_ = 0;
};

}  // namespace lobelia
