#include <algorithm>
#include <optional>
#include <span>

#include "base/pictures/colour.hpp"
#include "base/pictures/exr_writer.hpp"
#include "base/pictures/image_io.hpp"
#include "base/pictures/png_writer.hpp"
#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/system/threads.hpp"
#include "base/system/timing.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/messages.hpp"
#include "program/command/options.hpp"
#include "renderer/render.hpp"
#include "renderer/render_record.hpp"
#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/scene_io.hpp"
#include "studies/accuracy/accuracy.hpp"
#include "studies/cost/lobe_variants.hpp"

namespace lobelia::cli {
namespace {

struct RenderArguments {
  std::string scene, output, png, standard_error, accuracy;
  std::string effects = "as-called-for", precision = "sufficient", accuracy_check = "truth";
  double exposure = 0;
  RenderOptions render;
  SceneOverrides overrides;
};

/// Throws unless `path` can be written and is none of the `others`. Does nothing if it is empty.
void require_output(std::string_view option, const std::filesystem::path& path,
                    std::initializer_list<std::filesystem::path> others) {
  if (path.empty()) return;
  if (std::ranges::find(others, path) != others.end())
    throw Error(ExitCode::kUsage, "{} {}: is written by this command already", option,
                path.string());
  require_writable(path);
}

/// Throws before long work if the option is given and the picture is too large for it.
void require_whole_picture(const Film& film, std::string_view option, std::string_view value) {
  const std::string problem = whole_picture_problem(film);
  if (!value.empty() && !problem.empty()) throw Error(ExitCode::kUsage, "{}: {}", option, problem);
}

/// Seconds of the stages around rendering. Packing rows is part of rendering; in a large picture it runs while other
/// rows are rendered.
struct Stages {
  double read = 0, pack = 0, write = 0;
};

/// Packs and writes rows while the next ones are rendered. Keeps them in memory only if a measurement of the picture's
/// accuracy needs them.
RenderResult render_and_write(const Scene& scene, const RenderOptions& how,
                              const RenderArguments& options, Stages& stages) {
  const int width = scene.film.width, height = scene.film.height;
  ExrWriter exr(options.output, width, height, render_metadata(scene));
  std::optional<PngWriter> png;
  if (!options.png.empty()) png.emplace(options.png, width, height);
  Image image;
  if (!options.accuracy.empty() && options.accuracy_check != "none") image = Image(width, height);
  RenderResult result = render(scene, how, [&](int y, int rows, const float* rgb) {
    const std::span values(rgb, std::size_t{3} * std::size_t(width) * std::size_t(rows));
    stages.pack += seconds_of([&] {
      exr.write_rows(y, rows, rgb);
      if (png) png->write_rows(to_display(values, width, options.exposure));
    });
    if (image.pixel_count() > 0) std::ranges::copy(values, image.pixel(0, y).data());
  });
  result.image = std::move(image);
  stages.write = seconds_of([&] {
    exr.finish();
    if (png) png->finish();
  });
  return result;
}

/// The cheapest variant that reaches --accuracy; none without that option.
std::optional<accuracy::Choice> choice_of(const Scene& scene, const RenderArguments& options) {
  if (options.accuracy.empty()) return std::nullopt;
  const accuracy::Accuracy asked = accuracy::parse_accuracy(options.accuracy);
  return accuracy::choose(scene, asked,
                          options.render.max_samples.value_or(accuracy::kMostChosenSamples));
}

/// Measures the accuracy that was reached, unless --accuracy-check is none; prints and records it.
ExitCode report_accuracy(const Scene& scene, const accuracy::Choice& choice, const Image& picture,
                         const RenderArguments& options, records::Render& record) {
  std::optional<accuracy::Reached> reached;
  if (options.accuracy_check != "none") reached = accuracy::measure_reached(scene, choice, picture);
  record.accuracy = accuracy::accuracy_record(choice, reached);
  if (const auto own = accuracy::own_lobe(scene); own && choice.lobe) {
    const double exponent =
        std::ranges::find_if(scene.materials, has_highlight)->highlight.exponent;
    const std::vector<Times> times =
        cost::value_times({{*choice.lobe, exponent, choice.precision == Precision::kFloat64},
                           {*own, exponent, true}});
    record.accuracy->value_seconds.emplace(times[0].median, times[1].median);
  }
  if (!verbosity().quiet)
    say("{}{}", accuracy::choice_text(choice, *record.accuracy),
        reached ? accuracy::reached_text(choice, *reached) : "");
  return !reached || reached->held(choice) ? ExitCode::kSuccess : ExitCode::kDiffers;
}

void run_render(const RenderArguments& options, ExitCode& code) {
  Stages stages;
  Scene scene;
  stages.read = seconds_of([&] {
    scene = read_scene(options.scene);
    options.overrides.apply(scene);
    scene.sampler.averages_small_highlights = true;
  });
  const auto record_path = checked_record_path(options.output);
  require_output("--png", options.png, {options.output, record_path});
  require_output("--standard-error", options.standard_error, {options.output, options.png});

  require_whole_picture(scene.film, "--standard-error", options.standard_error);
  require_whole_picture(scene.film, "--accuracy", options.accuracy);

  warn_of(scene);
  ProgressLine progress;
  RenderOptions render_options = options.render;
  render_options.effects =
      options.effects == "all" ? EffectPolicy::kAll : EffectPolicy::kAsCalledFor;
  render_options.precision = find_precision(options.precision);
  render_options.on_progress = [&](double fraction) { progress.show(fraction, "rendering"); };
  if (!options.accuracy.empty()) {
    keep_to_usual_threads();  // comparing uses oneTBB, of small pictures too
    progress.show(0, "choosing");
  }
  const std::optional<accuracy::Choice> choice = choice_of(scene, options);
  if (choice) choice->apply(render_options);
  const Scene& rendered = choice ? choice->scene : scene;
  FilesTogether files;
  RenderResult result = render_and_write(rendered, render_options, options, stages);
  if (choice && choice->samples)
    result.stop_reason =
        fmt::format("after {} samples a pixel: what --accuracy chose", result.samples);
  if (!options.standard_error.empty()) {
    render_options.on_progress = [&](double fraction) { progress.show(fraction, "its error"); };
    write_exr(options.standard_error, standard_error_of_render(rendered, render_options),
              render_metadata(rendered));
  }
  progress.clear();

  const std::filesystem::path output(options.output);
  records::Render record =
      render_record(rendered, result, command_line(), output.filename().string());
  record.seconds.read = stages.read;
  record.seconds.pack = stages.pack;
  record.seconds.write = stages.write;
  if (choice) code = report_accuracy(scene, *choice, result.image, options, record);
  write_record(record_path, record);
  files.commit();
  if (verbosity().verbose) say("{}", plan_text(result.plan, rendered));
  if (!verbosity().quiet)
    say("{}: {} x {}, {:.3f} s, {}{}{}{}\n", printable_path(options.output), scene.film.width,
        scene.film.height, result.render_seconds, result.instruction_set,
        result.error ? fmt::format(", error {:.2g}", *result.error) : "",
        result.stop_reason.empty() ? "" : ", stopped ", result.stop_reason);
}

}  // namespace

void add_render(CLI::App& app, ExitCode& code) {
  auto* command = app.add_subcommand("render", "Render a scene to a linear float32 EXR");
  auto options = std::make_shared<RenderArguments>();
  command->add_option("SCENE", options->scene, "Scene file (see lobelia scene-format)")->required();
  OptionGroup group(*command);
  add_common(group, "--output", options->output, ": the picture; its record goes to OUT.json",
             "OUT.exr")
      ->required();
  group.add("--png", options->png, "FILE", "Write a picture for the eye too (8 bits, sRGB)");
  group.add_number("--exposure", options->exposure, -100, 100,
                   "Stops by which the --png is brightened");
  add_common(group, "--threads", options->render.threads)
      ->check(between(0, 1024))
      ->capture_default_str();
  group.add_choice(
      "--effects", options->effects, {"as-called-for", "all"},
      "Simulate effects as the scene calls for them, or all. The picture is the same to "
      "the bit; where something is random, equal in the mean");
  std::vector<std::string> precisions{"sufficient"};
  precisions.insert(precisions.end(), precision_names().begin(), precision_names().end());
  auto* precision = group.add_choice(
      "--precision", options->precision, precisions,
      "Shade with the narrowest precision whose error bound allows it (sufficient), "
      "or with this one; float16 emulates a phone's half floats, slowly");
  auto* target_error =
      group.add("--target-error", options->render.target_error, "",
                "Take samples until the picture's estimated relative error is this small");
  target_error->check(between(1e-9, 1.0));
  auto* time_limit = add_common(group, "--time-limit", options->render.time_limit,
                                ", with the samples that were taken");
  time_limit->check(between(1e-3, 1e7));
  group.add("--standard-error", options->standard_error, "ERROR.exr",
            fmt::format("Picture of the error of each value, from {} more renders with the next "
                        "seeds; for compare: --a-error ERROR.exr --shared-noise none",
                        kErrorRenders));
  group.add("--max-samples", options->render.max_samples, "", "Take at most so many rays a pixel")
      ->check(between(1, 1 << 20));
  auto* accuracy = group.add(
      "--accuracy", options->accuracy, "X|de2000=X",
      "Choose the cheapest lobe, precision and number of samples for this largest error of "
      "the peak, 1e-3, or this CIEDE2000 of 99 % of the pixels, de2000=1 (docs/cost.md)");
  // An empty text, too, is refused, which a script gives whose variable is not set.
  accuracy->check([](const std::string& text) {
    accuracy::parse_accuracy(text);
    return std::string();
  });
  accuracy->excludes(precision)->excludes(target_error)->excludes(time_limit);
  group
      .add_choice("--accuracy-check", options->accuracy_check, {"truth", "none"},
                  "Measure afterwards what --accuracy reached against the truth, or none")
      ->needs(accuracy);
  options->overrides.add_to(*command);
  command->footer(
      "One ray at each pixel's centre unless --samples says otherwise. Where a highlight is smaller\n"
      "than a pixel, the pixels around it are averaged, within 1e-3 of its energy; the plan says so.\n"
      "Farms and engines take the centre alone. The same scene gives the same file, byte for byte,\n"
      "whatever the number of threads; times are in the record.\n"
      "With --target-error or --time-limit a pixel takes 1, 2, 4, ... samples (mitchell: 2, 4,\n"
      "...) until one of the limits is reached; the record says which.\n"
      "With --accuracy the record and stderr say what was chosen, why, what was predicted, and what\n"
      "was reached; exit code 1 if that is not what was asked, 3 if nothing can reach it.\n\n"
      "Example: lobelia render reference_scenes/scenes/head_on.xml --model modified_phong "
      "--exponent 128 -o out.exr");
  command->callback([options, &code] { run_render(*options, code); });
}

}  // namespace lobelia::cli
