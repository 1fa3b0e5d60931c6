#include "reference_scenes/camera_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "reference_scenes/preparation.hpp"

namespace lobelia {
namespace {

/// Numbers that read back to the same, separated by blanks.
std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += " " + exact_text(value);
  return text;
}

}  // namespace

std::string why_not_in_camera_scene(const Scene& scene) {
  if (has_mirror(scene)) return "it has no mirrors here";
  for (const Material& material : scene.materials) {
    const Rgb specular = material.specular_reflectance;
    if (material.fresnel != Fresnel::kNone) return "its own highlight has no Fresnel factor";
    if (specular.r != specular.g || specular.g != specular.b)
      return "its own highlight has the colour of the light";
  }
  for (const Light& light : scene.lights)
    if (lamp_of(light).has_normal()) return "its lights shine to all sides";
  for (const Plane& plane : scene.planes)
    if (plane.checker_material != plane.material) return "it has no checkers here";
  return "";
}

std::string why_not_one_sphere(const Scene& scene) {
  return scene.spheres.size() == 1 && scene.planes.empty()
             ? ""
             : "it has no shadows here, and shows single spheres";
}

bool has_point_lights(const Scene& scene) {
  return !std::ranges::all_of(scene.lights,
                              [](const Light& light) { return lamp_of(light).is_distant; });
}

SceneInput camera_scene(const Scene& given, const std::string& name,
                        const ReferenceOptions& options,
                        const std::function<OwnHighlight(const Material&)>& own) {
  const Scene scene = in_engine_units(given);
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  const auto turned = [&](Vec3 v) {
    return numbers({dot(v, frame.right), dot(v, frame.up), dot(v, frame.forward)});
  };
  const auto placed = [&](Vec3 point) { return turned(point - frame.origin); };
  std::string text =
      fmt::format("scene {}\nseconds{}\nfilm {} {}\nwindow{}\n", name,
                  numbers({options.time_limit.count()}), scene.film.width, scene.film.height,
                  numbers({frame.film_u(0), frame.film_u(frame.width), frame.film_v(frame.height),
                           frame.film_v(0)}));
  for (const Light& light : scene.lights) {
    const Lamp lamp = lamp_of(light);
    text += fmt::format("light {}{}{}\n", lamp.is_distant ? "directional" : "point",
                        lamp.is_distant ? turned(-lamp.direction) : placed(lamp.position),
                        numbers({lamp.strength.r, lamp.strength.g, lamp.strength.b}));
  }
  for (const Material& material : scene.materials) {
    const OwnHighlight highlight = has_highlight(material) ? own(material) : OwnHighlight();
    const Rgb diffuse = (1 / std::numbers::pi) * material.diffuse_reflectance;
    text += fmt::format("material {}{}\n", highlight.kind,
                        numbers({material.highlight.exponent, highlight.strength, diffuse.r,
                                 diffuse.g, diffuse.b}));
  }
  for (const Sphere& sphere : scene.spheres)
    text += fmt::format("sphere{}{} {}\n", placed(sphere.center), numbers({sphere.radius}),
                        sphere.material);
  for (const Plane& plane : scene.planes)
    text +=
        fmt::format("plane{}{} {}\n", placed(plane.point), turned(plane.normal), plane.material);
  return {name, 1, text + "end\n"};
}

}  // namespace lobelia
