#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/between.hpp"
#include "cli/commands.hpp"
#include "cli/output_path.hpp"
#include "cli/progress.hpp"
#include "cli/scene_overrides.hpp"
#include "cli/warnings.hpp"
#include "core/colour.hpp"
#include "core/exr_writer.hpp"
#include "core/files.hpp"
#include "core/image_io.hpp"
#include "core/timing.hpp"
#include "renderer/render.hpp"
#include "renderer/render_record.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia::cli {
namespace {

struct Options {
  std::string scene, output, png, effects = "as-called-for";
  double exposure = 0;
  std::string precision = "sufficient";
  int threads = 0;
  std::optional<double> target_error, time_limit;
  std::optional<int> max_samples;
  bool quiet = false;
  SceneOverrides overrides;
};

void require_png(const std::filesystem::path& png, const std::filesystem::path& exr,
                 const std::filesystem::path& record) {
  if (png == exr || png == record)
    throw Error(ExitCode::kUsage,
                fmt::format("--png {}: is written by this command already", png.string()));
  require_writable(png);
}

/// What a command took besides its picture, seconds. Packing rows is a part of rendering, in time too but
/// where a picture is so large that others are rendered meanwhile.
struct Stages {
  double read = 0, pack = 0, write = 0;
};

/// Rows are packed and written while the next ones are rendered. A picture for the eye too is kept whole.
RenderResult render_and_write(const Scene& scene, const RenderOptions& how, const Options& options,
                              Stages& stages) {
  if (!options.png.empty()) {
    RenderResult result = render(scene, how);
    stages.write = seconds_of([&] {
      write_exr(options.output, result.image, render_metadata(scene));
      write_png(options.png, to_display(result.image, options.exposure));
    });
    return result;
  }
  ExrWriter writer(options.output, scene.film.width, scene.film.height, render_metadata(scene));
  RenderResult result = render(scene, how, [&](int y, int rows, const float* rgb) {
    stages.pack += seconds_of([&] { writer.write_rows(y, rows, rgb); });
  });
  stages.write = seconds_of([&] { writer.finish(); });
  return result;
}

void run(const Options& options) {
  Stages stages;
  Scene scene;
  stages.read = seconds_of([&] {
    scene = read_scene(options.scene);
    options.overrides.apply(scene);
  });
  const auto record_path = checked_record_path(options.output);

  if (!options.png.empty()) require_png(options.png, options.output, record_path);

  warn_of(scene);
  ProgressLine progress(!options.quiet);
  RenderOptions render_options;
  render_options.threads = options.threads;
  render_options.effects =
      options.effects == "all" ? EffectPolicy::kAll : EffectPolicy::kAsCalledFor;
  render_options.precision = find_precision(options.precision);
  render_options.target_error = options.target_error;
  render_options.time_limit = options.time_limit;
  render_options.max_samples = options.max_samples;
  render_options.on_progress = [&](double fraction) { progress.show(fraction, "rendering"); };
  const RenderResult result = render_and_write(scene, render_options, options, stages);
  progress.clear();

  const std::filesystem::path output(options.output);
  Json record = render_record(scene, result, command_line(), output.filename().string());
  record["seconds"]["read"] = stages.read;
  record["seconds"]["pack"] = stages.pack;
  record["seconds"]["write"] = stages.write;
  write_record(record_path, record);
  if (!options.quiet)
    fmt::print(stderr, "{}: {} x {}, {:.3f} s, {}{}{}{}\n", options.output, scene.film.width,
               scene.film.height, result.render_seconds, result.instruction_set,
               result.error ? fmt::format(", error {:.2g}", *result.error) : "",
               result.stop_reason.empty() ? "" : ", stopped ", result.stop_reason);
}

}  // namespace

void add_render(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand("render", "Render a scene to a linear float32 EXR");
  auto options = std::make_shared<Options>();
  command->add_option("SCENE", options->scene, "Scene file (see lobelia scene-format)")->required();
  command
      ->add_option("-o,--output", options->output,
                   "Picture to write, OUT.exr; its record goes to OUT.json")
      ->required()
      ->type_name("OUT.exr");
  command->add_option("--png", options->png, "Write a picture for the eye too (8 bits, sRGB)")
      ->type_name("FILE");
  command->add_option("--exposure", options->exposure, "Stops by which the --png is brightened")
      ->check(between(-100.0, 100.0))
      ->capture_default_str();
  command->add_option("--threads", options->threads, "Threads; 0 is all processors")
      ->check(between(0, 1024))
      ->capture_default_str();
  command
      ->add_option("--effects", options->effects,
                   "Simulate effects as the scene calls for them, or all")
      ->check(CLI::IsMember({"as-called-for", "all"}))
      ->capture_default_str();
  command
      ->add_option("--precision", options->precision,
                   "Shade with the narrowest precision whose error bound allows it (sufficient), "
                   "or with this one")
      ->check(CLI::IsMember({"sufficient", "float32", "mixed", "float64"}))
      ->capture_default_str();
  command
      ->add_option("--target-error", options->target_error,
                   "Take samples until the picture's estimated relative error is this small")
      ->check(between(1e-9, 1.0));
  command
      ->add_option("--time-limit", options->time_limit,
                   "Take no more samples once rendering would take longer, seconds")
      ->check(between(1e-3, 1e7));
  command->add_option("--max-samples", options->max_samples, "Take at most so many rays a pixel")
      ->check(between(1, 1 << 20));
  command->add_flag("-q,--quiet", options->quiet, "Print nothing but errors");
  options->overrides.add_to(*command);
  command->footer(
      "One ray at each pixel's centre unless --samples says otherwise. The same scene gives\n"
      "the same file, byte for byte, whatever the number of threads; times are in the record.\n"
      "With --target-error or --time-limit a pixel takes 1, 2, 4, ... samples until one of the\n"
      "limits is reached; the record says which.\n\n"
      "Example: lobelia render reference_scenes/scenes/head_on.xml --model modified_phong "
      "--exponent 128 -o out.exr");
  command->callback([options] { run(*options); });
}

}  // namespace lobelia::cli
