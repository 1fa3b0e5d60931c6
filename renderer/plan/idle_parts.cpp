#include "renderer/plan/idle_parts.hpp"

#include <algorithm>

namespace lobelia {
namespace {

bool is_black_light(const Light& light) {
  if (is_black(strength(light))) return true;
  const auto* sky = std::get_if<EnvmapLight>(&light);
  return sky && std::ranges::all_of(sky->image->values(), [](float v) { return v == 0; });
}

}  // namespace

std::optional<Scene> without_idle_parts(const Scene& scene) {
  Depth depth = scene.depth;
  // One convex body throws no light on itself.
  if (scene.spheres.size() + scene.planes.size() < 2) depth.glossy = 0;
  if (std::ranges::none_of(scene.materials, is_mirror)) depth.mirror = 0;
  const bool has_black = std::ranges::any_of(scene.lights, is_black_light);
  if (!has_black && depth.glossy == scene.depth.glossy && depth.mirror == scene.depth.mirror)
    return std::nullopt;
  Scene without = scene;
  without.depth = depth;
  std::erase_if(without.lights, is_black_light);
  return without;
}

}  // namespace lobelia
