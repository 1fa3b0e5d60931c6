// lobelia check-shader FILE
#include "base/records/record.hpp"
#include "base/system/files.hpp"
#include "base/system/standard_streams.hpp"
#include "base/words/text.hpp"
#include "program/command/check_shader_bsdf.hpp"
#include "program/command/commands.hpp"
#include "program/command/common_options.hpp"
#include "program/command/options.hpp"
#include "program/command/output_files.hpp"
#include "program/command/watch.hpp"
#include "studies/shader_check/annotation.hpp"
#include "studies/shader_check/arguments.hpp"
#include "studies/shader_check/check.hpp"
#include "studies/shader_check/explain.hpp"
#include "studies/shader_check/mistakes_document.hpp"

namespace lobelia::cli {
namespace {

constexpr std::uint64_t kMaxShaderBytes = 1 << 20;
constexpr std::string_view kOnNames[] = {"egl", "vulkan"};

struct CheckShaderArguments {
  std::string file, function, arguments, model, lobe, normalisation = "exact", language, on, json,
                                                      html, format = "text";
  std::vector<double> exponents{std::begin(shader_check::kUsualExponents),
                                std::end(shader_check::kUsualExponents)};
  std::vector<std::string> settings;
  double time_limit = kShaderTimeLimit.count();
  bool no_costs = false, watch = false;
  BsdfOptions bsdf;
};

/// By --language, or by the ending of the file.
ShaderText language_of(const CheckShaderArguments& options) {
  const std::string ending = std::filesystem::path(options.file).extension().string();
  const std::string name = !options.language.empty()              ? options.language
                           : ending == ".hlsl" || ending == ".fx" ? "hlsl"
                           : ending == ".wgsl"                    ? "wgsl"
                                                                  : "glsl";
  return ShaderText(chosen_place(name, "--language", kShaderTextNames));
}

/// By --on, which only GLSL has a choice of.
ShaderApi api_of(const CheckShaderArguments& options, ShaderText language) {
  const ShaderApi usual = language == ShaderText::kGlsl   ? ShaderApi::kEgl
                          : language == ShaderText::kHlsl ? ShaderApi::kVulkan
                                                          : ShaderApi::kWebGpu;
  if (options.on.empty()) return usual;
  const auto chosen_api = ShaderApi(chosen_place(options.on, "--on", kOnNames));
  if (language != ShaderText::kGlsl && chosen_api != usual)
    throw Error(ExitCode::kUsage, "--on {}: {} runs on {} alone", options.on,
                kShaderTextNames[std::size_t(language)], kShaderApiNames[std::size_t(usual)]);
  return chosen_api;
}

/// "NAME=VALUE"
std::pair<std::string, std::string> setting_of(const std::string& setting) {
  const std::size_t sign = setting.find('=');
  if (sign == setting.npos || sign == 0 || sign + 1 == setting.size())
    throw Error(ExitCode::kUsage, "--set '{}': NAME=VALUE is expected, such as uShininess=n",
                printable(setting));
  return {setting.substr(0, sign), setting.substr(sign + 1)};
}

shader_check::bsdf::BsdfRequest bsdf_request_of(const CheckShaderArguments& options) {
  shader_check::bsdf::BsdfRequest request;
  request.file = options.file;
  request.text = read_file(options.file, kMaxShaderBytes);
  request.language = language_of(options);
  request.api = api_of(options, request.language);
  request.time_limit = std::chrono::duration<double>(options.time_limit);
  for (const std::string& setting : options.settings)
    request.settings.push_back(setting_of(setting));
  if (!std::ranges::equal(options.exponents, shader_check::kUsualExponents))
    request.exponents = options.exponents;
  for (const auto& [name, value] : {std::pair{"--function", &options.function},
                                    {"--arguments", &options.arguments},
                                    {"--model", &options.model},
                                    {"--html", &options.html}})
    if (!value->empty()) throw Error(ExitCode::kUsage, "{}: not with --bsdf", name);
  set_bsdf_options(options.bsdf, request);
  return request;
}

bool has_coefficient(const Highlight& highlight) {
  try {
    radiance_coefficient(highlight);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// That of --model, or all that the other options allow.
void add_highlight(const CheckShaderArguments& options, shader_check::Request& request) {
  Highlight& highlight = request.highlight;
  highlight.lobe = chosen(options.lobe.empty() ? "cosine" : options.lobe, "--lobe", lobe_names(),
                          allowed_lobes(), find_lobe);
  highlight.normalisation =
      chosen(options.normalisation, "--normalisation", normalisation_names(), find_normalisation);
  if (!options.model.empty()) {
    const LobeId lobe = highlight.lobe;
    set_chosen_model(highlight, options.model, "--model");
    if (!options.lobe.empty()) highlight.lobe = lobe;
    radiance_coefficient(highlight);  // throws if the paper has none
    return;
  }
  std::vector<Highlight> all = shader_check::all_highlights();
  if (!options.lobe.empty()) {
    all.clear();
    for (const ModelId model : all_models()) all.push_back({model, highlight.lobe});
  }
  for (Highlight& one : all) {
    one.normalisation = highlight.normalisation;
    if (one.normalisation == Normalisation::kExact || has_coefficient(one))
      request.highlights.push_back(one);
  }
  if (request.highlights.empty())
    throw Error(ExitCode::kUsage, "--normalisation {}: the paper has none for the lobe {}",
                name(highlight.normalisation), info(highlight.lobe).name);
  highlight = request.highlights.front();
}

shader_check::Request request_of(const CheckShaderArguments& options) {
  shader_check::Request request;
  request.file = options.file;
  request.language = language_of(options);
  request.api = api_of(options, request.language);
  request.function = options.function;
  request.arguments = options.arguments;
  for (const std::string& setting : options.settings)
    request.settings.push_back(setting_of(setting));
  add_highlight(options, request);
  request.exponents = options.exponents;
  // In the middle: neither a blur nor a dot.
  std::ranges::sort(request.exponents);
  const auto again = std::ranges::unique(request.exponents);
  request.exponents.erase(again.begin(), again.end());
  request.shown_exponent = request.exponents[request.exponents.size() / 2];
  request.time_limit = std::chrono::duration<double>(options.time_limit);
  request.costs = !options.no_costs;
  request.worst_spheres = !options.html.empty();
  request.text = read_file(options.file, kMaxShaderBytes);
  return request;
}

ExitCode check_once(const CheckShaderArguments& options) {
  const bool json_to_stdout = options.json == kStdout;
  if (options.bsdf.is_wanted) return run_check_bsdf(bsdf_request_of(options), options.json);
  const shader_check::Request request = request_of(options);
  shader_check::Check check = shader_check::check_shader(request);
  check.record.command = command_line();
  FilesTogether files;
  if (!options.json.empty() && !json_to_stdout) write_record(options.json, check.record);
  if (!options.html.empty()) write_file(options.html, shader_check::report_page(check));
  files.commit();
  fmt::print("{}", json_to_stdout ? records::record_text(check.record)
                                  : shader_check::report_text(check.record));
  if (options.format == "github")
    fmt::print("{}", shader_check::annotation_text(
                         check.record, {request.language, request.file, request.text, {}}));
  return check.record.verdict == "passes" ? ExitCode::kSuccess : ExitCode::kDiffers;
}

ExitCode run_check_shader(const CheckShaderArguments& options) {
  OutputFiles outputs;
  outputs.reads(options.file);
  outputs.writes_report(options.json);
  if (!options.html.empty()) {
    outputs.writes(options.html);
    require_writable(options.html);
  }
  if (options.json == kStdout && options.format == "github")
    throw Error(ExitCode::kUsage,
                "only one of --json and --format github can go to stdout; give --json a file");
  if (options.watch) run_at_changes(options.file, [&] { check_once(options); });
  return check_once(options);
}

std::string arguments_help() {
  std::string text =
      "What the function takes, in its order; otherwise by the names and types of its parameters:";
  for (const auto& argument : shader_check::argument_infos())
    text += fmt::format(" {} ({}),", argument.name, argument.meaning);
  return text + " or a number. With a minus sign a vector points to the surface";
}

}  // namespace

void add_check_shader(CLI::App& app, ExitCode& exit_code) {
  auto* command = app.add_subcommand(
      "check-shader", "Run a shader function, and say which model it is and what is wrong");
  auto options = std::make_shared<CheckShaderArguments>();
  OptionGroup shader(*command, "Shader");
  shader.add("FILE", options->file, "FILE", "GLSL, HLSL or WGSL with the function")->required();
  shader.add(
      "--function", options->function, "NAME",
      "The function: its result is radiance for unit irradiance; otherwise main, the entry of the "
      "fragment stage, or the one that no other calls");
  shader.add("--arguments", options->arguments, "LIST", arguments_help());
  shader
      .add(
          "--set", options->settings, "NAME=VALUE",
          "The value of a uniform, an input, a texture or any other variable: a number, a word of "
          "--arguments, or a list of them, such as uShininess=n, SpecColor=1,1,1 or lights[0].pos=L. "
          "May be repeated")
      ->allow_extra_args(false);
  shader.add("--language", options->language, "",
             fmt::format("Language: {}; otherwise by the file's ending", join(kShaderTextNames)));
  shader.add("--on", options->on, "",
             fmt::format("What runs GLSL: {}; otherwise egl. HLSL runs on vulkan, WGSL in Chromium",
                         join(kOnNames)));
  add_common(shader, "--time-limit", options->time_limit,
             ": a shader that has not ended then is refused, and costs that are not measured then "
             "are left out")
      ->check(between(0.1, 3600))
      ->capture_default_str();
  OptionGroup model(*command, "Model");
  model.add("--model", options->model, "",
            fmt::format("Model: {}; otherwise the one that explains the shader best",
                        join(settable_models())));
  model.add("--lobe", options->lobe, "",
            fmt::format("Lobe: {}; otherwise cosine, and without --model any", allowed_lobes()));
  model
      .add("--normalisation", options->normalisation, "",
           fmt::format("Normalisation of the coefficient: {}", join(normalisation_names())))
      ->capture_default_str();
  model
      .add(
          "--exponent", options->exponents, "N",
          "Exponents to check; otherwise 1, 4, 16, 64, 256 and 1000, and with --bsdf 1, 16 and 256")
      ->check(between(kMinExponent, kMaxExponent))
      ->expected(1, 20)
      ->delimiter(',');
  add_bsdf_options(*command, options->bsdf);
  OptionGroup output(*command, "Output");
  command
      ->add_flag_callback(
          "--list-mistakes",
          [] {
            fmt::print("{}", shader_check::mistakes_document());
            throw CLI::Success();
          },
          "List the mistakes that have a name (docs/shader_mistakes.md)")
      ->trigger_on_parse()  // before FILE is asked for
      ->group("Output");
  add_json(output, options->json, "shader-check, or with --bsdf bsdf-check");
  output.add("--html", options->html, "FILE",
             "Write a page with spheres, maps of the error and a plot");
  output.add_choice(
      "--format", options->format, {"text", "github"},
      "With github, print a line for a shader that differs besides, which GitHub Actions "
      "shows beside the change");
  output.add_flag("--watch", options->watch, "Check again whenever FILE changes, until Ctrl-C");
  output.add_flag("--no-costs", options->no_costs, "Measure neither half floats nor instructions");
  command->footer(
      "The shader runs in a process of its own, on the first graphics processor that has a driver, or\n"
      "else on Mesa's software renderers. docs/check_shader.md is a tutorial, docs/shader_mistakes.md\n"
      "lists the mistakes that have a name.\n"
      "\n"
      "Examples:\n"
      "  lobelia check-shader mine.glsl\n"
      "  lobelia check-shader mine.frag --set lightColor=1,1,1\n"
      "  lobelia check-shader mine.glsl --function myHighlight --model blinn_phong_ndf\n"
      "  lobelia check-shader mine.frag --set lightColor=1,1,1 --model modified_phong\n"
      "  lobelia check-shader mine.hlsl --function spec --arguments cosine,roughness --model phong_rdf\n"
      "  lobelia check-shader ggx.glsl --bsdf\n"
      "\n"
      "Exit codes: 0 it is the model, 1 it differs, 2 usage, 3 it does not compile, end or write, 4 an\n"
      "output cannot be written, 5 nothing runs shaders here, or the driver failed.");
  command->callback([options, &exit_code] { exit_code = run_check_shader(*options); });
}

}  // namespace lobelia::cli
