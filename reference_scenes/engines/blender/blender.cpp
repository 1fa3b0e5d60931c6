#include "reference_scenes/engines/blender/blender.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/removal.hpp"
#include "core/text.hpp"
#include "reference_scenes/engine_program.hpp"
#include "reference_scenes/engines/blender/blender_input.hpp"
#include "reference_scenes/preparation.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;

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
    write_file(directory / kBlenderJobFile, blender_job(threads, options, first, true));
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

std::unique_ptr<Engine> make_blender(const fs::path& program) {
  return std::make_unique<Blender>(program);
}

void keep_blender_input(const Scene& scene, const ReferenceOptions& options,
                        const fs::path& directory) {
  const SceneInput input =
      blender_input(in_engine_units(scene), "scene0", options.shading == Shading::kNative);
  write_blender_scripts(directory);
  write_file(directory / kBlenderJobFile, blender_job(threads_of({}), {}, input, false));
  write_file(directory / "blender.sh", shell_join(blender_arguments("blender", "")) + "\n");
}

}  // namespace lobelia
