#include "renderer/highlight_map.hpp"

#include <cmath>
#include <limits>

#include "renderer/pixel_ray.hpp"

namespace lobelia {
namespace {

/// The angle between unit vectors, without the cancellation of acos near 0.
double angle_between(Vec3 a, Vec3 b) { return 2 * std::atan2(length(a - b), length(a + b)); }

}  // namespace

HighlightMap highlight_map(const Scene& scene, int light, int sphere) {
  require_single_rays(scene, "the angles of a highlight");
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const int width = scene.film.width, height = scene.film.height;
  const std::size_t pixels = std::size_t(width) * height;
  const double nowhere = std::numeric_limits<double>::quiet_NaN();
  HighlightMap map{width, height, std::vector(pixels, nowhere), std::vector(pixels, nowhere),
                   std::vector(pixels, 0.0)};
  const Material& material = scene.materials.at(scene.spheres.at(sphere).material);
  const LobeAngle lobe_angle = info(material.highlight.model).angle;
  const double pixel_area = 4 * frame.half_width * frame.half_height / double(pixels);

  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = std::size_t(y) * width + x;
      const Vec3 ray = centre_ray(frame, x, y);
      const double distance = length(ray);
      map.solid_angle[i] = pixel_area / (distance * distance * distance);
      const Vec3 direction = normalize(ray);
      const auto hit = nearest_hit(scene, frame.origin, direction);
      if (!hit || hit->sphere != sphere) continue;
      const Vec3 to_light = illuminate(scene.lights.at(light), hit->point).to_light;
      const double n_dot_l = dot(hit->normal, to_light);
      if (!(n_dot_l > 0)) continue;
      const Vec3 to_eye = -direction;
      map.n_dot_l[i] = n_dot_l;
      map.angle[i] =
          lobe_angle == LobeAngle::kReflection
              ? angle_between(2 * dot(hit->normal, to_eye) * hit->normal - to_eye, to_light)
              : angle_between(hit->normal, normalize(to_light + to_eye));
    }
  return map;
}

}  // namespace lobelia
