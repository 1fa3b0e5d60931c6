#include "renderer/render_record.hpp"

#include "core/version.hpp"
#include "renderer/scene/remarks.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

/// Beyond it a scene is left out of its picture: readers of EXR headers expect small ones.
constexpr std::size_t kMaxSceneAttribute = 64 << 10;

/// With what each took, where a picture was made.
Json effects_record(const Plan& plan, const Work* work) {
  Json effects = Json::array();
  for (std::size_t i = 0; i < plan.effects.size(); ++i) {
    const EffectDecision& effect = plan.effects[i];
    Json entry{{"name", effect.name}, {"on", effect.on}, {"reason", effect.reason}};
    if (work) entry["work"] = {{"unit", effect.work}, {"count", work->of_effect[i]}};
    effects.push_back(std::move(entry));
  }
  return effects;
}

}  // namespace

ImageMetadata render_metadata(const Scene& scene) {
  ImageMetadata metadata{{"Software", kNameAndVersion},
                         {"lobelia:samples", std::to_string(scene.sampler.sample_count)},
                         {"lobelia:seed", std::to_string(scene.sampler.seed)}};
  // A sphere takes over 64 bytes: a crowd's text is not even made.
  if (scene.spheres.size() > kMaxSceneAttribute / 64) return metadata;
  if (std::string xml = scene_to_xml(scene); xml.size() <= kMaxSceneAttribute)
    metadata.emplace_back("lobelia:scene", std::move(xml));
  return metadata;
}

Json plan_record(const Plan& plan) {
  Json record = make_record("plan");
  record["effects"] = effects_record(plan, nullptr);
  record["precision"] = plan.precision_reason;
  record["kernel"] = plan.kernel;
  record["expectedRays"] = {{"camera", plan.camera_rays},
                            {"shadowAtMost", plan.max_shadow_rays},
                            {"mirrorAtMost", plan.max_mirror_rays},
                            {"scatteredAtMost", plan.max_scattered_rays}};
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
      {"file", image_file}, {"width", scene.film.width}, {"height", scene.film.height}};
  record["highlights"] = Json::array();
  for (const auto& material : scene.materials)
    record["highlights"].push_back(highlight_record(material.highlight));
  record["samples"] = result.samples;
  record["seed"] = scene.sampler.seed;
  if (result.error) record["estimatedError"] = *result.error;
  if (!result.stop_reason.empty()) record["stopped"] = result.stop_reason;
  if (const auto lines = remarks(scene); !lines.empty()) record["remarks"] = lines;
  record["plan"] = {{"effects", effects_record(result.plan, &result.work)},
                    {"precision", result.plan.precision_reason},
                    {"kernel", result.plan.kernel}};
  record["rays"] = {{"camera", result.work.camera_rays},
                    {"shadow", result.work.shadow_rays},
                    {"mirror", result.work.mirror_rays},
                    {"scattered", result.work.scattered_rays}};
  record["instructionSet"] = result.instruction_set;
  record["seconds"] = {{"plan", result.plan_seconds},
                       {"render", result.render_seconds},
                       {"total", result.plan_seconds + result.render_seconds}};
  return record;
}

}  // namespace lobelia
