#include "renderer/edge_map.hpp"

#include <algorithm>

#include "renderer/pixel_ray.hpp"

namespace lobelia {
namespace {

/// What decides a pixel's shading but for smooth change.
struct Situation {
  int sphere = -1;
  std::uint64_t lit_by = 0;  ///< a bit for each light (a scene has at most 64)
  friend bool operator==(const Situation&, const Situation&) = default;
};

Situation situation_of(const Scene& scene, const CameraFrame& frame, int x, int y) {
  const Vec3 direction = normalize(centre_ray(frame, x, y));
  const auto hit = nearest_hit(scene, frame.origin, direction);
  if (!hit) return {};
  Situation situation{hit->sphere, 0};
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    const Illumination light = illuminate(scene.lights[l], hit->point);
    if (dot(hit->normal, light.to_light) > 0 && !is_shadowed(scene, *hit, light))
      situation.lit_by |= std::uint64_t{1} << l;
  }
  return situation;
}

}  // namespace

std::vector<std::uint8_t> edge_map(const Scene& scene) {
  require_single_rays(scene, "silhouettes, terminators and shadow edges");
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const int width = scene.film.width, height = scene.film.height;
  std::vector<Situation> situations;
  situations.reserve(std::size_t(width) * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) situations.push_back(situation_of(scene, frame, x, y));

  std::vector<std::uint8_t> edges(situations.size(), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t here = std::size_t(y) * width + x;
      for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u)
          if (situations[std::size_t(v) * width + u] != situations[here]) edges[here] = 1;
    }
  return edges;
}

}  // namespace lobelia
