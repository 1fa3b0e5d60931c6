// The parts of a scene that cannot change its picture.
#pragma once

#include <optional>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// The scene without its black lights, and without the depth of reflections that no surface gives; none if it has no such
/// part. Lights that follow a black one get its place, and with it its random numbers.
std::optional<Scene> without_idle_parts(const Scene& scene);

}  // namespace lobelia
