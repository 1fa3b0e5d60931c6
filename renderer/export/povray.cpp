#include "renderer/export/povray.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/system/error.hpp"
#include "base/system/version.hpp"
#include "renderer/export/embedded.hpp"
#include "renderer/export/names.hpp"
#include "renderer/formula.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view povray_usage, povray_geometry, povray_quadrature, povray_highlight;
extern const std::span<const EmbeddedText> povray_models, povray_lobes;
}  // namespace embedded
namespace {

/// A formula in POV-Ray's language: a file of models/ or lobes/.
std::string_view formula(std::span<const EmbeddedText> formulas, std::string_view name) {
  const auto found = std::ranges::find(formulas, name, &EmbeddedText::name);
  if (found == formulas.end())
    throw Error(ExitCode::kInternal, "renderer/export/povray has no '{}'", name);
  return found->text;
}

std::string lobe_text(const LobeId& lobe) {
  const std::string_view text = formula(embedded::povray_lobes, family(lobe));
  if (lobe.formula)
    return fill(
        text,
        {{"Lobe", capitalised(identifier(lobe))},
         {"text", lobe.formula->text()},
         {"formula", formula_text(lobe.formula->nodes(),
                                  {.number = [](double value) { return fmt::format("{}", value); },
                                   .versine = "S",
                                   .exponent = "N",
                                   .cosine = "(1 - S)",
                                   .angle = "(2*asin(sqrt(0.5*S)))",
                                   .log = "ln"})}});
  return fill(text, {{"K", std::to_string(lobe.order)}, {"Lobe", capitalised(identifier(lobe))}});
}

/// The closed form for cos^n and for the paper's cs16; otherwise the quadrature.
std::string coefficient_text(const Highlight& highlight) {
  const std::string model = capitalised(info(highlight.model).name),
                    lobe = capitalised(identifier(highlight.lobe));
  if (highlight.normalisation == Normalisation::kPaper || lobe == "Cosine")
    return fmt::format("Lobelia_{}_{}_{}(N)", model, capitalised(name(highlight.normalisation)),
                       lobe);
  return fmt::format(
      "Lobelia_Normalising(Lobelia_{0}_Lobe, N, Lobelia_{1}_Weight,\n"
      "                      min(Lobelia_{1}_End, Lobelia_{0}_End(N)))",
      lobe, model);
}

std::string usage_text(const Highlight& highlight) {
  const PovrayNames names = povray_names(highlight);
  const ModelInfo& model = info(highlight.model);
  const bool cosine = model.applies_cosine && !model.has_shadowing;
  return fill(embedded::povray_usage,
              {{"heading", heading(highlight)},
               {"version", kNameAndVersion},
               {"paper", kPaper},
               {"file", names.file},
               {"Name", names.pattern},
               {"brilliance", cosine ? "1" : "0"},
               {"finish", cosine                ? "1: N.L is in the model"
                          : model.has_shadowing ? "0: N.L is in the pattern"
                                                : "0: there is no N.L in the model"}});
}

std::string highlight_text(const Highlight& highlight) {
  const PovrayNames names = povray_names(highlight);
  const ModelInfo& about = info(highlight.model);
  const bool shadowing = about.has_shadowing;
  const std::string model = capitalised(about.name);
  return fill(
      embedded::povray_highlight,
      {{"heading", heading(highlight)},
       {"model_source", about.source},
       {"lobe_source", info(highlight.lobe).source},
       {"Name", names.pattern},
       {"Model", model},
       {"Lobe", capitalised(identifier(highlight.lobe))},
       {"coefficient",
        shadowing ? fmt::format("Lobelia_{}_Highest(N)*{}", model, coefficient_text(highlight))
                  : coefficient_text(highlight)},
       {"shadowing", shadowing ? fmt::format("\n         *Lobelia_{}_Geometry(Nx, Ny, Nz, Lx, Ly, "
                                             "Lz, Vx, Vy, Vz, N)",
                                             model)
                               : ""},
       {"cosine", shadowing              ? "which has N.L: `brilliance 0` keeps a second one out"
                  : about.applies_cosine ? "times N.L, which `brilliance 1` brings"
                                         : "without N.L, which `brilliance 0` keeps out"}});
}

}  // namespace

PovrayNames povray_names(const Highlight& highlight) {
  const std::string name = function_name(highlight), pattern = capitalised(name);
  return {name + ".inc", pattern, pattern + "_Coefficient",
          fmt::format("Lobelia_{}_Brilliance", capitalised(info(highlight.model).name))};
}

std::string povray_text(std::span<const Highlight> highlights) {
  Parts parts("#ifndef (Lobelia_Part_%name%)\n#declare Lobelia_Part_%name% = 1;\n",
              "#end   // of Lobelia_Part_%name%\n");
  for (const Highlight& highlight : highlights) {
    radiance_coefficient(highlight);  // throws if the paper has none
    parts.add("Geometry", embedded::povray_geometry);
    parts.add("Quadrature", embedded::povray_quadrature);
    parts.add(capitalised(identifier(highlight.lobe)), lobe_text(highlight.lobe));
    const std::string_view model = info(highlight.model).name;
    parts.add(capitalised(model), formula(embedded::povray_models, model));
    parts.add(capitalised(function_name(highlight)), highlight_text(highlight));
  }
  return (highlights.empty() ? "" : usage_text(highlights.front())) + parts.text();
}

}  // namespace lobelia
