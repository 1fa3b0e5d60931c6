#include "reference_scenes/engines/blender/blender_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/error.hpp"
#include "reference_scenes/preparation.hpp"
#include "renderer/frame.hpp"
#include "renderer/scene/contact.hpp"

namespace lobelia {
namespace {

constexpr std::uint64_t kMostSeed = 0x7fffffff;  // of Blender
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

std::array<double, 3> numbers(Vec3 v) { return {v.x, v.y, v.z}; }
std::array<double, 3> numbers(Rgb c) { return {c.r, c.g, c.b}; }

BlenderLight light_input(const Lamp& lamp) {
  BlenderLight input;
  if (lamp.is_distant) {
    input.kind = "directional";
    input.direction = numbers(lamp.direction);
    input.irradiance = numbers(lamp.strength);
    return input;
  }
  input.kind = "point";
  input.position = numbers(lamp.position);
  input.intensity = numbers(lamp.strength);
  input.normal = numbers(lamp.normal);
  return input;
}

BlenderMaterial material_input(const Material& material) {
  const Highlight& highlight = material.highlight;
  require_known(kModels, info(highlight.model).name);
  if (highlight.lobe.order == 0) require_known(kLobes, info(highlight.lobe).name);
  return {std::string(info(highlight.model).name),    std::string(info(highlight.lobe).name),
          std::string(name(highlight.normalisation)), highlight.exponent,
          std::string(name(material.fresnel)),        numbers(material.specular_reflectance),
          numbers(material.diffuse_reflectance),      numbers(material.mirror_reflectance)};
}

BlenderPlane plane_input(const Plane& plane) {
  const Tangents along = tangents(plane.normal);
  return {numbers(plane.point), numbers(along.first),   numbers(along.second),
          plane.material,       plane.checker_material, plane.checker_size};
}

std::array<double, 3> vector_of(const Light& light, std::string_view parameter) {
  return numbers(std::get<Vec3>(value_of(light, parameter)));
}

bool is_rectangle(const Light& light) {
  return std::ranges::any_of(written_parameters(light), [](const WrittenParameter& written) {
    return written.parameter.name == "half_u";
  });
}

BlenderLight rectangle_input(const Light& light) {
  BlenderLight input;
  input.kind = "rectangle";
  input.center = vector_of(light, "center");
  input.half_u = vector_of(light, "half_u");
  input.half_v = vector_of(light, "half_v");
  input.radiance = numbers(strength(light));
  return input;
}

BlenderLight sky_input(const Light& light, const std::string& scene) {
  BlenderLight input;
  input.kind = "environment";
  input.radiance = numbers(strength(light));
  if (picture_of(light)) input.file = sky_file(scene);
  return input;
}

/// All but the lights and passes.
BlenderScene common_input(const Scene& scene, const std::string& name) {
  if (std::min(scene.film.width, scene.film.height) < kSmallestSide)
    throw Error(ExitCode::kEngine,
                fmt::format("Blender renders no picture below {0} x {0} pixels", kSmallestSide));
  BlenderScene input;
  input.name = name;
  input.width = scene.film.width;
  input.height = scene.film.height;
  const Camera& camera = scene.camera;
  input.camera = {numbers(camera.origin),
                  numbers(camera.target),
                  numbers(camera.up),
                  camera.fov_degrees,
                  {camera.principal_point_offset_x, camera.principal_point_offset_y}};
  for (const Material& material : scene.materials)
    input.materials.push_back(material_input(material));
  for (const Sphere& sphere : scene.spheres)
    input.spheres.push_back({numbers(sphere.center), sphere.radius, sphere.material});
  for (const Plane& plane : scene.planes) input.planes.push_back(plane_input(plane));
  return input;
}

/// A picture for each light, straight and by each number of mirrors: Cycles would choose at random between
/// a mirror and what it lies on.
std::vector<BlenderPass> passes_of(const Scene& scene) {
  std::vector<BlenderPass> passes;
  for (std::size_t light = 0; light < scene.lights.size(); ++light)
    for (int mirrors = 0; mirrors <= (has_mirror(scene) ? scene.depth.mirror : 0); ++mirrors)
      passes.push_back({light, mirrors});
  return passes;
}

}  // namespace

std::string sky_file(const std::string& scene) { return scene + "-sky.exr"; }

bool is_native_in_blender(const Scene& scene) {
  if (!scene.planes.empty()) return false;
  return std::ranges::all_of(scene.spheres, [&](const Sphere& sphere) {
    const Material& material = scene.materials.at(std::size_t(sphere.material));
    const Highlight& h = material.highlight;
    return info(h.model).angle == LobeAngle::kHalfVector && info(h.lobe).name == "cosine";
  });
}

std::string why_not_for_cycles_transport(const Scene& scene) {
  for (const Light& light : scene.lights)
    if (!is_environment(light) && !is_rectangle(light))
      return "its lights are not all rectangles and skies";
  for (const Material& m : scene.materials)
    if (has_highlight(m) || !is_black(m.mirror_reflectance)) return "a surface is not matt";
  if (scene.depth.mirror > 0 || scene.camera.aperture_radius > 0) return "it has mirrors or a lens";
  if (scene.sampler.seed > kMostSeed) return fmt::format("its seed is above {}", kMostSeed);
  return {};
}

BlenderScene blender_input(const Scene& scene, const std::string& name, bool native) {
  BlenderScene input = common_input(scene, name);
  const Contacts contacts = find_contacts(scene);
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    input.lights.push_back(light_input(lamp_of(scene.lights[l])));
    input.lights.back().lies_on = contacts[l];
  }
  input.native = native;
  input.passes = passes_of(scene);
  return input;
}

BlenderScene cycles_transport_input(const Scene& scene, const std::string& name) {
  BlenderScene input = common_input(scene, name);
  for (const Light& light : scene.lights)
    input.lights.push_back(is_environment(light) ? sky_input(light, name) : rectangle_input(light));
  input.passes = {{}};
  input.transport =
      BlenderTransport{scene.sampler.sample_count, scene.sampler.seed, scene.depth.glossy};
  return input;
}

}  // namespace lobelia
