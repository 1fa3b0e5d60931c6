// lobelia export MODEL...
#include "renderer/export/export.hpp"

#include "base/system/files.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/messages.hpp"
#include "program/command/options.hpp"

namespace lobelia::cli {
namespace {

struct ExportArguments {
  std::string language, normalisation = "exact", coefficient = "computed", fresnel = "none",
                        precision = "float32", output;
  std::vector<std::string> models;
  LobeOption lobe;
  std::optional<double> exponent;
};

void run_export(const ExportArguments& options) {
  ShaderExport request;
  request.language =
      chosen(options.language, "--language", shader_language_names(), find_shader_language);
  Highlight highlight;
  for (const std::string& model : options.models) {
    set_chosen_model(highlight, model, "model");
    request.models.push_back(highlight.model);
  }
  request.lobe = options.lobe.lobe().value();
  if (std::ranges::count(options.models, kGgx) > 0) {
    const LobeId ggx = *find_lobe(kGgx);
    if (options.models.size() > 1 || (options.lobe.is_given() && request.lobe != ggx))
      throw Error(ExitCode::kUsage, "{} has a lobe of its own; export it alone, without --lobe",
                  kGgx);
    request.lobe = ggx;
  }
  request.normalisation =
      chosen(options.normalisation, "--normalisation", normalisation_names(), find_normalisation);
  request.exponent = options.exponent;
  request.coefficient =
      CoefficientFrom(chosen_place(options.coefficient, "--coefficient", kCoefficientNames));
  request.fresnel = chosen(options.fresnel, "--fresnel", fresnel_names(), find_fresnel);
  request.precision =
      ShaderPrecision(chosen_place(options.precision, "--precision", kShaderPrecisionNames));
  require_lobe({request.models.front(), request.lobe, request.normalisation,
                request.exponent.value_or(Highlight{}.exponent)});
  const std::string text = shader_text(request);
  if (request.exponent)
    warn_of({request.models.front(), request.lobe, request.normalisation, *request.exponent});
  if (options.output.empty())
    fmt::print("{}", text);
  else
    write_file(options.output, text);
}

}  // namespace

void add_export(CLI::App& app, ExitCode&) {
  auto* command = app.add_subcommand("export", "Write models as shader functions");
  auto options = std::make_shared<ExportArguments>();
  OptionGroup group(*command);
  group.add("MODEL", options->models, "", fmt::format("Models: {}", join(settable_models())))
      ->required();
  group
      .add("--language", options->language, "",
           fmt::format("Language: {}", join(shader_language_names())))
      ->required();
  options->lobe.add_to(group, "cosine");
  group
      .add("--normalisation", options->normalisation, "",
           fmt::format("Normalisation of the coefficient: {}", join(normalisation_names())))
      ->capture_default_str();
  group
      .add("--coefficient", options->coefficient, "",
           fmt::format("Where the function has the coefficient from: {}. As an argument, it is "
                       "computed once, by the host or in a vertex stage",
                       join(kCoefficientNames)))
      ->capture_default_str();
  group
      .add("--fresnel", options->fresnel, "",
           fmt::format(
               "Fresnel factor in the function, which then takes F0 and returns a colour: {}",
               join(fresnel_names())))
      ->capture_default_str();
  group
      .add("--exponent", options->exponent, "",
           "A number for n, and the coefficient with it, in place of a parameter. A lobe whose "
           "coefficient has no closed form needs this or --coefficient argument")
      ->check(between(kMinExponent, kMaxExponent));
  group
      .add("--precision", options->precision, "",
           fmt::format("Numbers of the functions: {}. mediump is for GLSL and min16float for HLSL, "
                       "with a formula that holds in half floats, for phones",
                       join(kShaderPrecisionNames)))
      ->capture_default_str();
  add_common(group, "--output", options->output, "; otherwise stdout", "FILE");
  command->footer(
      "What is written needs nothing of Lobelia, and says what each function returns, where the\n"
      "cosine is, and which integral its coefficient makes 1. Two exports may be used together; in\n"
      "WGSL, which has no preprocessor, without the functions that the second one repeats.\n"
      "\n"
      "Examples:\n"
      "  lobelia export --language glsl modified_phong blinn_phong_rdf --lobe cs16\n"
      "  lobelia export --language osl phong_rdf --lobe gauss --exponent 64 -o gauss.h\n"
      "  lobelia export --language wgsl phong_rdf --coefficient argument --fresnel schlick\n"
      "  lobelia export --language glsl blinn_phong_ndf --lobe cs16 --precision mediump\n"
      "  lobelia export --language povray modified_phong -o lobelia_modified_phong_cosine.inc");
  command->callback([options] { run_export(*options); });
}

}  // namespace lobelia::cli
