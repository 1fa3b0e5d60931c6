#include "reference_scenes/engines/blender/blender.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/pictures/image_io.hpp"
#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/system/removal.hpp"
#include "base/words/text.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/preparation.hpp"
#include "renderer/formula.hpp"
#include "renderer/frame.hpp"
#include "renderer/scene/contact.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view render_scenes_py, blender_formulas_py, blender_surfaces_py,
    blender_scene_py;
}
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr char kScriptFile[] = "render_scenes.py", kJobFile[] = "job.json";
constexpr std::uint64_t kMostSeed = 0x7fffffff;  // in Blender
constexpr int kSmallestSide = 4;  // in Blender, which would render a larger picture instead

/// Throws unless the script's tables of models and lobes, which are keyed by name, have this one.
void require_formula(std::string_view name) {
  if (embedded::blender_formulas_py.find(fmt::format("\n    \"{}\": ", name)) ==
      std::string_view::npos)
    throw Error(ExitCode::kEngine, "blender_formulas.py has no '{}' for Blender to render", name);
}

Json json(Vec3 v) { return {v.x, v.y, v.z}; }
Json json(Rgb c) { return {c.r, c.g, c.b}; }

Json light_json(const Lamp& lamp) {
  if (lamp.is_distant)
    return {{"kind", "directional"},
            {"direction", json(lamp.direction)},
            {"irradiance", json(lamp.strength)}};
  Json light{{"kind", "point"},
             {"position", json(lamp.position)},
             {"intensity", json(lamp.strength)},
             {"normal", json(lamp.normal)}};
  if (lamp.spot) light["spot"] = {lamp.spot->least_cosine(), lamp.spot->cosine_step()};
  return light;
}

/// A formula as the script reads it: a number, a name, or a list of an operation and its operands.
Json formula_json(const Formula& formula) {
  std::vector<Json> trees;
  for (const Formula::Node& node : formula.nodes()) {
    const int operands = operand_count(node.operation);
    Json tree(node.operation == Operation::kNegate ? "negate" : symbol(node.operation));
    if (node.operation == Operation::kNumber) tree = node.number;
    if (operands > 0) tree = Json::array({tree, std::move(trees[node.left])});
    if (operands > 1) tree.push_back(std::move(trees[node.right]));
    trees.push_back(std::move(tree));
  }
  return std::move(trees.back());
}

Json material_json(const Material& material) {
  const Highlight& highlight = material.highlight;
  const std::string model(info(highlight.model).name), lobe(info(highlight.lobe).name);
  require_formula(model);
  require_formula(family(highlight.lobe));
  Json result{{"model", model},
              {"lobe", lobe},
              {"normalisation", name(highlight.normalisation)},
              {"exponent", highlight.exponent},
              {"fresnel", name(material.fresnel)},
              {"specular", json(material.specular_reflectance)},
              {"diffuse", json(material.diffuse_reflectance)},
              {"mirror", json(material.mirror_reflectance)}};
  if (highlight.lobe.formula) result["formula"] = formula_json(*highlight.lobe.formula);
  return result;
}

Json plane_json(const Plane& plane) {
  const Tangents along = tangents(plane.normal);
  return {{"point", json(plane.point)},
          {"u", json(along.first)},
          {"v", json(along.second)},
          {"material", plane.material},
          {"checkerMaterial", plane.checker_material},
          {"checkerSize", plane.checker_size}};
}

bool is_rectangle(const Light& light) {
  return std::ranges::any_of(written_parameters(light), [](const WrittenParameter& written) {
    return written.parameter.name == "half_u";
  });
}

Json rectangle_json(const Light& light) {
  const auto vector = [&](const char* name) { return json(std::get<Vec3>(value_of(light, name))); };
  return {{"kind", "rectangle"},
          {"center", vector("center")},
          {"halfU", vector("half_u")},
          {"halfV", vector("half_v")},
          {"radiance", json(strength(light))}};
}

/// The file with the sky's picture, beside the job.
std::string sky_file(const std::string& scene) { return scene + "-sky.exr"; }

Json sky_json(const Light& light, const std::string& scene) {
  Json sky{{"kind", "environment"}, {"radiance", json(strength(light))}};
  if (picture_of(light)) sky["file"] = sky_file(scene);
  return sky;
}

