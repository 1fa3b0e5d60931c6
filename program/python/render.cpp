// Pictures of scenes: by our renderer and by the reference engines.
#include "renderer/render.hpp"

#include <algorithm>
#include <ranges>

#include "base/records/record.hpp"
#include "program/command/commands.hpp"
#include "program/command/options.hpp"
#include "program/python/module.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/render_record.hpp"
#include "renderer/scene/scene_io.hpp"
#include "studies/accuracy/accuracy.hpp"

namespace lobelia::python {
namespace {

/// The picture, its record and what is odd about the scene.
using Rendered = std::tuple<py::array, std::string, std::vector<std::string>>;

/// The options of render(), as those of the command line.
struct RenderArguments {
  RenderOptions render;
  cli::SceneOverrides overrides;
  std::string effects = "as-called-for", precision = "sufficient";
  std::string accuracy, accuracy_check = "truth";

  void add_to(CLI::App& app) {
    cli::OptionGroup group(app);
    group.add_number("--threads", render.threads, 0, 1024, "");
    group.add_choice("--effects", effects, {"as-called-for", "all"}, "");
    std::vector<std::string> precisions{"sufficient"};
    precisions.insert(precisions.end(), precision_names().begin(), precision_names().end());
    auto* chosen = group.add_choice("--precision", precision, precisions, "");
    auto* target = group.add("--target-error", render.target_error, "", "");
    target->check(cli::between(1e-9, 1.0));
    auto* time = group.add("--time-limit", render.time_limit, "", "");
    time->check(cli::between(1e-3, 1e7));
    group.add("--max-samples", render.max_samples, "", "")->check(cli::between(1, 1 << 20));
    auto* asked = group.add("--accuracy", accuracy, "", "");
    asked->excludes(chosen)->excludes(target)->excludes(time);
    group.add_choice("--accuracy-check", accuracy_check, {"truth", "none"}, "")->needs(asked);
    overrides.add_to(app);
  }
};

std::optional<accuracy::Choice> choice_of(const Scene& scene, const RenderArguments& given) {
  if (given.accuracy.empty()) return std::nullopt;
  return accuracy::choose(scene, accuracy::parse_accuracy(given.accuracy),
                          given.render.max_samples.value_or(accuracy::kMostChosenSamples));
}

Rendered render_scene(const py::object& text, const py::dict& options, const py::object& progress) {
  RenderArguments given;
  parse_options(options, [&](CLI::App& app) { given.add_to(app); });
  RenderOptions& how = given.render;
  how.effects = given.effects == "all" ? EffectPolicy::kAll : EffectPolicy::kAsCalledFor;
  how.precision = find_precision(given.precision);
  Scene scene = scene_of(text);
  given.overrides.apply(scene);
  scene.sampler.averages_small_highlights = true;
  RenderResult result;
  std::string record;
  run(progress, [&](const ShowProgress& show) {
    how.on_progress = show;
    const std::optional<accuracy::Choice> choice = choice_of(scene, given);
    if (choice) choice->apply(how);
    const Scene& rendered = choice ? choice->scene : scene;
    result = render(rendered, how);
    records::Render made = render_record(rendered, result, cli::command_line(), "");
    if (choice) {
      std::optional<accuracy::Reached> reached;
      if (given.accuracy_check != "none")
        reached = accuracy::measure_reached(scene, *choice, result.image);
      made.accuracy = accuracy::accuracy_record(*choice, reached);
    }
    record = records::record_text(made);
  });
  return {array_of(std::move(result.image)), record, warnings_of(scene)};
}

/// The position of `precision` among the engine's number formats: 1 is the finer one.
bool is_fine(const EngineInfo& engine, const std::string& precision) {
  std::vector<std::string_view> formats{engine.plain};
  if (!engine.fine.empty()) formats.push_back(engine.fine);
  return cli::chosen_place(precision, fmt::format("--precision of {}", engine.name), formats) == 1;
}

Rendered reference(const py::object& text, const std::string& name, const py::dict& given) {
  ReferenceOptions options;
  cli::SceneOverrides overrides;
  std::string precision, shading{kShadingNames[0]}, program;
  double time_limit = 600;
  parse_options(given, [&](CLI::App& app) {
    cli::OptionGroup group(app);
    group.add("--program", program, "", "");
    group.add("--precision", precision, "", "");
    group.add("--shading", shading, "", "");
    group.add_number("--time-limit", time_limit, 0.1, 1e6, "");
    group.add_number("--points", options.points, kReplicates, 1 << 20, "");
    group.add_number("--threads", options.threads, 0, 1024, "");
    overrides.add_to(app);
  });
  const auto engine = make_engine(name, program);
  if (!precision.empty()) options.fine = is_fine(engine->info(), precision);
  options.seed = overrides.seed().value_or(options.seed);
  options.shading = Shading(cli::chosen_place(shading, "--shading", kShadingNames));
  options.time_limit = std::chrono::duration<double>(time_limit);
  Scene scene = scene_of(text);
  overrides.apply(scene);
  if (const std::string why = engine->why_not(scene, options); !why.empty())
    throw Error(ExitCode::kInput, "scene: not comparable, because {}", why);
  ReferenceResult result;
  run(py::none(), [&](const ShowProgress&) {
    result = Session(*engine, options).render(scene);
    if (!result.error.empty()) throw Error(ExitCode::kEngine, result.error);
  });
  result.record.command = cli::command_line();
  for (const Material& material : scene.materials)
    result.record.highlights.push_back(highlight_record(material.highlight));
  return {array_of(std::move(result.image)), records::record_text(result.record),
          warnings_of(scene)};
}

}  // namespace

void add_render(py::module_& module) {
  module.def("render", &render_scene);
  module.def("reference", &reference);
  module.def("scene_xml", [](const py::object& text, const py::dict& given) {
    cli::SceneOverrides overrides;
    parse_options(given, [&](CLI::App& app) { overrides.add_to(app); });
    Scene scene = scene_of(text);
    overrides.apply(scene);
    return scene_to_xml(scene);
  });
  module.def("engine_names", [] {
    std::vector<std::string> names;
    for (const EngineInfo& engine : engine_infos()) names.emplace_back(engine.name);
    return names;
  });
}

}  // namespace lobelia::python
