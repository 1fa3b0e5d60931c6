#include "reference_scenes/engines/programs/native_engine.hpp"

#include <fmt/format.h>

#include "core/files.hpp"
#include "core/text.hpp"
#include "reference_scenes/preparation.hpp"

namespace lobelia {
namespace {
namespace fs = std::filesystem;

SceneInput input_of(const NativeEngine& engine, const Scene& scene, const std::string& name,
                    const ReferenceOptions& options) {
  return camera_scene(scene, name, options, [&](const Material& material) {
    OwnHighlight own = engine.own(material.highlight).value_or(OwnHighlight());
    own.strength *= material.specular_reflectance.r;
    return own;
  });
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
    if (std::string why = why_not_in_camera_scene(scene); !why.empty())
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
