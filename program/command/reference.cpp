#include <ranges>

#include "base/pictures/image_io.hpp"
#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/messages.hpp"
#include "program/command/options.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/render_record.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

struct ReferenceArguments {
  std::string scene, engine, output, standard_error, log_directory, keep_input;
  std::string precision, shading{kShadingNames[0]};
  double time_limit = 600;
  ReferenceOptions reference;
  EnginePrograms programs;
  SceneOverrides overrides;
};

/// The engine's number formats: one, or two with the finer one last.
std::vector<std::string_view> precisions(const EngineInfo& engine) {
  if (engine.fine.empty()) return {engine.plain};
  return {engine.plain, engine.fine};
}

ReferenceOptions reference_options(const EngineInfo& engine, const ReferenceArguments& options) {
  ReferenceOptions reference = options.reference;
  if (!options.precision.empty())
    reference.fine = chosen_place(options.precision, fmt::format("--precision of {}", engine.name),
                                  precisions(engine)) == 1;
  reference.shading = Shading(chosen_place(options.shading, "--shading", kShadingNames));
  reference.seed = options.overrides.seed().value_or(reference.seed);
  reference.time_limit = std::chrono::duration<double>(options.time_limit);
  return reference;
}

void run_reference(const ReferenceArguments& options) {
  const auto engine = make_engine(options.engine, options.programs.of(options.engine));
  const ReferenceOptions reference = reference_options(engine->info(), options);
  Scene scene = read_scene(options.scene);
  options.overrides.apply(scene);
  if (const std::string why = engine->why_not(scene, reference); !why.empty())
    throw Error(ExitCode::kInput, "{}: not comparable, because {}", options.scene, why);
  warn_of(scene);
  const auto record_path = checked_record_path(options.output);
  if (!options.standard_error.empty()) require_writable(options.standard_error);
  if (!options.log_directory.empty()) make_directories(options.log_directory);
  if (!options.keep_input.empty())
    keep_engine_input(options.engine, scene, reference, options.keep_input);

  const EngineInfo& engine_info = engine->info();
  ProgressLine progress;
  progress.show(0, fmt::format("{} at work", engine_info.title));
  ReferenceResult result = Session(*engine, reference).render(scene);
  progress.clear();
  if (!options.log_directory.empty() && !result.log.empty())
    write_file(
        std::filesystem::path(options.log_directory) / fmt::format("{}-0.log", engine_info.name),
        result.log);
  if (!result.error.empty()) throw Error(ExitCode::kEngine, result.error);

  FilesTogether files;
  write_exr(options.output, result.image, reference_metadata(scene, result.record));
  if (!options.standard_error.empty()) {
    // Only an average has an error; any other picture gets zeros.
    const Image none(result.image.width(), result.image.height());
    write_exr(options.standard_error,
              result.standard_error.pixel_count() > 0 ? result.standard_error : none,
              reference_metadata(scene, result.record));
  }
  const std::filesystem::path output(options.output);
  records::Reference& record = result.record;
  record.command = command_line();
  record.image.file = output.filename().string();
  for (const Material& material : scene.materials)
    record.highlights.push_back(highlight_record(material.highlight));
  write_record(record_path, record);
  files.commit();
  if (!verbosity().quiet)
    say("{}: {} x {}, {:.3f} s, {} {}, {}\n", printable_path(options.output), result.image.width(),
        result.image.height(), record.seconds.total, engine_info.title, engine->status().version,
        record.shading);
}

/// "half or float (povray), float (blender)"
std::string precision_list() {
  std::string list;
  for (const EngineInfo& engine : engine_infos())
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ",
                        fmt::join(precisions(engine), " or "), engine.name);
  return list;
}

/// Each engine's shading and precision, from the catalogue.
std::string engine_words() {
  std::string words;
  for (const EngineInfo& engine : engine_infos())
    words += fmt::format("{}\n  {}\n  {}\n", engine.title, engine.shading, engine.precision);
  return words;
}

}  // namespace

void add_reference(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand(
      "reference", "Render a reference with POV-Ray, Blender, another engine or the formulas");
  auto options = std::make_shared<ReferenceArguments>();
  OptionGroup group(*command);
  ReferenceOptions& reference = options->reference;
  group.add("SCENE", options->scene, "", "Scene file (see lobelia scene-format)")->required();
  group
      .add(
          "--engine", options->engine, "",
          fmt::format("Who renders: {}",
                      fmt::join(engine_infos() | std::views::transform(&EngineInfo::name), " or ")))
      ->required();
  add_common(group, "--output", options->output, ": the picture; its record goes to OUT.json",
             "OUT.exr")
      ->required();
  options->programs.add_to(*command);
  add_common(group, "--time-limit", options->time_limit, ": the engine has failed then")
      ->check(between(0.1, 1e6))
      ->capture_default_str();
  group.add_number(
      "--points", reference.points, kReplicates, 1 << 20,
      "Points of each light with a size, of the lens and of the pixel; a multiple of 16");
  group.add(
      "--precision", options->precision, "",
      fmt::format("Number format of the engine: {}; the first if not given", precision_list()));
  group
      .add("--shading", options->shading, "",
           "Who shades a highlight: the engine itself (native), our formula in the engine's "
           "language (expressed), or whichever is usual (any)")
      ->capture_default_str();
  group.add(
      "--standard-error", options->standard_error, "ERROR.exr",
      "Picture of the error of each value where lights with a size, lens or pixel are averaged");
  add_common(group, "--threads", reference.threads)->check(between(0, 1024))->capture_default_str();
  group.add("--log-dir", options->log_directory, "", "Directory for the engine's own output");
  group.add("--keep-input", options->keep_input, "",
            "Directory for what the engine is given, with the command that renders it");
  options->overrides.add_to(*command);
  command->footer(
      engine_words() +
      "Each takes one ray at a pixel's centre. lobelia engines says which are here.\n\n"
      "Example: lobelia reference reference_scenes/scenes/oblique_45.xml --engine povray "
      "-o povray.exr");
  command->callback([options] { run_reference(*options); });
}

}  // namespace lobelia::cli
