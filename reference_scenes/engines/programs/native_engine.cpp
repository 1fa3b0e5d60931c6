#include "reference_scenes/engines/programs/native_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "reference_scenes/persistent_session.hpp"
#include "reference_scenes/preparation.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;

/// Numbers that read back to the same, separated by blanks.
std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += " " + exact_text(value);
  return text;
}

/// One sentence on what these programs cannot express; empty if they can express the scene.
std::string why_not_told(const Scene& scene) {
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

OwnHighlight own_highlight(const NativeEngine& engine, const Material& material) {
  if (!has_highlight(material)) return {};
  OwnHighlight own = engine.own(material.highlight).value_or(OwnHighlight());
  own.strength *= material.specular_reflectance.r;
  return own;
}

/// One picture.
SceneInput input_of(const NativeEngine& engine, const Scene& given, const std::string& name,
                    const ReferenceOptions& options) {
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
    const OwnHighlight own = own_highlight(engine, material);
    const Rgb diffuse = (1 / std::numbers::pi) * material.diffuse_reflectance;
    text += fmt::format(
        "material {}{}\n", own.kind,
        numbers({material.highlight.exponent, own.strength, diffuse.r, diffuse.g, diffuse.b}));
  }
  for (const Sphere& sphere : scene.spheres)
    text += fmt::format("sphere{}{} {}\n", placed(sphere.center), numbers({sphere.radius}),
                        sphere.material);
  for (const Plane& plane : scene.planes)
    text +=
        fmt::format("plane{}{} {}\n", placed(plane.point), turned(plane.normal), plane.material);
  return {name, 1, text + "end\n"};
}

class NativeProgram final : public PersistentProgram {
 public:
  NativeProgram(const NativeEngine& engine, const ReferenceOptions& options)
      : engine_(engine), options_(options) {}
  const EngineInfo& info() const override { return engine_.info; }
  SceneInput input(const Scene& scene, const std::string& name) const override {
    return input_of(engine_, scene, name, options_);
  }
  std::vector<std::string> arguments(const std::string& program, const fs::path&) const override {
    return {program, kFirstFile};
  }
  std::string_view picture_format() const override { return "pfm"; }
  std::string method() const override { return std::string(engine_.method); }

 private:
  const NativeEngine& engine_;
  const ReferenceOptions options_;
};

class Native final : public ProgramEngine {
 public:
  Native(const NativeEngine& engine, const fs::path& program)
      : ProgramEngine(engine.info, engine.probe, program), engine_(engine) {}

 protected:
  std::string why_not_simple(const Scene& scene, const ReferenceOptions& options) const override {
    const std::string_view title = engine_.info.title;
    if (options.shading == Shading::kReimplemented)
      return fmt::format("{} shows its own highlights only", title);
    for (const Material& material : scene.materials)
      if (has_highlight(material) && !engine_.own(material.highlight))
        return fmt::format("{} has no highlight of its own that is {} with {}", title,
                           lobelia::info(material.highlight.model).title,
                           lobelia::info(material.highlight.lobe).title);
    if (std::string why = why_not_told(scene); !why.empty())
      return fmt::format("{} cannot show it: {}", title, why);
    if (engine_.why_not)
      if (std::string why = engine_.why_not(scene); !why.empty())
        return fmt::format("{} cannot show it: {}", title, why);
    return why_not_for_programs(scene);
  }
  std::unique_ptr<SimpleSession> open_simple(const ReferenceOptions& options) override {
    return open_persistent(std::make_unique<NativeProgram>(engine_, options), status(), options);
  }

 private:
  const NativeEngine& engine_;
};

}  // namespace

std::string why_not_one_sphere(const Scene& scene) {
  return scene.spheres.size() == 1 && scene.planes.empty()
             ? ""
             : "it has no shadows here, and shows single spheres";
}

bool has_point_lights(const Scene& scene) {
  return !std::ranges::all_of(scene.lights,
                              [](const Light& light) { return lamp_of(light).is_distant; });
}

std::unique_ptr<Engine> make_native_engine(const NativeEngine& engine, const fs::path& program) {
  return std::make_unique<Native>(engine, program);
}

void keep_native_input(const NativeEngine& engine, const Scene& scene,
                       const ReferenceOptions& options, const fs::path& directory) {
  write_file(directory / PersistentProgram::kFirstFile,
             input_of(engine, scene, "scene0", options).text);
  write_file(
      directory / fmt::format("{}.sh", engine.info.name),
      fmt::format("{} {} < /dev/null\n", engine.probe.program, PersistentProgram::kFirstFile));
}

}  // namespace lobelia
