#include "renderer/export/export.hpp"

#include <fmt/format.h>

#include <cctype>
#include <regex>

#include "base/pictures/half.hpp"
#include "base/system/error.hpp"
#include "base/system/version.hpp"
#include "base/words/constants.hpp"
#include "base/words/numbers.hpp"
#include "base/words/text.hpp"
#include "renderer/export/languages.hpp"
#include "renderer/export/names.hpp"
#include "renderer/export/povray.hpp"
#include "renderer/lobes/catalogue.hpp"
#include "renderer/models/catalogue.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view gpu_head, gpu_geometry, gpu_geometry_half, gpu_lobe, gpu_energy,
    gpu_coefficient, gpu_fresnel, gpu_smith, gpu_highlight;
}
namespace {

using HWY_NAMESPACE::LobesById;
using HWY_NAMESPACE::Models;

constexpr std::string_view kFloat32Note =
    "Written for float32: with a sharp highlight there is no power of a cosine, which would not know the\n"
    "// angle, and no difference of numbers that nearly agree.";
constexpr std::string_view kHalfNote =
    "Written for half floats, for n = 8 to 1024. Rounded vectors are the largest error: keep them in float32\n"
    "// until their difference is taken, if you can. docs/export.md has the errors.";

struct LobeForm {
  LobeText text;
  PaperColumn column;
};
LobeForm lobe_form(const LobeId& id) {
  static constexpr auto kForms =
      map_types<LobeForm (*)(LobeParameters)>(LobesById{}, []<class L>() {
        return +[](LobeParameters p) { return LobeForm{L(p).text(), L(p).paper_column()}; };
      });
  return kForms.at(id.index)({1, id});
}

struct ModelForm {
  CoefficientTexts texts;
  EnergyIntegral energy;
  double share;
};
const ModelForm& model_form(ModelId id) {
  static constexpr auto kForms = map_types<ModelForm>(Models{}, []<class M>() {
    return ModelForm{M::kTexts, M::kEnergy, M::kShare};
  });
  return kForms.at(id.index);
}

/// The coefficient as a formula of n; empty if there is none.
std::string coefficient_formula(const Highlight& highlight) {
  const ModelForm& model = model_form(highlight.model);
  const LobeForm lobe = lobe_form(highlight.lobe);
  const std::string share = model.share == 1 ? "" : float32_text(model.share) + " * ";
  const std::string pi = float32_text(kPi);
  if (highlight.normalisation == Normalisation::kPaper)
    return share + fill(lobe.column == PaperColumn::kCosine ? model.texts.paper_cosine
                                                            : model.texts.paper_cs16,
                        {{"pi", pi}});
  // The integral of GGX times its cosine is that of cos^n: 1 / (n + 2).
  const EnergyIntegral& energy = model.energy;
  const bool is_projected = energy.s_max == 1 && energy.weights == std::array{1.0, -1.0, 0.0, 0.0};
  if (lobe.column == PaperColumn::kCosine || (is_projected && info(highlight.lobe).name == kGgx))
    return share + fill(model.texts.exact_cosine, {{"pi", pi}});
  if (lobe.text.slope.empty()) return "";
  return fmt::format("{} / lobelia_{}_energy(n, {}, {}, {}, {}, {})",
                     float32_text(model.share / (2 * kPi)), identifier(highlight.lobe),
                     float32_text(energy.s_max), float32_text(energy.weights[0]),
                     float32_text(energy.weights[1]), float32_text(energy.weights[2]),
                     float32_text(energy.weights[3]));
}

std::string normalisation_note(const Highlight& highlight) {
  const std::string quarter =
      model_form(highlight.model).share == 1
          ? ""
          : "\n// That is the distribution's; the one here is a quarter of it, because f_r = D / 4.";
  if (highlight.normalisation == Normalisation::kPaper)
    return fmt::format(
               "The coefficient is the paper's, given for n = {:g} to {:g}, misprints included; it is\n"
               "// meant to make this 1:\n//   {}.",
               kPaperMinExponent, kPaperMaxExponent, info(highlight.model).integral) +
           quarter;
  return "The coefficient makes this 1 for the lobe:\n//   " +
         std::string(info(highlight.model).integral) + "." + quarter;
}

/// Writes functions in one of gpu_languages().
class Writer {
 public:
  Writer(const GpuLanguage& language, const ShaderExport& request)
      : language_(language),
        fixed_(request.exponent.has_value()),
        argument_(request.coefficient == CoefficientFrom::kArgument),
        half_(request.precision != ShaderPrecision::kFloat32),
        fresnel_(request.fresnel != Fresnel::kNone) {}

