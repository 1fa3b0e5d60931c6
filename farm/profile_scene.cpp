#include "farm/profile_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "renderer/highlight_map.hpp"

namespace lobelia {
namespace {

/// Where the ray through the centre of pixel (x, y) meets the sphere, which it is known to meet.
Vec3 point_on_sphere(const CameraFrame& frame, const Film& film, int x, int y,
                     const Sphere& sphere) {
  const double u = (2 * (x + 0.5) / film.width - 1) * frame.half_width;
  const double v = (1 - 2 * (y + 0.5) / film.height) * frame.half_height;
  const Vec3 direction = normalize(frame.forward + u * frame.right + v * frame.up);
  const Vec3 to_center = sphere.center - frame.origin;
  const double along = dot(to_center, direction);
  const Vec3 off_axis = to_center - along * direction;
  const double half_chord =
      std::sqrt(std::max(0.0, sphere.radius * sphere.radius - dot(off_axis, off_axis)));
  return frame.origin + (along - half_chord) * direction;
}

/// 1 - cos(angle), without the cancellation near 0.
double one_minus_cos(double angle) {
  const double half_sine = std::sin(angle / 2);
  return 2 * half_sine * half_sine;
}

void require_index(const char* what, int index, std::size_t count) {
  if (index < 0 || std::size_t(index) >= count)
    throw Error(ExitCode::kInput,
                count == 0 ? fmt::format("the scene has no {}", what)
                           : fmt::format("the scene has no {} {}: they are counted from 0 to {}",
                                         what, index, count - 1));
}

}  // namespace

Image analytic_image(const Scene& scene, int sphere_index) {
  const Sphere& sphere = scene.spheres.at(std::size_t(sphere_index));
  const Material& material = scene.materials.at(std::size_t(sphere.material));
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const int width = scene.film.width, height = scene.film.height;
  std::vector<Rgb> radiance(std::size_t(width) * std::size_t(height));
  for (std::size_t light = 0; light < scene.lights.size(); ++light) {
    const HighlightMap map = highlight_map(scene, int(light), sphere_index);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
        if (std::isnan(map.angle[i])) continue;
        const Vec3 point = point_on_sphere(frame, scene.film, x, y, sphere);
        const Rgb irradiance = illuminate(scene.lights[light], point).irradiance;
        const double specular =
            highlight_radiance(material.highlight, map.n_dot_l[i], one_minus_cos(map.angle[i]));
        const double diffuse = map.n_dot_l[i] / std::numbers::pi;
        radiance[i] = radiance[i] + irradiance * (specular * material.specular_reflectance +
                                                  diffuse * material.diffuse_reflectance);
      }
  }
  Image image(width, height);
  const std::span<float> values = image.values();
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    values[3 * i] = float(radiance[i].r);
    values[3 * i + 1] = float(radiance[i].g);
    values[3 * i + 2] = float(radiance[i].b);
  }
  return image;
}

double lobe_angle_at(const Highlight& highlight, double value) {
  const bool reflection = info(highlight.model).angle == LobeAngle::kReflection;
  double inside = 0, outside = reflection ? std::numbers::pi : std::numbers::pi / 2;
  const auto lobe = [&](double angle) {
    return lobe_value(highlight.lobe, one_minus_cos(angle), highlight.exponent);
  };
  if (lobe(outside) > value) return outside;
  // Each step halves the interval; 64 use up a double.
  for (int step = 0; step < 64; ++step) {
    const double middle = (inside + outside) / 2;
    (lobe(middle) > value ? inside : outside) = middle;
  }
  return outside;
}

Json profile_scene(const Scene& scene, int light, int sphere, const NamedImages& images) {
  require_index("light", light, scene.lights.size());
  require_index("sphere", sphere, scene.spheres.size());
  for (const auto& [name, image] : images)
    if (image->width() != scene.film.width || image->height() != scene.film.height)
      throw Error(ExitCode::kInput, fmt::format("{} has {} x {} pixels, the scene's film {} x {}",
                                                name, image->width(), image->height(),
                                                scene.film.width, scene.film.height));

  const Image analytic = analytic_image(scene, sphere);
  NamedImages all{{kAnalyticName, &analytic}};
  all.insert(all.end(), images.begin(), images.end());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t k = 2; k < all.size(); ++k) pairs.emplace_back(1, k);
  for (std::size_t k = 1; k < all.size(); ++k) pairs.emplace_back(k, 0);

  const int material = scene.spheres[std::size_t(sphere)].material;
  const Highlight& highlight = scene.materials.at(std::size_t(material)).highlight;
  const HighlightMap map = highlight_map(scene, light, sphere);
  const Profile profile =
      measure_profile({map.angle, map.solid_angle, lobe_angle_at(highlight, kEpicentreLobe),
                       lobe_angle_at(highlight, kBloomingLobe)},
                      all, pairs);
  const bool reflection = info(highlight.model).angle == LobeAngle::kReflection;
  return profile_record(profile, light, sphere, reflection ? "reflection" : "half_vector");
}

}  // namespace lobelia
