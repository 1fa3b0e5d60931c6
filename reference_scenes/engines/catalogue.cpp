#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "base/words/text.hpp"
#include "reference_scenes/engine.hpp"
#include "reference_scenes/engines/analytic/analytic.hpp"
#include "reference_scenes/engines/blender/blender.hpp"
#include "reference_scenes/engines/povray/povray.hpp"
#include "reference_scenes/engines/programs/native_engine.hpp"
#include "reference_scenes/replicates.hpp"

namespace lobelia {
namespace {

struct CatalogueEntry {
  EngineInfo info;
  std::unique_ptr<Engine> (*make)(const std::filesystem::path& program);
  void (*keep_input)(const Scene& scene, const ReferenceOptions& options,
                     const std::filesystem::path& directory);
};

template <const NativeEngine& kEngine>
CatalogueEntry native() {
  return {kEngine.info,
          [](const std::filesystem::path& program) { return make_native_engine(kEngine, program); },
          [](const Scene& scene, const ReferenceOptions& options,
             const std::filesystem::path& directory) {
            keep_native_input(kEngine, scene, options, directory);
          }};
}

/// An engine is one line here.
const std::vector<CatalogueEntry>& catalogue() {
  static const std::vector<CatalogueEntry> all{
      {kPovrayInfo, make_povray, keep_povray_input},
      {kBlenderInfo, make_blender, keep_blender_input},
      native<kTachyon>(),
      native<kSunflow>(),
      native<kThree>(),
      native<kBabylon>(),
      native<kOpengl>(),
      {kAnalyticInfo, make_analytic, keep_analytic_input},
  };
  return all;
}

const CatalogueEntry& entry(std::string_view name) {
  std::vector<std::string_view> names;
  for (const CatalogueEntry& candidate : catalogue()) {
    if (candidate.info.name == name) return candidate;
    names.push_back(candidate.info.name);
  }
  throw Error(ExitCode::kUsage, "no reference engine '{}'; there are: {}{}", printable(name),
              join(names), did_you_mean(name, names));
}

}  // namespace

std::span<const EngineInfo> engine_infos() {
  static const std::vector<EngineInfo> infos = [] {
    std::vector<EngineInfo> all;
    for (const CatalogueEntry& one : catalogue()) all.push_back(one.info);
    return all;
  }();
  return infos;
}

const EngineInfo* transport_engine() {
  const auto infos = engine_infos();
  const auto found =
      std::ranges::find_if(infos, [](const EngineInfo& info) { return !info.transport.empty(); });
  return found == infos.end() ? nullptr : &*found;
}

const EngineInfo& engine_info(std::string_view name) { return entry(name).info; }

std::unique_ptr<Engine> make_engine(std::string_view name, const std::filesystem::path& program) {
  return entry(name).make(program);
}

void keep_engine_input(std::string_view engine, const Scene& scene, const ReferenceOptions& options,
                       const std::filesystem::path& directory) {
  const CatalogueEntry& found = entry(engine);
  if (const std::string why = found.make({})->why_not(scene, options); !why.empty())
    throw Error(ExitCode::kInput, why);
  make_directories(directory);
  if (!needs_replicates(scene)) return found.keep_input(scene, options, directory);
  const auto all = replicates(scene, kReplicates, options.points / kReplicates, options.seed);
  for (std::size_t r = 0; r < all.size(); ++r)
    for (std::size_t p = 0; p < all[r].size(); ++p) {
      const auto part = directory / fmt::format("set{}-{}", r, p);
      make_directories(part);
      found.keep_input(all[r][p].scene, options, part);
    }
}

std::vector<records::EngineModel> engine_models(const Engine& engine) {
  std::vector<records::EngineModel> models;
  if (!engine.info().is_program || engine.info().whole_scenes) return models;
  Scene scene;
  scene.film = {16, 16};
  scene.camera.origin = {0, 0, 5};
  scene.lights = {DirectionalLight{{0, -0.5, -1}, {1, 1, 1}}};
  scene.spheres = {{{0, 0, 0}, 1, 0}};
  const auto shows = [&](const Highlight& highlight, Shading shading) {
    scene.materials = {{"material", highlight, {1, 1, 1}, {}}};
    ReferenceOptions options;
    options.shading = shading;
    return engine.why_not(scene, options).empty();
  };
  for (const ModelId model : all_models()) {
    records::EngineModel& found = models.emplace_back();
    found.model = info(model).name;
    found.title = info(model).title;
    for (const LobeId& lobe : all_lobes()) {
      const Highlight highlight{model, lobe};
      const std::string name(info(lobe).name);
      if (shows(highlight, Shading::kNative)) found.native.push_back(name);
      if (shows(highlight, Shading::kReimplemented)) found.expressed.push_back(name);
    }
  }
  return models;
}

}  // namespace lobelia