  void add(const Highlight& highlight) {
    const double constant = radiance_coefficient(highlight);  // throws if the paper has none
    const std::string formula = coefficient_formula(highlight);
    if (!fixed_ && !argument_ && formula.empty())
      throw Error(ExitCode::kUsage,
                  "the exact coefficient of the lobe '{}' has no closed form; give the "
                  "exponent that it is for: --exponent N, or take the coefficient as an "
                  "argument: --coefficient argument",
                  info(highlight.lobe).name);
    add_lobe(highlight.lobe, half_);
    if (fresnel_) add_part("lobelia_fresnel", embedded::gpu_fresnel, half_);
    if (info(highlight.model).has_shadowing) add_part("lobelia_smith", embedded::gpu_smith, half_);
    const std::string with_coefficient = function_name(highlight, fixed_),
                      function = function_name(highlight, fixed_, fresnel_);
    if (!fixed_ && !formula.empty()) add_coefficient(highlight, with_coefficient, formula);
    const std::string coefficient =
        fixed_ ? float32_text(constant)
               : (argument_ ? "coefficient" : with_coefficient + "_coefficient(exponent)");
    // Languages with guards have overloads, so that the name may be the same.
    add_part(argument_ ? function + "_argument" : function,
             highlight_text(highlight, function, coefficient, argument_note(highlight, formula)),
             half_);
  }
  const std::string& text() const { return parts_.text(); }

 private:
  void add_part(std::string name, std::string_view part, bool half = false) {
    std::string text = fill(part, {{"vec3", language_.vector},
                                   {"colour", language_.colour},
                                   {"inline", language_.function},
                                   {"normal", language_.normal}});
    if (language_.translate) text = language_.translate(text);
    if (half) {
      // Names of their own, so that both precisions may be used together.
      static const std::regex function("\\b(lobelia_\\w+)\\(");
      const std::string suffix = fmt::format("_{}", language_.half_word);
      text = std::regex_replace(language_.narrow(text), function, "$1" + suffix + "(");
      for (std::size_t at; (at = text.find("_coefficient" + suffix)) != std::string::npos;)
        text.erase(at + std::string_view("_coefficient").size(), suffix.size());
      name += suffix;
    }
    // In capitals: a macro with the function's own name would replace the function.
    for (char& c : name) c = char(std::toupper(static_cast<unsigned char>(c)));
    parts_.add(name, text);
  }

  void add_lobe(const LobeId& lobe, bool half) {
    const LobeInfo& about = info(lobe);
    add_part("lobelia_geometry", half ? embedded::gpu_geometry_half : embedded::gpu_geometry, half);
    const std::string name = identifier(lobe);
    const LobeText text = lobe_form(lobe).text;
    add_part(fmt::format("lobelia_{}_lobe", name),
             fill(embedded::gpu_lobe,
                  {{"title", about.title},
                   {"formula", about.formula},
                   {"source", about.source},
                   {"scale_note",
                    half ? "\n// Here `s` is 1024 times as large, and `n` that much smaller." : ""},
                   {"lobe", name},
                   {"body", half && !text.half_body.empty() ? text.half_body : text.body}}),
             half);
  }

  void add_coefficient(const Highlight& highlight, const std::string& function,
                       const std::string& formula) {
    const LobeForm lobe = lobe_form(highlight.lobe);
    if (formula.find("_energy(") != formula.npos) {
      add_lobe(highlight.lobe, false);
      add_part(fmt::format("lobelia_{}_energy", identifier(highlight.lobe)),
               fill(embedded::gpu_energy,
                    {{"lobe", identifier(highlight.lobe)}, {"slope", lobe.text.slope}}));
    }
    add_part(function + "_coefficient",
             fill(embedded::gpu_coefficient, {{"function", function}, {"coefficient", formula}}));
  }

