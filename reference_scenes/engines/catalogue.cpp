#include "reference_scenes/engine.hpp"

#include <fmt/format.h>

#include <array>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "reference_scenes/engines/analytic/analytic.hpp"
#include "reference_scenes/engines/babylon/babylon.hpp"
#include "reference_scenes/engines/blender/blender.hpp"
#include "reference_scenes/engines/opengl/opengl.hpp"
#include "reference_scenes/engines/povray/povray.hpp"
#include "reference_scenes/engines/sunflow/sunflow.hpp"
#include "reference_scenes/engines/tachyon/tachyon.hpp"
#include "reference_scenes/engines/three/three.hpp"
#include "reference_scenes/replicates.hpp"

namespace lobelia {
namespace {

struct CatalogueEntry {
  EngineInfo info;
  std::unique_ptr<Engine> (*make)(const std::filesystem::path& program);
  void (*keep_input)(const Scene& scene, const ReferenceOptions& options,
                     const std::filesystem::path& directory);
};

/// An engine is one line here.
constexpr CatalogueEntry kCatalogue[] = {
    {kPovrayInfo, make_povray, keep_povray_input},
    {kBlenderInfo, make_blender, keep_blender_input},
    {kTachyonInfo, make_tachyon, keep_tachyon_input},
    {kSunflowInfo, make_sunflow, keep_sunflow_input},
    {kThreeInfo, make_three, keep_three_input},
    {kBabylonInfo, make_babylon, keep_babylon_input},
    {kOpenglInfo, make_opengl, keep_opengl_input},
    {kAnalyticInfo, make_analytic, keep_analytic_input},
};

constexpr auto kInfos = [] {
  std::array<EngineInfo, std::size(kCatalogue)> infos;
  for (std::size_t i = 0; i < infos.size(); ++i) infos[i] = kCatalogue[i].info;
  return infos;
}();

const CatalogueEntry& entry(std::string_view name) {
  std::vector<std::string_view> names;
  for (const CatalogueEntry& candidate : kCatalogue) {
    if (candidate.info.name == name) return candidate;
    names.push_back(candidate.info.name);
  }
  throw Error(ExitCode::kUsage,
              fmt::format("no reference engine '{}'; there are: {}{}", printable(name), join(names),
                          did_you_mean(name, names)));
}

}  // namespace

std::span<const EngineInfo> engine_infos() { return kInfos; }

const EngineInfo* transport_engine() {
  const auto found =
      std::ranges::find_if(kInfos, [](const EngineInfo& info) { return !info.transport.empty(); });
  return found == kInfos.end() ? nullptr : &*found;
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

}  // namespace lobelia
