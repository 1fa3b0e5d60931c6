#include "renderer/render_record.hpp"

#include "core/version.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

/// Beyond it a scene is left out of its picture: readers of EXR headers expect small ones.
constexpr std::size_t kMaxSceneAttribute = 64 << 10;

Json effects_record(const Plan& plan) {
  Json effects = Json::array();
  for (const auto& effect : plan.effects)
    effects.push_back({{"name", effect.name}, {"on", effect.on}, {"reason", effect.reason}});
  return effects;
}

}  // namespace

ImageMetadata render_metadata(const Scene& scene) {
  ImageMetadata metadata{{"Software", kNameAndVersion},
                         {"lobelia:samples", std::to_string(scene.sampler.sample_count)},
                         {"lobelia:seed", std::to_string(scene.sampler.seed)}};
  if (std::string xml = scene_to_xml(scene); xml.size() <= kMaxSceneAttribute)
    metadata.emplace_back("lobelia:scene", std::move(xml));
  return metadata;
}

Json plan_record(const Plan& plan) {
  Json record = make_record("plan");
  record["effects"] = effects_record(plan);
  record["precision"] = plan.precision_reason;
  record["expectedRays"] = {{"camera", plan.camera_rays}, {"shadowAtMost", plan.max_shadow_rays}};
  return record;
}

Json highlight_record(const Highlight& highlight) {
  Json record{{"model", info(highlight.model).name},
              {"lobe", info(highlight.lobe).name},
              {"normalisation", name(highlight.normalisation)},
              {"exponent", highlight.exponent},
              {"coefficient", radiance_coefficient(highlight)}};
  if (const std::string text = warning(highlight); !text.empty()) record["warning"] = text;
  return record;
}

Json render_record(const Scene& scene, const RenderResult& result,
                   const std::vector<std::string>& command, const std::string& image_file) {
  Json record = make_record("render");
  record["engine"] = {{"name", "lobelia"}, {"version", kVersion}};
  record["command"] = command;
  record["image"] = {
      {"file", image_file}, {"width", result.image.width()}, {"height", result.image.height()}};
  record["highlights"] = Json::array();
  for (const auto& material : scene.materials)
    record["highlights"].push_back(highlight_record(material.highlight));
  record["samples"] = scene.sampler.sample_count;
  record["seed"] = scene.sampler.seed;
  record["plan"] = {{"effects", effects_record(result.plan)},
                    {"precision", result.plan.precision_reason}};
  record["rays"] = {{"camera", result.camera_rays}, {"shadow", result.shadow_rays}};
  record["instructionSet"] = result.instruction_set;
  record["seconds"] = {{"plan", result.plan_seconds},
                       {"render", result.render_seconds},
                       {"total", result.plan_seconds + result.render_seconds}};
  return record;
}

}  // namespace lobelia
