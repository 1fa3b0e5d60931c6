#include "reference_scenes/povray/povray_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "reference_scenes/preparation.hpp"
#include "renderer/peak_bound.hpp"
#include "shaders/povray.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view lobelia_scene_inc;
}
namespace {

/// The largest half float is 65504; half of it leaves room for the bound's own rounding.
constexpr double kHighestHalf = 3e4;
/// Keeps lamp colours, which POV-Ray has in float32, within its range.
constexpr int kMaxGainStops = 60;

std::string sdl(double value) { return exact_text(value); }
std::string sdl(Vec3 v) { return fmt::format("<{}, {}, {}>", sdl(v.x), sdl(v.y), sdl(v.z)); }
std::string sdl(Rgb c) { return fmt::format("<{}, {}, {}>", sdl(c.r), sdl(c.g), sdl(c.b)); }

bool is_grey(Rgb c) { return c.r == c.g && c.g == c.b; }

/// POV-Ray's highlights are these two with the lobe cos^n, in the colour of the lamp. (Of these two
/// the paper prints the exact coefficient.) They have no Fresnel factor.
bool is_native(const Material& material) {
  const std::string_view model = info(material.highlight.model).name;
  return (model == "phong_rdf" || model == "blinn_phong_rdf") &&
         info(material.highlight.lobe).name == "cosine" && material.fresnel == Fresnel::kNone &&
         is_grey(material.specular_reflectance);
}

std::string light_text(const Light& light, const Scene& scene) {
  if (const auto* point = std::get_if<PointLight>(&light))
    return fmt::format("Lobelia_Point_Light({}, {}, {})\n", sdl(point->position),
                       sdl(point->intensity), sdl(nearest_surface(*point, scene.spheres)));
  const auto& directional = std::get<DirectionalLight>(light);
  return fmt::format("Lobelia_Directional_Light({}, {}, {})\n", sdl(directional.direction),
                     sdl(directional.irradiance), sdl(1000 * extent(scene)));
}

std::string native_sphere_text(const Sphere& sphere, const Material& material) {
  const bool phong = info(material.highlight.model).angle == LobeAngle::kReflection;
  return fmt::format("Lobelia_Native_Sphere({}, {}, {}, {}, {}, {})\n", sdl(sphere.center),
                     sdl(sphere.radius), phong ? "Lobelia_Native_Phong" : "Lobelia_Native_Specular",
                     sdl(material.highlight.exponent), sdl(material.specular_reflectance.r),
                     sdl(material.diffuse_reflectance));
}

std::string sphere_text(const Sphere& sphere, const Material& material) {
  const PovrayNames names = povray_names(material.highlight);
  const std::string exponent = sdl(material.highlight.exponent);
  return fmt::format("Lobelia_Sphere({}, {}, {}, {}({}), {}, {}, {}, {}, {})\n", sdl(sphere.center),
                     sdl(sphere.radius), names.pattern, names.coefficient, exponent, exponent,
                     names.brilliance, material.fresnel == Fresnel::kSchlick ? 1 : 0,
                     sdl(material.specular_reflectance), sdl(material.diffuse_reflectance));
}

PovrayPass pass_of(const Scene& scene, const std::vector<Light>& lights, const PovrayInput& input) {
  PovrayPass pass;
  const double bound = peak_bound(scene, lights);
  if (bound > 0)
    pass.gain = std::exp2(std::clamp(std::floor(std::log2(kHighestHalf / bound)),
                                     -double(kMaxGainStops), double(kMaxGainStops)));
  // What is not said in the scene itself would be rounded to six digits by the command line.
  pass.scene = "#version 3.7;\n";
  for (const auto& include : input.includes)
    pass.scene += fmt::format("#include \"{}\"\n", include.first);
  pass.scene += fmt::format("Lobelia_Begin({})\n", sdl(pass.gain));
  pass.scene += fmt::format("Lobelia_Camera({}, {}, {}, {}, {}/{})\n", sdl(scene.camera.origin),
                            sdl(scene.camera.target), sdl(scene.camera.up),
                            sdl(scene.camera.fov_degrees), scene.film.width, scene.film.height);
  for (const Light& light : lights) pass.scene += light_text(light, scene);
  for (const Sphere& sphere : scene.spheres) {
    const Material& material = scene.materials.at(std::size_t(sphere.material));
    pass.scene +=
        input.native ? native_sphere_text(sphere, material) : sphere_text(sphere, material);
  }
  return pass;
}

}  // namespace

PovrayInput povray_input(const Scene& scene) {
  PovrayInput input;
  input.native = std::ranges::all_of(scene.spheres, [&](const Sphere& sphere) {
    return is_native(scene.materials.at(std::size_t(sphere.material)));
  });
  input.includes["lobelia_scene.inc"] = embedded::lobelia_scene_inc;
  if (input.native) {
    input.passes.push_back(pass_of(scene, scene.lights, input));
    return input;
  }
  for (const Sphere& sphere : scene.spheres) {
    const Highlight& highlight = scene.materials.at(std::size_t(sphere.material)).highlight;
    input.includes[povray_names(highlight).file] = povray_text(std::span(&highlight, 1));
  }
  for (const Light& light : scene.lights) input.passes.push_back(pass_of(scene, {light}, input));
  return input;
}

}  // namespace lobelia
