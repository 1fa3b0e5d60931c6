#include "reference_scenes/blender/blender_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/error.hpp"
#include "reference_scenes/preparation.hpp"
#include "renderer/frame.hpp"
#include "renderer/scene/contact.hpp"

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
            {"intensity", to_json(point->intensity)},
            {"normal", to_json(point->normal)}};
  const auto& directional = std::get<DirectionalLight>(light);
  return {{"kind", "directional"},
          {"direction", to_json(directional.direction)},
          {"irradiance", to_json(directional.irradiance)}};
}

Json material_json(const Material& material) {
  const Highlight& highlight = material.highlight;
  require_known(kModels, info(highlight.model).name);
  if (highlight.lobe.order == 0) require_known(kLobes, info(highlight.lobe).name);
  return {{"model", info(highlight.model).name},
          {"lobe", info(highlight.lobe).name},
          {"normalisation", name(highlight.normalisation)},
          {"exponent", highlight.exponent},
          {"fresnel", name(material.fresnel)},
          {"specular", to_json(material.specular_reflectance)},
          {"diffuse", to_json(material.diffuse_reflectance)},
          {"mirror", to_json(material.mirror_reflectance)}};
}

Json plane_json(const Plane& plane) {
  const Tangents along = tangents(plane.normal);
  return {{"point", to_json(plane.point)},
          {"u", to_json(along.first)},
          {"v", to_json(along.second)},
          {"material", plane.material},
          {"checkerMaterial", plane.checker_material},
          {"checkerSize", plane.checker_size}};
}

/// A picture for each light, straight and by each number of mirrors: Cycles would choose at random between
/// a mirror and what it lies on.
Json passes_json(const Scene& scene) {
  Json passes = Json::array();
  for (std::size_t light = 0; light < scene.lights.size(); ++light)
    for (int mirrors = 0; mirrors <= (has_mirror(scene) ? scene.depth.mirror : 0); ++mirrors)
      passes.push_back({{"light", light}, {"mirrors", mirrors}});
  return passes;
}

}  // namespace

bool is_native_in_blender(const Scene& scene) {
  if (!scene.planes.empty()) return false;
  return std::ranges::all_of(scene.spheres, [&](const Sphere& sphere) {
    const Material& material = scene.materials.at(std::size_t(sphere.material));
    const Highlight& h = material.highlight;
    return info(h.model).angle == LobeAngle::kHalfVector && info(h.lobe).name == "cosine";
  });
}

Json blender_input(const Scene& scene, const std::string& name, bool native) {
  if (std::min(scene.film.width, scene.film.height) < kSmallestSide)
    throw Error(ExitCode::kEngine,
                fmt::format("Blender renders no picture below {0} x {0} pixels", kSmallestSide));
  Json lights = Json::array(), materials = Json::array(), spheres = Json::array(),
       planes = Json::array();
  const Contacts contacts = find_contacts(scene);
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    lights.push_back(light_json(scene.lights[l]));
    if (!contacts[l].empty()) lights.back()["liesOn"] = contacts[l];
  }
  for (const Material& material : scene.materials) materials.push_back(material_json(material));
  for (const Sphere& sphere : scene.spheres)
    spheres.push_back({{"center", to_json(sphere.center)},
                       {"radius", sphere.radius},
                       {"material", sphere.material}});
  for (const Plane& plane : scene.planes) planes.push_back(plane_json(plane));
  const Camera& camera = scene.camera;
  return {{"name", name},
          {"width", scene.film.width},
          {"height", scene.film.height},
          {"camera",
           {{"origin", to_json(camera.origin)},
            {"target", to_json(camera.target)},
            {"up", to_json(camera.up)},
            {"fovDegrees", camera.fov_degrees},
            {"offset", {camera.principal_point_offset_x, camera.principal_point_offset_y}}}},
          {"lights", lights},
          {"materials", materials},
          {"spheres", spheres},
          {"planes", planes},
          {"native", native},
          {"passes", passes_json(scene)}};
}

}  // namespace lobelia
