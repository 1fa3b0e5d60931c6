#include "reference_scenes/engines/blender/blender.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files.hpp"
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

class Blender final : public ProgramEngine {
 public:
  explicit Blender(const fs::path& program) : ProgramEngine(kBlenderInfo, kBlenderProbe, program) {}

 protected:
  std::string why_not_simple(const Scene& scene, const ReferenceOptions& options) const override {
    if (options.shading == Shading::kNative && !is_native_in_blender(scene))
      return "Cycles has highlights of its own only with the distribution of Ashikhmin and Shirley: cos^n "
             "of the half-vector angle, here on spheres";
    if (const std::string lamp = lamp_below_horizon(scene); !lamp.empty())
      return lamp + ", and in Cycles a rounding decides whether the sphere hides it";
    return why_not_for_programs(scene);
  }
  std::string why_not_transport(const Scene& scene) const override {
    return why_not_for_cycles_transport(scene);
  }
  std::unique_ptr<SimpleSession> open_simple(const ReferenceOptions& options) override {
    return open_blender(status(), options);
  }
};

}  // namespace

std::unique_ptr<Engine> make_blender(const fs::path& program) {
  return std::make_unique<Blender>(program);
}

void keep_blender_input(const Scene& scene, const ReferenceOptions& options,
                        const fs::path& directory) {
  const BlenderScene input =
      blender_input(in_engine_units(scene), "scene0", options.shading == Shading::kNative);
  write_blender_scripts(directory);
  write_file(directory / kBlenderJobFile, blender_job(threads_of({}), {}, input, false));
  write_file(directory / "blender.sh", shell_join(blender_arguments("blender", "")) + "\n");
}

}  // namespace lobelia
