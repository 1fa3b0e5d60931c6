// The emitters of a scene file.
#pragma once

#include <filesystem>
#include <optional>

#include "renderer/scene/element_reader.hpp"
#include "renderer/scene/environment_map.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

class LightReader {
 public:
  LightReader(ElementReader& reader, const std::filesystem::path& directory)
      : reader_(reader), maps_(directory) {}

  /// None after an error that leaves nothing to go on with.
  std::optional<Light> read(pugi::xml_node node);

 private:
  std::optional<Light> rectangle(pugi::xml_node node, const Values& values);
  std::optional<Light> envmap(const Values& values);

  ElementReader& reader_;
  EnvironmentMaps maps_;
};

}  // namespace lobelia
