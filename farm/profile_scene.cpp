#include "farm/profile_scene.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "renderer/highlight_map.hpp"
#include "renderer/lobe_properties.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/reflector.hpp"

namespace lobelia {
namespace {

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
  const Reflector reflector(scene.materials.at(std::size_t(sphere.material)));
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  Image image(scene.film.width, scene.film.height);
  for (int y = 0; y < scene.film.height; ++y)
    for (int x = 0; x < scene.film.width; ++x) {
      const Vec3 ray = normalize(centre_ray(frame, x, y));
      const auto hit = nearest_hit(scene, frame.origin, ray);
      if (!hit || hit->sphere != sphere_index) continue;
      Rgb radiance;
      for (const Light& light : scene.lights) {
        const Illumination here = illuminate(light, hit->point);
        radiance = radiance + here.irradiance * reflector.eval(hit->normal, -ray, here.to_light);
      }
      const auto pixel = image.pixel(x, y);
      pixel[0] = float(radiance.r), pixel[1] = float(radiance.g), pixel[2] = float(radiance.b);
    }
  return image;
}

Json profile_scene(const Scene& scene, int light, int sphere, const NamedImages& images) {
  require_index("light", light, scene.lights.size());
  require_index("sphere", sphere, scene.spheres.size());
  if (!is_delta(scene.lights[std::size_t(light)]))
    throw Error(ExitCode::kInput,
                fmt::format("light {} is an area or an environment; a highlight's profile is of a "
                            "directional or a point light",
                            light));
  require_single_rays(scene, "a highlight's profile");
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
  const PreparedLobe lobe = prepare(highlight.lobe, highlight.exponent);
  const HighlightMap map = highlight_map(scene, light, sphere);
  const Profile profile =
      measure_profile({map.angle, map.solid_angle, lobe_angle_at(lobe, kEpicentreLobe),
                       lobe_angle_at(lobe, kBloomingLobe)},
                      all, pairs);
  const bool reflection = info(highlight.model).angle == LobeAngle::kReflection;
  return profile_record(profile, light, sphere, reflection ? "reflection" : "half_vector");
}

}  // namespace lobelia
