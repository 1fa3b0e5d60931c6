#include "shaders/export.hpp"

#include <fmt/format.h>

#include <cctype>

#include "core/constants.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "core/version.hpp"
#include "renderer/lobes/catalogue.hpp"
#include "renderer/models/catalogue.hpp"
#include "shaders/names.hpp"
#include "shaders/povray.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view gpu_head, gpu_geometry, gpu_lobe, gpu_energy, gpu_coefficient,
    gpu_highlight;
}
namespace {

using HWY_NAMESPACE::Lobes;
using HWY_NAMESPACE::Models;

struct Language {
  std::string_view title, note;
  std::string_view vec3;    ///< the type of a vector
  std::string_view normal;  ///< name of a parameter; "normal" is a word of OSL's own
};
constexpr Language kLanguages[] = {
    {"GLSL",
     "For every version of GLSL and GLSL ES (WebGL); ask for highp floats where there is a choice.",
     "vec3", "normal"},
    {"HLSL", "For every shader model.", "float3", "normal"},
    {"OSL", "To be included before a shader, where to_eye is -I and surface_normal is N.", "vector",
     "surface_normal"}};
constexpr std::string_view kNames[] = {"glsl", "hlsl", "osl", "povray"};
constexpr std::size_t kPovray = 3;

struct LobeForm {
  LobeText text;
  PaperColumn column;
};
LobeForm lobe_form(LobeId id) {
  static constexpr auto kForms = map_types<LobeForm (*)(LobeParameters)>(Lobes{}, []<class L>() {
    return +[](LobeParameters p) { return LobeForm{L(p).text(), L(p).paper_column()}; };
  });
  return kForms.at(id.index)({1, id.order});
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

/// With the digits of float32, and a point: 4 would be an integer.
std::string number(double value) {
  std::string text = fmt::format("{:.9g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

/// The coefficient as a formula of n; empty if there is none.
std::string coefficient_formula(const Highlight& highlight) {
  const ModelForm& model = model_form(highlight.model);
  const LobeForm lobe = lobe_form(highlight.lobe);
  const std::string share = model.share == 1 ? "" : number(model.share) + " * ";
  const std::string pi = number(kPi);
  if (highlight.normalisation == Normalisation::kPaper)
    return share + fill(lobe.column == PaperColumn::kCosine ? model.texts.paper_cosine
                                                            : model.texts.paper_cs16,
                        {{"pi", pi}});
  if (lobe.column == PaperColumn::kCosine)
    return share + fill(model.texts.exact_cosine, {{"pi", pi}});
  if (lobe.text.slope.empty()) return "";
  const EnergyIntegral& energy = model.energy;
  return fmt::format("{} / lobelia_{}_energy(n, {}, {}, {}, {}, {})",
                     number(model.share / (2 * kPi)), info(highlight.lobe).name,
                     number(energy.s_max), number(energy.weights[0]), number(energy.weights[1]),
                     number(energy.weights[2]), number(energy.weights[3]));
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
  return "The energy is 1 at normal incidence: the coefficient makes this 1 for the lobe\n//   " +
         std::string(info(highlight.model).integral) + "." + quarter;
}

/// Writes functions in GLSL, HLSL or OSL. With a fixed exponent it is part of the function, otherwise a parameter.
class Writer {
 public:
  Writer(const Language& language, bool fixed) : language_(language), fixed_(fixed) {}

  void add(const Highlight& highlight) {
    const double constant = radiance_coefficient(highlight);  // throws if the paper has none
    const std::string formula = coefficient_formula(highlight);
    if (!fixed_ && formula.empty())
      throw Error(ExitCode::kUsage,
                  fmt::format("the exact coefficient of the lobe '{}' has no closed form; give the "
                              "exponent that it is for: --exponent N",
                              info(highlight.lobe).name));
    add_lobe(highlight.lobe);
    const std::string function = function_name(highlight, fixed_);
    if (!fixed_) add_coefficient(highlight, function, formula);
    add_part(function, highlight_text(highlight, function, constant));
  }
  const std::string& text() const { return parts_.text(); }

 private:
  void add_part(std::string name, const std::string& text) {
    // In capitals: a macro with the function's own name would replace the function.
    for (char& c : name) c = char(std::toupper(static_cast<unsigned char>(c)));
    parts_.add(name, fill(text, {{"vec3", language_.vec3}, {"normal", language_.normal}}));
  }

  void add_lobe(LobeId lobe) {
    const LobeInfo& about = info(lobe);
    add_part("lobelia_geometry", std::string(embedded::gpu_geometry));
    add_part(fmt::format("lobelia_{}_lobe", about.name),
             fill(embedded::gpu_lobe, {{"title", about.title},
                                       {"formula", about.formula},
                                       {"source", about.source},
                                       {"lobe", about.name},
                                       {"body", lobe_form(lobe).text.body}}));
  }

  void add_coefficient(const Highlight& highlight, const std::string& function,
                       const std::string& formula) {
    const LobeForm lobe = lobe_form(highlight.lobe);
    if (highlight.normalisation == Normalisation::kExact && lobe.column != PaperColumn::kCosine)
      add_part(fmt::format("lobelia_{}_energy", info(highlight.lobe).name),
               fill(embedded::gpu_energy,
                    {{"lobe", info(highlight.lobe).name}, {"slope", lobe.text.slope}}));
    add_part(function + "_coefficient",
             fill(embedded::gpu_coefficient, {{"function", function}, {"coefficient", formula}}));
  }

  std::string highlight_text(const Highlight& highlight, const std::string& function,
                             double constant) const {
    const ModelInfo& model = info(highlight.model);
    const bool mirror = model.angle == LobeAngle::kReflection, cosine = model.applies_cosine;
    return fill(
        embedded::gpu_highlight,
        {{"heading",
          heading(highlight) + (fixed_ ? fmt::format(", n = {}", highlight.exponent) : "")},
         {"model_source", model.source},
         {"angle", mirror ? "L and the mirror image of V" : "N and the half vector of L and V"},
         {"times_cosine", cosine ? " * N.L" : ""},
         {"cosine_note", cosine ? "N.L is in it: do not multiply by it again."
                                : "There is no N.L in it, by definition: do not multiply by it."},
         {"normalisation_note", normalisation_note(highlight)},
         {"parameter", fixed_ ? "" : ", float exponent"},
         {"which", mirror ? "mirror" : "half"},
         {"coefficient",
          fixed_ ? number(constant) : fmt::format("{}_coefficient(exponent)", function)},
         {"lobe", info(highlight.lobe).name},
         {"exponent", fixed_ ? number(highlight.exponent) : "exponent"},
         {"factor", cosine ? " * n_dot_l" : ""},
         {"function", function}});
  }

  const Language& language_;
  bool fixed_;
  Parts parts_{"#ifndef %name%\n#define %name%\n", "#endif\n"};
};

std::string command_of(const ShaderExport& request) {
  std::string command = fmt::format("lobelia export --language {}", kNames[request.language.index]);
  for (const ModelId model : request.models) command += fmt::format(" {}", info(model).name);
  command += fmt::format(" --lobe {} --normalisation {}", info(request.lobe).name,
                         name(request.normalisation));
  return command + (request.exponent ? fmt::format(" --exponent {}", *request.exponent) : "");
}

}  // namespace

std::span<const std::string_view> shader_language_names() { return kNames; }
std::optional<ShaderLanguage> find_shader_language(std::string_view name) {
  return find_id<ShaderLanguage>(kNames, name);
}

std::string shader_text(const ShaderExport& request) {
  std::vector<Highlight> highlights;
  for (const ModelId model : request.models)
    highlights.push_back(
        {model, request.lobe, request.normalisation, request.exponent.value_or(1)});
  if (request.language.index == kPovray) {
    if (request.exponent)
      throw Error(
          ExitCode::kUsage,
          "for POV-Ray the exponent is an argument of what is exported; leave --exponent out");
    return povray_text(highlights);
  }
  const Language& language = kLanguages[request.language.index];
  Writer writer(language, request.exponent.has_value());
  for (const Highlight& highlight : highlights) writer.add(highlight);
  return fill(embedded::gpu_head, {{"language", language.title},
                                   {"version", kNameAndVersion},
                                   {"command", command_of(request)},
                                   {"paper", kPaper},
                                   {"normal", language.normal},
                                   {"note", language.note}}) +
         writer.text();
}

}  // namespace lobelia
