#include "reference_scenes/formats/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

constexpr SceneFormat kLobeliaFormat{
    "lobelia",
    "Lobelia",
    "scene.xml",
    "Lobelia's own scene file, with every default and lattice written out",
    why_not_so_many_spheres,
    [](const Scene& scene) {
      return std::map<std::string, std::string>{{"scene.xml", scene_to_xml(scene)}};
    },
};

const std::vector<SceneFormat>& all_scene_formats() {
  static const std::vector<SceneFormat> formats{kLobeliaFormat, kJsonFormat, kMitsubaFormat,
                                                kPovrayFormat, kBlenderPythonFormat};
  return formats;
}

}  // namespace

std::string why_not_so_many_spheres(const Scene& scene) {
  if (scene.spheres.size() <= kMaxWrittenSpheres) return {};
  return fmt::format("it has {} spheres, and at most {} are written one by one",
                     scene.spheres.size(), kMaxWrittenSpheres);
}

std::string why_not_spelled_out(const Scene& scene) {
  constexpr std::string_view kKnown[] = {"directional", "point",    "spot",  "sphere",
                                         "rectangle",   "constant", "envmap"};
  for (const Light& light : scene.lights)
    if (std::ranges::find(kKnown, info(light).type) == std::end(kKnown))
      return fmt::format("it has a light of the type {}, which this format does not know",
                         info(light).type);
  return why_not_so_many_spheres(scene);
}

std::span<const SceneFormat> scene_formats() { return all_scene_formats(); }

const SceneFormat& scene_format(std::string_view name) {
  const auto formats = scene_formats();
  const auto found = std::ranges::find(formats, name, &SceneFormat::name);
  if (found != formats.end()) return *found;
  if (name == "gltf-lights")
    throw Error(ExitCode::kUsage,
                "format 'gltf-lights' is gone; use blender-python, and export glTF from Blender");
  std::vector<std::string_view> names;
  for (const SceneFormat& format : formats) names.push_back(format.name);
  throw Error(ExitCode::kUsage, "format '{}' is unknown; allowed: {}{}", printable(name),
              join(names), did_you_mean(name, names));
}

}  // namespace lobelia
