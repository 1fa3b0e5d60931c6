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
  const std::vector nowhere(pixels, std::numeric_limits<double>::quiet_NaN());
  HighlightMap map{width, height, nowhere, nowhere, nowhere, std::vector(pixels, 0.0)};
  const Material& material = scene.materials.at(scene.spheres.at(sphere).material);
  const LobeAngle lobe_angle = info(material.highlight.model).angle;
  const double pixel_area = 4 * frame.half_width * frame.half_height / double(pixels);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double distance = length(centre_ray(frame, x, y));
      map.solid_angle[std::size_t(y) * width + x] = pixel_area / (distance * distance * distance);
    }

  for_each_pixel_of(scene, sphere, [&](std::size_t i, const Hit& hit, Vec3 to_eye) {
    const auto here = light_at(scene, light, hit);
    if (!here) return;
    const Vec3 to_light = here->to_light;
    map.n_dot_l[i] = dot(hit.normal, to_light);
    const Rgb reflected =
        here->irradiance *
        fresnel_factor(material.fresnel, material.specular_reflectance, to_eye, to_light);
    map.scale[i] = foreshortening(material.highlight.model, map.n_dot_l[i]) *
                   (reflected.r + reflected.g + reflected.b) / 3;
    map.angle[i] = lobe_angle == LobeAngle::kReflection
                       ? angle_between(2 * dot(hit.normal, to_eye) * hit.normal - to_eye, to_light)
                       : angle_between(hit.normal, normalize(to_light + to_eye));
  });
  return map;
}

}  // namespace lobelia
