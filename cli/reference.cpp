#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/engine_programs.hpp"
#include "cli/options.hpp"
#include "cli/progress.hpp"
#include "cli/scene_overrides.hpp"
#include "cli/warnings.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/standard_streams.hpp"
#include "core/text.hpp"
#include "records/record.hpp"
#include "reference_scenes/engine.hpp"
#include "renderer/render_record.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

struct ReferenceArguments {
  std::string scene, engine, output, log_directory, keep_input;
  int threads = 0;
  double time_limit = 600;
  int points = ReferenceOptions{}.points;
  std::uint64_t point_seed = 0;
  std::string precision, shading{kShadingNames[0]}, standard_error;
  bool quiet = false;
  EnginePrograms programs;
  SceneOverrides overrides;
};

/// The place of a name among those that are allowed.
std::size_t chosen_place(const std::string& typed, const std::string& option,
                         std::span<const std::string_view> names) {
  return chosen(typed, option, names, join(names),
                [&](const std::string& name) -> std::optional<std::size_t> {
                  const auto found = std::ranges::find(names, name);
                  if (found == names.end()) return std::nullopt;
                  return std::size_t(found - names.begin());
                });
}

/// Of the engine's number formats: one, or the finer one after it.
std::vector<std::string_view> precisions(const EngineInfo& engine) {
  if (engine.fine.empty()) return {engine.plain};
  return {engine.plain, engine.fine};
}

ReferenceOptions reference_options(const EngineInfo& engine, const ReferenceArguments& options) {
  ReferenceOptions reference;
  if (!options.precision.empty())
    reference.fine = chosen_place(options.precision, fmt::format("--precision of {}", engine.name),
                                  precisions(engine)) == 1;
  reference.shading = Shading(chosen_place(options.shading, "--shading", kShadingNames));
  reference.threads = options.threads;
  reference.time_limit = std::chrono::duration<double>(options.time_limit);
  reference.points = options.points;
  reference.seed = options.point_seed;
  return reference;
}

void run_reference(const ReferenceArguments& options) {
  const auto engine = make_engine(options.engine, options.programs.of(options.engine));
  const ReferenceOptions reference = reference_options(engine->info(), options);
  Scene scene = read_scene(options.scene);
  options.overrides.apply(scene);
  if (const std::string why = engine->why_not(scene, reference); !why.empty())
    throw Error(ExitCode::kInput,
                fmt::format("{}: not comparable, because {}", options.scene, why));
  warn_of(scene);
  const auto record_path = checked_record_path(options.output);
  if (!options.standard_error.empty()) require_writable(options.standard_error);
  if (!options.log_directory.empty()) make_directories(options.log_directory);
  if (!options.keep_input.empty())
    keep_engine_input(options.engine, scene, reference, options.keep_input);

  const EngineInfo& engine_info = engine->info();
  ProgressLine progress(!options.quiet);
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
    // Of a picture that is no average there is no error to know.
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
  if (!options.quiet)
    say("{}: {} x {}, {:.3f} s, {} {}, {}\n", printable_path(options.output), result.image.width(),
        result.image.height(), record.seconds.total, engine_info.title, engine->status().version,
        record.witness);
}

std::string engine_list() {
  std::string list;
  for (const EngineInfo& engine : engine_infos())
    list += (list.empty() ? "" : " or ") + std::string(engine.name);
  return list;
}

/// "half or float (povray), float (blender)"
std::string precision_list() {
  std::string list;
  for (const EngineInfo& engine : engine_infos())
    list += fmt::format("{}{} ({})", list.empty() ? "" : ", ",
                        fmt::join(precisions(engine), " or "), engine.name);
  return list;
}

/// What a picture of each is worth, as the catalogue says it.
std::string engine_words() {
  std::string words;
  for (const EngineInfo& engine : engine_infos())
    words += fmt::format("{}\n  {}\n  {}\n", engine.title, engine.shading, engine.precision);
  return words;
}

}  // namespace

void add_reference(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand(
      "reference", "Render a scene with an engine that is not ours, to the same kind of EXR");
  auto options = std::make_shared<ReferenceArguments>();
  command->add_option("SCENE", options->scene, "Scene file (see lobelia scene-format)")->required();
  command->add_option("--engine", options->engine, fmt::format("Who renders: {}", engine_list()))
      ->required();
  command
      ->add_option("-o,--output", options->output,
                   "Picture to write, OUT.exr; its record goes to OUT.json")
      ->required()
      ->type_name("OUT.exr");
  options->programs.add_to(*command);
  command
      ->add_option("--time-limit", options->time_limit, "Seconds after which the engine is stopped")
      ->check(between(0.1, 1e6))
      ->capture_default_str();
  command
      ->add_option(
          "--points", options->points,
          "Points of each light with a size, of the lens and of the pixel; a multiple of 16")
      ->check(between(kReplicates, 1 << 20))
      ->capture_default_str();
  command->add_option(
      "--precision", options->precision,
      fmt::format("Number format of the engine: {}; the first if not given", precision_list()));
  command
      ->add_option(
          "--shading,--witness", options->shading,
          "Who shades a highlight: the engine itself (native), our formula in the engine's "
          "language (expressed), or whichever is usual (any)")
      ->capture_default_str();
  command
      ->add_option(
          "--standard-error", options->standard_error,
          "Picture of the error of each value where lights with a size, lens or pixel are averaged")
      ->type_name("ERROR.exr");
  command->add_option("--point-seed", options->point_seed, "Chooses those points")
      ->check(between(0, 1 << 30))
      ->capture_default_str();
  command->add_option("--threads", options->threads, "Threads; 0 is all processors")
      ->check(between(0, 1024))
      ->capture_default_str();
  command->add_option("--log-dir", options->log_directory, "Directory for the engine's own output");
  command->add_option("--keep-input", options->keep_input,
                      "Directory for what the engine is given, with the command that renders it");
  command->add_flag("-q,--quiet", options->quiet, "Print nothing but errors");
  options->overrides.add_to(*command);
  command->footer(
      engine_words() +
      "Each takes one ray at a pixel's centre. lobelia engines says which are here.\n\n"
      "Example: lobelia reference reference_scenes/scenes/oblique_45.xml --engine povray "
      "-o povray.exr");
  command->callback([options] { run_reference(*options); });
}

}  // namespace lobelia::cli