/// Everything except lights and passes.
Json scene_json(const Scene& scene, const std::string& name) {
  if (std::min(scene.film.width, scene.film.height) < kSmallestSide)
    throw Error(ExitCode::kEngine, "Blender renders no picture below {0} x {0} pixels",
                kSmallestSide);
  const Camera& camera = scene.camera;
  Json result{{"name", name},
              {"width", scene.film.width},
              {"height", scene.film.height},
              {"camera",
               {{"origin", json(camera.origin)},
                {"target", json(camera.target)},
                {"up", json(camera.up)},
                {"fovDegrees", camera.fov_degrees},
                {"offset", {camera.principal_point_offset_x, camera.principal_point_offset_y}}}}};
  for (const char* list : {"lights", "materials", "spheres", "planes"})
    result[list] = Json::array();
  for (const Material& material : scene.materials)
    result["materials"].push_back(material_json(material));
  for (const Sphere& sphere : scene.spheres)
    result["spheres"].push_back({{"center", json(sphere.center)},
                                 {"radius", sphere.radius},
                                 {"material", sphere.material}});
  for (const Plane& plane : scene.planes) result["planes"].push_back(plane_json(plane));
  return result;
}

/// A picture for each light and each number of mirrors, because Cycles chooses at random between a mirror and its base.
Json passes_json(const Scene& scene) {
  Json passes = Json::array();
  for (std::size_t light = 0; light < scene.lights.size(); ++light)
    for (int mirrors = 0; mirrors <= (has_mirror(scene) ? scene.depth.mirror : 0); ++mirrors)
      passes.push_back({{"light", light}, {"mirrors", mirrors}});
  return passes;
}

/// Whether Cycles' own closure can shade all highlights.
bool is_native_in_blender(const Scene& scene) {
  if (!scene.planes.empty()) return false;
  return std::ranges::all_of(scene.spheres, [&](const Sphere& sphere) {
    const Material& material = scene.materials.at(std::size_t(sphere.material));
    const Highlight& h = material.highlight;
    const std::string_view lobe = info(h.lobe).name;
    return info(h.model).angle == LobeAngle::kHalfVector && (lobe == "cosine" || lobe == "ggx");
  });
}

/// Why Cycles' own light transport cannot show a scene, as a sentence; empty if it can.
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

SceneInput cycles_transport_input(const Scene& scene, const std::string& name) {
  Json input = scene_json(scene, name);
  for (const Light& light : scene.lights)
    input["lights"].push_back(is_environment(light) ? sky_json(light, name)
                                                    : rectangle_json(light));
  input["passes"] = {{{"light", 0}, {"mirrors", 0}}};
  input["transport"] = {{"samples", scene.sampler.sample_count},
                        {"seed", scene.sampler.seed},
                        {"bounces", scene.depth.glossy}};
  return {name, 1, input.dump()};
}

/// The job that a process starts with. With `go_on` it asks for more scenes afterwards.
std::string blender_job(int threads, const ReferenceOptions& options, const SceneInput& scene,
                        bool go_on) {
  Json job{{"threads", threads},
           {"secondsPerScene", options.time_limit.count()},
           {"scenes", Json::array({Json::parse(scene.text)})}};
  if (go_on) job["goOn"] = true;
  return job.dump(go_on ? -1 : 2) + "\n";
}

/// Runs render_scenes.py without the user's start-up file and add-ons; failures in Python end Blender. `directory` holds
/// scripts and job. It is spelled out because Blender trusts $PWD more than its working directory.
std::vector<std::string> blender_arguments(const std::string& program, const fs::path& directory) {
  return {program,
          "-b",
          "--factory-startup",
          "-noaudio",
          "--python-exit-code",
          "9",
          "--python",
          (directory / kScriptFile).string(),
          "--",
          (directory / kJobFile).string()};
}

/// Writes render_scenes.py and the modules that it imports.
void write_blender_scripts(const fs::path& directory) {
  write_file(directory / kScriptFile, embedded::render_scenes_py);
  write_file(directory / "blender_formulas.py", embedded::blender_formulas_py);
  write_file(directory / "blender_surfaces.py", embedded::blender_surfaces_py);
  write_file(directory / "blender_scene.py", embedded::blender_scene_py);
}

/// Blender's scripts and data: "3.4" beside the program in an unpacked release, ../share/blender in a package. Without the
/// release's Python, which affects no pixel.
std::vector<fs::path> blender_directories(const fs::path& program, std::string_view version) {
  std::error_code ignored;
  const fs::path place = fs::weakly_canonical(program, ignored).parent_path();
  const auto minor = version.find('.', version.find('.') + 1);
  const std::string series(version.substr(0, minor));
  std::vector<fs::path> directories;
  for (const fs::path& base : {place / series, place.parent_path() / "share" / "blender",
                               place.parent_path() / "share" / "blender" / series})
    for (const char* part : {"scripts", "datafiles"}) directories.push_back(base / part);
  return directories;
}

