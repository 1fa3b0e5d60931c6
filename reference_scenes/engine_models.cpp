#include "reference_scenes/engine.hpp"

namespace lobelia {

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
