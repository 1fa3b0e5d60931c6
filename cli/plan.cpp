#include "cli/commands.hpp"
#include "cli/messages.hpp"
#include "cli/options.hpp"
#include "records/record.hpp"
#include "renderer/render_record.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

struct PlanArguments {
  std::string scene;
  bool json = false;
  SceneOverrides overrides;
};

void run_plan(const PlanArguments& options) {
  Scene scene = read_scene(options.scene);
  options.overrides.apply(scene);
  warn_of(scene);
  const Plan plan = make_plan(scene, EffectPolicy::kAsCalledFor);
  if (options.json) {
    fmt::print("{}", record_text(plan_record(plan)));
    return;
  }
  for (const auto& effect : plan.effects)
    fmt::print("{:<15}{:<4}{}\n", effect.name, effect.on ? "on" : "off", effect.reason);
  fmt::print("{:<19}{}\n{:<19}{}\n", "precision", plan.precision_reason, "kernel", plan.kernel);
  const auto print = [](const char* kind, const char* at_most, std::uint64_t rays) {
    fmt::print("{:<19}{}{}\n", kind, rays > 0 ? at_most : "", rays);
  };
  print("camera rays", plan.first_samples < scene.sampler.sample_count ? "at most " : "",
        plan.camera_rays);
  print("shadow rays", "at most ", plan.max_shadow_rays);
  print("mirror rays", "at most ", plan.max_mirror_rays);
  print("scattered rays", "at most ", plan.max_scattered_rays);
}

}  // namespace

void add_plan(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand("plan", "Say which effects a scene calls for, and why");
  auto options = std::make_shared<PlanArguments>();
  command->add_option("SCENE", options->scene, "Scene file")->required();
  command->add_flag("--json", options->json, "Print the plan as JSON");
  options->overrides.add_to(*command);
  command->footer("Example: lobelia plan reference_scenes/scenes/two_spheres.xml");
  command->callback([options] { run_plan(*options); });
}

}  // namespace lobelia::cli
