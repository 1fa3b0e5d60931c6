#include "farm/pixel_means.hpp"

#include <numbers>

#include "renderer/chord.hpp"

namespace lobelia {

PixelMeans::PixelMeans(const Scene& scene, int sphere, bool of_means)
    : scene_(scene),
      sphere_(sphere),
      frame_(camera_frame(scene.camera, scene.film)),
      reflector_(scene.materials.at(std::size_t(scene.spheres.at(std::size_t(sphere)).material))),
      nodes_(of_means ? filter_nodes(scene.film.filter)
                      : std::vector<FilterNode>{{.x = 0, .y = 0, .weight = 1}}),
      reach_(of_means ? scene.film.filter.radius : 0) {}

std::optional<PixelMeans::Seen> PixelMeans::at(std::size_t pixel, double x, double y) const {
  const auto width = std::size_t(scene_.film.width);
  const Vec3 direction =
      normalize(film_ray(frame_, double(pixel % width) + 0.5 + x, double(pixel / width) + 0.5 + y));
  // Most places miss this sphere and need no test of the others.
  const Sphere& wanted = scene_.spheres[std::size_t(sphere_)];
  if (!(chord_of(wanted, frame_.origin, direction).half_squared > 0)) return std::nullopt;
  const auto hit = nearest_hit(scene_, frame_.origin, direction);
  if (!hit || hit->sphere != sphere_) return std::nullopt;
  return Seen{*hit, -direction};
}

bool PixelMeans::is_whole(std::size_t pixel, int light) const {
  const auto is_lit = [&](double x, double y) {
    const auto seen = at(pixel, x, y);
    return seen && light_at(scene_, light, seen->hit);
  };
  return is_lit(0, 0) && (reach_ == 0 || (is_lit(-reach_, -reach_) && is_lit(reach_, -reach_) &&
                                          is_lit(-reach_, reach_) && is_lit(reach_, reach_)));
}

PixelMean PixelMeans::highlight(std::size_t pixel, int light) const {
  PixelMean mean;
  if (!is_whole(pixel, light)) return mean;
  for (const FilterNode& node : nodes_) {
    const auto seen = at(pixel, node.x, node.y);
    const auto place = seen ? highlight_at(scene_, light, seen->hit, seen->to_eye) : std::nullopt;
    if (!place) return {};
    mean.nodes.push_back({node.weight, place->reflection, place->half_vector, place->n_dot_l,
                          place->n_dot_v, place->irradiance});
    mean.of_lobe.push_back({place->angle, node.weight * place->scale});
  }
  return mean;
}

double PixelMeans::diffuse(std::size_t pixel, int light) const {
  const Rgb albedo = scene_.materials[std::size_t(scene_.spheres[std::size_t(sphere_)].material)]
                         .diffuse_reflectance;
  if (is_black(albedo)) return 0;
  double sum = 0;
  for (const FilterNode& node : nodes_) {
    const auto seen = at(pixel, node.x, node.y);
    const auto here = seen ? light_at(scene_, light, seen->hit) : std::nullopt;
    if (!here) continue;
    const Rgb reflected = here->irradiance * albedo;
    sum += node.weight * dot(seen->hit.normal, here->to_light) * std::numbers::inv_pi *
           (reflected.r + reflected.g + reflected.b) / 3;
  }
  return sum;
}

Rgb PixelMeans::radiance(std::size_t pixel, std::optional<int> light) const {
  Rgb sum;
  for (const FilterNode& node : nodes_) {
    const auto seen = at(pixel, node.x, node.y);
    if (!seen) continue;
    for (int k = light.value_or(0); k < (light ? *light + 1 : int(scene_.lights.size())); ++k)
      if (const auto here = light_at(scene_, k, seen->hit))
        sum = sum + node.weight * (here->irradiance *
                                   reflector_.eval(seen->hit.normal, seen->to_eye, here->to_light));
  }
  return sum;
}

}  // namespace lobelia
