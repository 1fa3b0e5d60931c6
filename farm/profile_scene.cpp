#include "farm/profile_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "renderer/highlight_map.hpp"
#include "renderer/pixel_ray.hpp"

namespace lobelia {
namespace {

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
        const auto hit =
            nearest_hit(scene, frame.origin, normalize(centre_ray(frame, scene.film, x, y)));
        const Vec3 point = hit->point;  // the map has an angle only where there is one
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

  // What the other lights add, by the formula, is taken out of every picture: the curve is of one
  // highlight.
  Scene one_light = scene;
  one_light.lights = {scene.lights[std::size_t(light)]};
  const Image analytic = analytic_image(one_light, sphere);
  std::vector<Image> single;
  if (scene.lights.size() > 1) {
    const Image with_all = analytic_image(scene, sphere);
    for (const auto& [name, image] : images) {
      single.push_back(*image);
      const std::span<float> values = single.back().values();
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] =
            float(double(values[i]) - (double(with_all.values()[i]) - analytic.values()[i]));
    }
  }
  NamedImages all{{kAnalyticName, &analytic}};
  for (std::size_t k = 0; k < images.size(); ++k)
    all.emplace_back(images[k].first, single.empty() ? images[k].second : &single[k]);
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