  std::string argument_note(const Highlight& highlight, const std::string& formula) const {
    std::string note;
    if (argument_ && formula.empty())
      note =
          "\n// `coefficient` has no closed form: the command above writes it as a number with --exponent N in "
          "place\n// of --coefficient argument.";
    else if (argument_)
      note =
          fmt::format("\n// `coefficient` is {}_coefficient(exponent).", function_name(highlight));
    if (fresnel_)
      note +=
          "\n// `reflectance` is F0 of the Fresnel factor: the colour of the highlight, head on.";
    return note;
  }

  /// Behind the three vectors.
  std::string parameters() const {
    std::string all;
    if (!fixed_) all = ", float exponent";
    if (argument_) all += ", float coefficient";
    if (fresnel_) all += ", %colour% reflectance";
    return argument_ || fresnel_ ? ",\n    " + all.substr(2) : all;
  }

  std::string highlight_text(const Highlight& highlight, const std::string& function,
                             const std::string& coefficient,
                             const std::string& argument_note) const {
    const ModelInfo& model = info(highlight.model);
    const bool mirror = model.angle == LobeAngle::kReflection, cosine = model.applies_cosine;
    return fill(
        embedded::gpu_highlight,
        {{"heading",
          heading(highlight) + (fixed_ ? fmt::format(", n = {}", highlight.exponent) : "")},
         {"model_source", model.source},
         {"angle", mirror ? "L and the mirror image of V" : "N and the half vector of L and V"},
         {"times_cosine", model.has_shadowing ? " * G / (N.V)"
                          : cosine            ? " * N.L"
                                              : ""},
         {"cosine_note", cosine ? "N.L is in it: do not multiply by it again."
                                : "There is no N.L in it, by definition: do not multiply by it."},
         {"normalisation_note", normalisation_note(highlight)},
         {"argument_note", argument_note},
         {"result", fresnel_ ? "%colour%" : "float"},
         {"parameters", parameters()},
         {"which", mirror ? "mirror" : "half"},
         {"coefficient", coefficient},
         {"lobe", identifier(highlight.lobe)},
         {"exponent", fixed_  ? float32_text(highlight.exponent / (half_ ? kHalfScale : 1))
                      : half_ ? "exponent / 1024.0"
                              : "exponent"},
         {"right_angle", half_ ? "1024" : "1"},
         {"scale", half_ ? "1024 (" : ""},
         {"scale_end", half_ ? ")" : ""},
         {"factor", model.has_shadowing
                        ? fmt::format("\n            * lobelia_smith({}, n_dot_l, dot({}, to_eye))",
                                      fixed_ ? float32_text(highlight.exponent) : "exponent",
                                      language_.normal)
                    : cosine ? " * n_dot_l"
                             : ""},
         {"fresnel", fresnel_ ? " * lobelia_fresnel(reflectance, to_eye, to_light)" : ""},
         {"function", function}});
  }

