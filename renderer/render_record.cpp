#include "renderer/render_record.hpp"

#include <fmt/format.h>

#include "base/system/version.hpp"
#include "renderer/formula.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

/// A larger scene is not written into its picture: readers of EXR expect small headers.
constexpr std::size_t kMaxSceneAttribute = 64 << 10;

/// With the work of each effect, if a picture was rendered.
std::vector<records::Effect> effects_record(const Plan& plan, const Work* work) {
  std::vector<records::Effect> effects;
  for (std::size_t i = 0; i < plan.effects.size(); ++i) {
    const EffectDecision& effect = plan.effects[i];
    records::Effect& one = effects.emplace_back();
    one.name = effect.name;
    one.on = effect.on;
    one.reason = effect.reason;
    if (work) one.work = records::Work{std::string(effect.work), work->of_effect[i]};
  }
  return effects;
}

}  // namespace

ImageMetadata render_metadata(const Scene& scene) {
  ImageMetadata metadata{{"Software", kNameAndVersion},
                         {"lobelia:samples", std::to_string(scene.sampler.sample_count)},
                         {"lobelia:seed", std::to_string(scene.sampler.seed)}};
  // A sphere takes over 64 bytes, so the text of many spheres is not even written.
  if (scene.spheres.size() > kMaxSceneAttribute / 64) return metadata;
  if (std::string xml = scene_to_xml(scene); xml.size() <= kMaxSceneAttribute)
    metadata.emplace_back("lobelia:scene", std::move(xml));
  return metadata;
}

records::Plan plan_record(const Plan& plan) {
  return {effects_record(plan, nullptr),
          plan.precision_reason,
          plan.kernel,
          {plan.camera_rays, plan.max_shadow_rays, plan.max_mirror_rays, plan.max_scattered_rays}};
}

std::string plan_text(const Plan& plan, const Scene& scene) {
  std::string text;
  for (const EffectDecision& effect : plan.effects)
    text += fmt::format("{:<15}{:<4}{}\n", effect.name, effect.on ? "on" : "off", effect.reason);
  text += fmt::format("{:<19}{}\n{:<19}{}\n", "precision", plan.precision_reason, "kernel",
                      plan.kernel);
  const auto add = [&](const char* kind, bool at_most, std::uint64_t rays) {
    text += fmt::format("{:<19}{}{}\n", kind, at_most && rays > 0 ? "at most " : "", rays);
  };
  add("camera rays", plan.first_samples < scene.sampler.sample_count, plan.camera_rays);
  add("shadow rays", true, plan.max_shadow_rays);
  add("mirror rays", true, plan.max_mirror_rays);
  add("scattered rays", true, plan.max_scattered_rays);
  return text;
}

records::Highlight highlight_record(const Highlight& highlight) {
  return {std::string(info(highlight.model).name),
          std::string(info(highlight.lobe).name),
          std::string(name(highlight.normalisation)),
          highlight.exponent,
          radiance_coefficient(highlight),
          warning(highlight),
          highlight.lobe.formula ? highlight.lobe.formula->text() : ""};
}

records::Rays rays_record(const Work& work) {
  return {work.camera_rays, work.shadow_rays, work.mirror_rays, work.scattered_rays};
}

records::Render render_record(const Scene& scene, const RenderResult& result,
                              const std::vector<std::string>& command,
                              const std::string& image_file) {
  records::Render record;
  record.engine = {"lobelia", "", kVersion};
  record.command = command;
  record.image = {image_file, scene.film.width, scene.film.height};
  for (const auto& material : scene.materials)
    record.highlights.push_back(highlight_record(material.highlight));
  record.samples = result.samples;
  record.seed = scene.sampler.seed;
  record.estimated_error = result.error;
  record.stopped = result.stop_reason;
  record.remarks = remarks(scene);
  record.plan = {effects_record(result.plan, &result.work), result.plan.precision_reason,
                 result.plan.kernel};
  record.rays = rays_record(result.work);
  record.instruction_set = result.instruction_set;
  record.seconds.plan = result.plan_seconds;
  record.seconds.render = result.render_seconds;
  record.seconds.total = result.plan_seconds + result.render_seconds;
  return record;
}

}  // namespace lobelia
