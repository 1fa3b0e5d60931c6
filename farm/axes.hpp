// The axes that a grid may have: how a value is written and what it does to a scene. A new axis is an entry in axes.cpp.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "renderer/scene/scene.hpp"

namespace lobelia {

struct AxisValue {
  std::string value;  ///< as in the grid file: "cs16:paper"
  std::string label;  ///< for people: "cs16, paper"
  /// For file names, of [A-Za-z0-9_.+-] without '.' or '-' in front: "cs16_paper".
  std::string token;
  std::function<void(Scene&)> apply = {};   ///< null where it changes nothing; for any thread
  std::shared_ptr<const Scene> scene = {};  ///< in place of the grid's, before any apply; or null
};

struct AxisKind {
  std::string_view name;
  std::string_view allowed;  ///< of a value, in words
  /// Files are looked for in `directory`. Throws std::runtime_error without place or file.
  AxisValue (*parse)(const std::string& text, const std::filesystem::path& directory);
};

std::span<const AxisKind> axis_kinds();

/// A sentence if a light of the scene is in a picture file, which a cell cannot have; otherwise empty.
std::string picture_of(const Scene& scene);

}  // namespace lobelia
