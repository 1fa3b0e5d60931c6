// lobelia convert [FILE] [--exponent N] [--to MODEL]
#include "studies/convert/convert.hpp"
#include "base/records/record.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/convert_measured.hpp"
#include "program/command/options.hpp"
#include "program/command/output_files.hpp"
#include "renderer/ggx.hpp"
#include "studies/measured/measured.hpp"

namespace lobelia::cli {
namespace {

struct ConvertArguments {
  std::string file, directory, from, to, measure = "max", json, svg;
  std::optional<double> exponent, alpha, roughness, f0;
  WorkLimits limits;
};

conversion::ShadingModel shading_model(const std::string& name, std::string_view option) {
  const auto& names = conversion::shading_model_names();
  return chosen(name, option, names, conversion::find_shading_model);
}

conversion::Measure measure_of(const ConvertArguments& options) {
  return conversion::Measure(
      chosen_place(options.measure, "--measure", records::kConversionMeasures));
}

conversion::Request request_of(const ConvertArguments& options) {
  if (options.to.empty())
    throw Error(ExitCode::kUsage, "--to is required, unless a FILE of materials is given");
  const int given =
      options.exponent.has_value() + options.alpha.has_value() + options.roughness.has_value();
  if (given > 1)
    throw Error(ExitCode::kUsage, "only one of --exponent, --alpha and --roughness can be given");
  conversion::Request request;
  request.to = shading_model(options.to, "--to");
  const bool from_exponent = given == 0 ? request.to.is_ggx() : options.exponent.has_value();
  const std::string usual = from_exponent ? "blinn_phong_heightfield" : "ggx";
  request.from = shading_model(options.from.empty() ? usual : options.from, "--from");
  if (given == 1 && request.from.is_ggx() == options.exponent.has_value())
    throw Error(ExitCode::kUsage, "--from {} takes {}", request.from.name(),
                request.from.is_ggx() ? "--alpha or --roughness" : "--exponent");
  request.parameter = options.exponent    ? *options.exponent
                      : options.alpha     ? *options.alpha
                      : options.roughness ? *options.roughness * *options.roughness
                                          : 0;
  request.f0 = options.f0.value_or(1);
  request.measure = measure_of(options);
  return request;
}

/// The outputs, the same for one parameter and for a range.
struct ConvertResult {
  std::string record, text, svg;
};

ConvertResult converted(const ConvertArguments& options) {
  const conversion::Request request = request_of(options);
  if (options.exponent || options.alpha || options.roughness) {
    records::Conversion conversion = conversion::convert(request);
    conversion.command = command_line();
    return {record_text(conversion), conversion::conversion_text(conversion),
            draw_chart_file(conversion::conversion_chart(conversion))};
  }
  records::ConversionTable table = conversion::convert_range(request);
  table.command = command_line();
  return {record_text(table), conversion::range_text(table),
          draw_chart_file(conversion::range_chart(table))};
}

void run_convert_file(const ConvertArguments& options) {
  if (options.exponent || options.alpha || options.roughness || !options.from.empty() ||
      !options.svg.empty())
    throw Error(
        ExitCode::kUsage,
        "a FILE says the highlights: leave out --from, --exponent, --alpha, --roughness, --svg");
  if (measured::is_measured(options.file)) {
    if (!options.to.empty() || options.f0)
      throw Error(ExitCode::kUsage,
                  "a measured FILE is fitted by every model: leave out --to, --f0");
    return convert_measured(options.file, options.directory, options.json);
  }
  if (!options.directory.empty())
    throw Error(ExitCode::kUsage, "--output is for a measured FILE, of MERL or RGL");
  std::optional<conversion::ShadingModel> to;
  if (!options.to.empty()) to = shading_model(options.to, "--to");
  OutputFiles outputs;
  outputs.reads(options.file);
  outputs.writes_report(options.json);
  records::ConvertedMaterials converted =
      conversion::convert_materials(options.file, to, options.f0, measure_of(options));
  converted.command = command_line();
  write_reports(conversion::materials_text(converted), {{options.json, record_text(converted)}});
}

void run_convert(const ConvertArguments& options) {
  if (!options.file.empty()) return run_convert_file(options);
  if (options.json == kStdout && options.svg == kStdout)
    throw Error(ExitCode::kUsage, "only one of --json and --svg can go to stdout");
  OutputFiles outputs;
  for (const std::string& path : {options.json, options.svg}) outputs.writes_report(path);
  const ConvertResult result = converted(options);
  write_reports(result.text, {{options.json, result.record}, {options.svg, result.svg}});
}

}  // namespace

void add_convert(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand(
      "convert",
      "Convert an exponent to a GGX roughness and back, between two models, or the materials of a "
      "file");
  auto options = std::make_shared<ConvertArguments>();
  OptionGroup from(*command, "From");
  from.add(
          "FILE", options->file, "",
          "Materials: .mtl, .gltf, .glb, .pov, .inc, or .xml of Mitsuba or Lobelia; a measured one: "
          "MERL's .binary, RGL's .bsdf")
      ->check(not_empty());
  from.add("--from", options->from, "",
           fmt::format("Model: {}; otherwise blinn_phong_heightfield for an exponent, else ggx",
                       join(conversion::shading_model_names())));
  from.add("--exponent", options->exponent, "", "Exponent n of a model of the catalogue")
      ->check(between(kMinExponent, kMaxExponent));
  from.add("--alpha", options->alpha, "", "Alpha of ggx")->check(between(kMinAlpha, kMaxAlpha));
  from.add("--roughness", options->roughness, "", "Roughness of ggx, the root of alpha")
      ->check(between(std::sqrt(kMinAlpha), std::sqrt(kMaxAlpha)));
  OptionGroup to(*command, "To");
  to.add("--to", options->to, "", "Model, as for --from; of a FILE otherwise every model");
  to.add("--measure", options->measure, "",
         fmt::format("Which best parameter comes first: {}", join(records::kConversionMeasures)))
      ->capture_default_str();
  to.add("--f0", options->f0, "",
         "Reflectance head on; ggx has Schlick's Fresnel factor for it. Default: a FILE's, or 1")
      ->check(between(1e-3, 1));
  OptionGroup output(*command, "Output");
  add_json(
      output, options->json,
      "conversion, of a range conversion-table, of a FILE converted-materials, of a measured one "
      "measured-fits");
  add_common(
      output, "--output", options->directory,
      ": of a measured FILE, its pictures beside those of the three best models, and their scenes",
      "DIR");
  output.add(
      "--svg", options->svg, "FILE|-",
      "Write a chart of both highlights, or of the range, with the rules of thumb; with - likewise");
  options->limits.add_to(output);
  command->footer(
      "A highlight is the light that leaves per steradian by the angle of the eye, with light along the\n"
      "normal of a flat surface. 'max' is the largest difference in % of the peak, 'misplaced' the energy\n"
      "of the difference in % of the energy; peak, width and energy are ratios. docs/convert.md defines\n"
      "each figure. Without a parameter, a table over exponents from 1 to 1024, or over roughness, is\n"
      "printed.\n"
      "\n"
      "Examples:\n"
      "  lobelia convert --exponent 32 --to ggx\n"
      "  lobelia convert --to ggx --svg roughness.svg\n"
      "  lobelia convert materials.mtl --to ggx\n"
      "  lobelia convert --roughness 0.5 --to modified_blinn_phong --measure width\n"
      "  lobelia convert --from phong_rdf --exponent 20 --to blinn_phong_rdf --svg both.svg\n"
      "  lobelia convert gold-paint.binary -o gold-paint\n"
      "\n"
      "A measured FILE is fitted by every model with every lobe over a diffuse base, with reflectances from 0 to 1 and\n"
      "an exponent from 1 to 1e6. The error is that of Ngan et al. 2005: of f_r N.L, weighted by solid\n"
      "angle, where light and eye are within 80 degrees of the normal. Highlights count most in it. 'rms %'\n"
      "is its root mean square of the measurement's, 'max %' the largest one of the largest value. 'dE2000'\n"
      "is the mean CIEDE2000 over the spheres head_on and oblique_45 and 'max' its largest, with a white\n"
      "diffuse surface as white. Printed are each model's best lobe and cosine; the record has all fits.\n"
      "A MERL file has a value for each cell, so that small highlights of its pictures have steps. Of an RGL\n"
      "file the eye takes the place of its theta_i.\n"
      "\n"
      "Exit codes: 0 done, 2 usage, 3 a file cannot be read, 4 an output cannot be written.");
  command->callback([options] { options->limits.run([&] { run_convert(*options); }); });
}

}  // namespace lobelia::cli
