#include "shaders/gpu.hpp"

#include <fmt/format.h>

#include <cctype>
#include <numbers>

#include "core/error.hpp"
#include "renderer/lobes/catalogue.hpp"
#include "renderer/models/catalogue.hpp"
#include "shaders/names.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view gpu_geometry, gpu_lobe, gpu_energy, gpu_coefficient, gpu_highlight;
}
namespace {

using HWY_NAMESPACE::Lobes;
using HWY_NAMESPACE::Models;

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

/// As float32 needs it, and with a point: 4 would be an integer.
std::string number(double value) {
  std::string text = fmt::format("{:.9g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

/// The coefficient as a formula of n; empty where there is none.
std::string coefficient_formula(const Highlight& highlight) {
  const ModelForm& model = model_form(highlight.model);
  const LobeForm lobe = lobe_form(highlight.lobe);
  const std::string share = model.share == 1 ? "" : number(model.share) + " * ";
  const std::string pi = number(std::numbers::pi);
  if (highlight.normalisation == Normalisation::kPaper)
    return share + fill(lobe.column == PaperColumn::kCosine ? model.texts.paper_cosine
                                                            : model.texts.paper_cs16,
                        {{"pi", pi}});
  if (lobe.column == PaperColumn::kCosine)
    return share + fill(model.texts.exact_cosine, {{"pi", pi}});
  if (lobe.text.slope.empty()) return "";
  const EnergyIntegral& energy = model.energy;
  return fmt::format("{} / lobelia_{}_energy(n, {}, {}, {}, {}, {})",
                     number(model.share / (2 * std::numbers::pi)), info(highlight.lobe).name,
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

class Writer {
 public:
  Writer(const GpuLanguage& language, bool fixed) : language_(language), fixed_(fixed) {}

  void add(const Highlight& highlight) {
    const double constant = radiance_coefficient(highlight);  // says what the paper has not
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
    // Not the function's own name, which would then stand for nothing.
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

  const GpuLanguage& language_;
  bool fixed_;
  Parts parts_{"#ifndef %name%\n#define %name%\n", "#endif\n"};
};

}  // namespace

std::string gpu_text(const GpuLanguage& language, std::span<const Highlight> highlights,
                     bool fixed_exponent) {
  Writer writer(language, fixed_exponent);
  for (const Highlight& highlight : highlights) writer.add(highlight);
  return writer.text();
}

}  // namespace lobelia
