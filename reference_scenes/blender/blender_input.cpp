#include "reference_scenes/blender/blender_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/error.hpp"

namespace lobelia {
namespace {

constexpr int kSmallestSide = 4;  // Blender's own limit; it would render a larger picture instead

/// What render_scenes.py has formulas for, besides cs_k for every k.
constexpr std::string_view kModels[] = {"phong_rdf",       "modified_phong",
                                        "blinn_phong_rdf", "modified_blinn_phong",
                                        "blinn_phong_ndf", "blinn_phong_heightfield"};
constexpr std::string_view kLobes[] = {"cosine", "spherical_gaussian", "gauss", "schlick"};

void require_known(std::span<const std::string_view> known, std::string_view name) {
  if (std::ranges::find(known, name) == known.end())
    throw Error(ExitCode::kEngine,
                fmt::format("render_scenes.py has no '{}' for Blender to render", name));
}

Json light_json(const Light& light) {
  if (const auto* point = std::get_if<PointLight>(&light))
    return {{"kind", "point"},
            {"position", to_json(point->position)},
            {"intensity", to_json(point->intensity)}};
  const auto& directional = std::get<DirectionalLight>(light);
  return {{"kind", "directional"},
          {"direction", to_json(directional.direction)},
          {"irradiance", to_json(directional.irradiance)}};
}

Json sphere_json(const Sphere& sphere, const Material& material) {
  const Highlight& highlight = material.highlight;
  require_known(kModels, info(highlight.model).name);
  if (highlight.lobe.order == 0) require_known(kLobes, info(highlight.lobe).name);
  return {{"center", to_json(sphere.center)},
          {"radius", sphere.radius},
          {"model", info(highlight.model).name},
          {"lobe", info(highlight.lobe).name},
          {"normalisation", name(highlight.normalisation)},
          {"exponent", highlight.exponent},
          {"fresnel", name(material.fresnel)},
          {"specular", to_json(material.specular_reflectance)},
          {"diffuse", to_json(material.diffuse_reflectance)}};
}

}  // namespace

Json blender_input(const Scene& scene, const std::string& name) {
  if (std::min(scene.film.width, scene.film.height) < kSmallestSide)
    throw Error(ExitCode::kEngine,
                fmt::format("Blender renders no picture below {0} x {0} pixels", kSmallestSide));
  Json lights = Json::array(), spheres = Json::array();
  for (const Light& light : scene.lights) lights.push_back(light_json(light));
  for (const Sphere& sphere : scene.spheres)
    spheres.push_back(sphere_json(sphere, scene.materials.at(std::size_t(sphere.material))));
  return {{"name", name},
          {"width", scene.film.width},
          {"height", scene.film.height},
          {"camera",
           {{"origin", to_json(scene.camera.origin)},
            {"target", to_json(scene.camera.target)},
            {"up", to_json(scene.camera.up)},
            {"fovDegrees", scene.camera.fov_degrees}}},
          {"lights", lights},
          {"spheres", spheres}};
}

}  // namespace lobelia
