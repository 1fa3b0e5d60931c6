#include "base/records/record.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/messages.hpp"
#include "program/command/options.hpp"
#include "program/command/output_files.hpp"
#include "renderer/render_record.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

struct PlanArguments {
  std::string scene, json;
  SceneOverrides overrides;
};

void run_plan(const PlanArguments& options) {
  OutputFiles outputs;
  outputs.reads(options.scene);
  outputs.writes_report(options.json);
  Scene scene = read_scene(options.scene);
  options.overrides.apply(scene);
  scene.sampler.averages_small_highlights = true;
  warn_of(scene);
  const Plan plan = make_plan(scene, EffectPolicy::kAsCalledFor);
  write_reports(plan_text(plan, scene), {{options.json, record_text(plan_record(plan))}});
}

}  // namespace

void add_plan(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand("plan", "Say which effects a scene calls for, and why");
  auto options = std::make_shared<PlanArguments>();
  command->add_option("SCENE", options->scene, "Scene file")->required();
  OptionGroup group(*command);
  add_json(group, options->json, "plan");
  options->overrides.add_to(*command);
  command->footer("Example: lobelia plan reference_scenes/scenes/two_spheres.xml");
  command->callback([options] { run_plan(*options); });
}

}  // namespace lobelia::cli
