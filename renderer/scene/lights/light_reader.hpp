// The emitters of a scene file, read by the tables of the lights.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "renderer/scene/element_reader.hpp"
#include "renderer/scene/environment_map.hpp"
#include "renderer/scene/lights/lights.hpp"

namespace lobelia {

class LightReader {
 public:
  LightReader(ElementReader& reader, const std::filesystem::path& directory)
      : reader_(reader), maps_(directory) {}

  /// None where the element's type is no light.
  std::optional<Light> read(pugi::xml_node node);

 private:
  ElementReader& reader_;
  EnvironmentMaps maps_;
};

}  // namespace lobelia
