#include "renderer/highlight_map.hpp"

#include <cmath>
#include <limits>
#include <optional>

namespace lobelia {
namespace {

struct Hit {
  int sphere;
  Vec3 point, normal;
};

/// The nearest sphere along a ray: one ray at a time, apart from the kernels on purpose, so that the
/// profiles are measured by other code than the picture was made by.
std::optional<Hit> nearest_hit(const Scene& scene, Vec3 origin, Vec3 direction) {
  std::optional<Hit> nearest;
  double nearest_t = std::numeric_limits<double>::infinity();
  for (int k = 0; k < int(scene.spheres.size()); ++k) {
    const Sphere& sphere = scene.spheres[k];
    const Vec3 to_center = sphere.center - origin;
    const double along = dot(to_center, direction);
    const Vec3 off_axis = to_center - along * direction;
    const double squared = sphere.radius * sphere.radius - dot(off_axis, off_axis);
    if (!(squared > 0)) continue;
    const double t = along - std::sqrt(squared);
    if (!(t > 0 && t < nearest_t)) continue;
    nearest_t = t;
    const Vec3 normal = normalize(-(off_axis + std::sqrt(squared) * direction));
    nearest = Hit{k, sphere.center + sphere.radius * normal, normal};
  }
  return nearest;
}

/// The angle between unit vectors, without the cancellation of acos near 0.
double angle_between(Vec3 a, Vec3 b) { return 2 * std::atan2(length(a - b), length(a + b)); }

}  // namespace

HighlightMap highlight_map(const Scene& scene, int light, int sphere) {
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
      const double u = (2 * (x + 0.5) / width - 1) * frame.half_width;
      const double v = (1 - 2 * (y + 0.5) / height) * frame.half_height;
      const Vec3 ray = frame.forward + u * frame.right + v * frame.up;
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