  const GpuLanguage& language_;
  bool fixed_, argument_, half_, fresnel_;
  Parts parts_{language_.guard_begin, language_.guard_end};
};

std::string command_of(const ShaderExport& request) {
  std::string command =
      fmt::format("lobelia export --language {}", shader_language_names()[request.language.index]);
  for (const ModelId model : request.models) command += fmt::format(" {}", info(model).name);
  command += fmt::format(" --lobe {}", info(request.lobe).name);
  if (request.lobe.formula) command += " --formula " + shell_quote(request.lobe.formula->text());
  command += fmt::format(" --normalisation {}", name(request.normalisation));
  if (request.exponent) command += fmt::format(" --exponent {}", *request.exponent);
  if (request.coefficient != CoefficientFrom::kComputed)
    command += fmt::format(" --coefficient {}", kCoefficientNames[int(request.coefficient)]);
  if (request.fresnel != Fresnel::kNone)
    command += fmt::format(" --fresnel {}", name(request.fresnel));
  if (request.precision != ShaderPrecision::kFloat32)
    command += fmt::format(" --precision {}", kShaderPrecisionNames[int(request.precision)]);
  return command;
}

void require_half_floats(const ShaderExport& request, const GpuLanguage& language) {
  const std::string_view word = kShaderPrecisionNames[int(request.precision)];
  if (word != language.half_word)
    throw Error(ExitCode::kUsage,
                "--precision {}: not in {}, which has {}; mediump is GLSL's, and "
                "min16float is HLSL's",
                word, language.title,
                language.half_word.empty() ? "float32 alone"
                                           : "float32 and " + std::string(language.half_word));
  if (request.lobe.formula)
    throw Error(ExitCode::kUsage,
                "--precision {}: a formula may not hold in half floats; take a lobe of "
                "the catalogue, or leave --precision out",
                word);
  if (request.exponent.value_or(1) > kGreatestHalf)
    throw Error(ExitCode::kUsage, "--precision {}: --exponent is at most {}", word, kGreatestHalf);
}

std::string gpu_text(const ShaderExport& request, const std::vector<Highlight>& highlights) {
  if (request.exponent && request.coefficient == CoefficientFrom::kArgument)
    throw Error(ExitCode::kUsage,
                "with --exponent the coefficient is a number in what is exported; leave "
                "--coefficient argument out, or --exponent");
  const GpuLanguage& language = gpu_languages()[request.language.index];
  const bool half = request.precision != ShaderPrecision::kFloat32;
  if (half) require_half_floats(request, language);
  Writer writer(language, request);
  for (const Highlight& highlight : highlights) writer.add(highlight);
  const std::string begin = language.begin.empty() ? "" : "\n" + std::string(language.begin);
  return fill(embedded::gpu_head,
              {{"language", language.title},
               {"version", kNameAndVersion},
               {"command", command_of(request)},
               {"paper", kPaper},
               {"colour_note", request.fresnel == Fresnel::kNone
                                   ? " and by the colour of the highlight"
                                   : "; `reflectance` is the highlight's colour"},
               {"exponent_note", request.exponent ? ""
                                 : half           ? "\n// `exponent` is 1 to 65504."
                                                  : "\n// `exponent` is 0 to 1e8."},
               {"precision_note", half ? kHalfNote : kFloat32Note},
               {"normal", language.normal},
               {"note", half ? language.half_note : language.note}}) +
         begin + writer.text() + (half ? std::string(language.half_end) : "");
}

/// POV-Ray's part is a pattern, which is one number, and a macro for the coefficient.
std::string checked_povray_text(const ShaderExport& request,
                                const std::vector<Highlight>& highlights) {
  const auto refuse = [](const char* what) {
    throw Error(ExitCode::kUsage, "for POV-Ray {}", what);
  };
  if (request.exponent)
    refuse("the exponent is an argument of what is exported; leave --exponent out");
  if (request.coefficient != CoefficientFrom::kComputed)
    refuse("the coefficient always is a macro of its own; leave --coefficient out");
  if (request.fresnel != Fresnel::kNone)
    refuse("what is exported has no Fresnel factor; leave --fresnel out");
  if (request.precision != ShaderPrecision::kFloat32)
    refuse("all numbers are float64; leave --precision out");
  return povray_text(highlights);
}

}  // namespace

std::span<const std::string_view> shader_language_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const GpuLanguage& language : gpu_languages()) all.push_back(language.name);
    all.push_back("povray");
    return all;
  }();
  return names;
}
std::optional<ShaderLanguage> find_shader_language(std::string_view name) {
  return find_id<ShaderLanguage>(shader_language_names(), name);
}

std::string shader_text(const ShaderExport& request) {
  std::vector<Highlight> highlights;
  for (const ModelId model : request.models)
    highlights.push_back(
        {model, request.lobe, request.normalisation, request.exponent.value_or(1)});
  return request.language.index < gpu_languages().size() ? gpu_text(request, highlights)
                                                         : checked_povray_text(request, highlights);
}

}  // namespace lobelia
