#include <fmt/format.h>

#include "renderer/lobe_properties.hpp"
#include "renderer/plan/plan.hpp"

namespace lobelia {
namespace {

/// The width in pixels below which a thing may hide between the first samples.
constexpr double kFewestPixels = 4;

}  // namespace

std::string why_every_pixel(const Scene& scene, const Plan& plan) {
  for (const EffectDecision& effect : plan.effects)
    if (effect.on && !effect.hides.empty()) return fmt::format("{}: {}", effect.name, effect.hides);
  if (scene.spheres.size() > kMaxPairwiseSpheres) return "spheres may be smaller than a pixel";
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const double pixel = 2 * frame.half_width / scene.film.width;  // at distance 1
  for (std::size_t k = 0; k < scene.spheres.size(); ++k) {
    const Sphere& sphere = scene.spheres[k];
    const double distance = length(sphere.center - frame.origin);
    if (sphere.radius < kFewestPixels * pixel * distance)
      return fmt::format("sphere {} is only {:.1f} pixels across", k,
                         2 * sphere.radius / (pixel * distance));
    const Highlight& h = scene.materials[std::size_t(sphere.material)].highlight;
    // The turn of the mirror direction from pixel to pixel, twice the normal's, where the sphere faces the camera:
    // but for the silhouette, a highlight looks smallest there.
    const double turn = 2 * pixel * std::max(0.0, distance - sphere.radius) / sphere.radius;
    const double across = 2 * lobe_angle_at(prepare(h.lobe, h.exponent), 0.5) / turn;
    if (across < kFewestPixels)
      return fmt::format("the highlight of sphere {} is only {:.1f} pixels across", k, across);
  }
  return "";
}

PixelRange looked_at(PixelRange pixels, int size, Filter filter) {
  const int reach = reach_of(filter);
  return {std::max(1 - reach, pixels.begin - reach),
          std::min(size + reach - 1, pixels.end + reach)};
}

}  // namespace lobelia