/// render_scenes.py uses interfaces of node groups and point primitives that exist since 3.4.
constexpr EngineProbe kBlenderProbe{
    "blender", "Blender ",
    [](int major, int minor) { return major == 4 || (major == 3 && minor >= 4); },
    blender_directories};

/// render_scenes.py at work.
class BlenderProgram final : public PersistentProgram {
 public:
  explicit BlenderProgram(const ReferenceOptions& options)
      : own_transport_(options.own_transport),
        is_native_(options.shading == Shading::kNative || options.own_transport) {}

  const EngineInfo& info() const override { return kBlenderInfo; }
  SceneInput input(const Scene& scene, const std::string& name) const override {
    return own_transport_ ? cycles_transport_input(scene, name)
                          : blender_input(in_engine_units(scene), name, is_native_);
  }
  void write_files(const fs::path& directory) const override { write_blender_scripts(directory); }
  void write_first(const fs::path& directory, int threads, const ReferenceOptions& options,
                   const SceneInput& first) const override {
    write_file(directory / kJobFile, blender_job(threads, options, first, true));
  }
  std::vector<std::string> arguments(const std::string& program,
                                     const fs::path& directory) const override {
    return blender_arguments(program, directory);
  }
  void write_pictures(const fs::path& directory, const Scene& scene,
                      const SceneInput& input) const override {
    for (const Light& light : scene.lights)
      if (const auto picture = picture_of(light))
        write_exr(directory / sky_file(input.name), *picture, {});
  }
  void remove_pictures(const fs::path& directory, const SceneInput& input) const override {
    remove_in_temporary_directory(directory / sky_file(input.name));
  }
  bool is_native() const override { return is_native_; }
  std::string method() const override {
    if (own_transport_) return "Cycles' own light transport";
    if (is_native_)
      return "Cycles' closures of Ashikhmin and Shirley and of GGX, their geometry term taken out by their "
             "colour, under a real lamp, one pass per light and reflection";
    return "shader nodes as the colour of a surface under a real lamp, one pass per light and "
           "reflection";
  }

 private:
  const bool own_transport_, is_native_;
};

class Blender final : public ProgramEngine {
 public:
  explicit Blender(const fs::path& program) : ProgramEngine(kBlenderInfo, kBlenderProbe, program) {}

 protected:
  std::string why_not_simple(const Scene& scene, const ReferenceOptions& options) const override {
    if (options.shading == Shading::kNative && !is_native_in_blender(scene))
      return "Cycles has highlights of its own only with the distributions of Ashikhmin and Shirley, cos^n, and "
             "of GGX, both of the half-vector angle, here on spheres";
    if (const std::string lamp = lamp_below_horizon(scene); !lamp.empty())
      return lamp + ", and in Cycles a rounding decides whether the sphere hides it";
    return why_not_for_programs(scene);
  }
  std::string why_not_transport(const Scene& scene) const override {
    return why_not_for_cycles_transport(scene);
  }
  std::unique_ptr<SimpleSession> open_simple(const ReferenceOptions& options) override {
    return open_persistent(std::make_unique<BlenderProgram>(options), status(), options);
  }
};

}  // namespace

SceneInput blender_input(const Scene& scene, const std::string& name, bool native) {
  Json input = scene_json(scene, name);
  const Contacts contacts = find_contacts(scene);
  for (std::size_t l = 0; l < scene.lights.size(); ++l) {
    Json& light = input["lights"].emplace_back(light_json(lamp_of(scene.lights[l])));
    if (!contacts[l].empty()) light["liesOn"] = contacts[l];
  }
  input["native"] = native;
  input["passes"] = passes_json(scene);
  return {name, input["passes"].size(), input.dump()};
}

std::unique_ptr<Engine> make_blender(const fs::path& program) {
  return std::make_unique<Blender>(program);
}

void keep_blender_input(const Scene& scene, const ReferenceOptions& options,
                        const fs::path& directory) {
  const SceneInput input =
      blender_input(in_engine_units(scene), "scene0", options.shading == Shading::kNative);
  write_blender_scripts(directory);
  write_file(directory / kJobFile, blender_job(threads_of({}), {}, input, false));
  write_file(directory / "blender.sh", shell_join(blender_arguments("blender", "")) + "\n");
}

}  // namespace lobelia
