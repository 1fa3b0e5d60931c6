// The paper's constants as printed, misprints included: reference_scenes/engines/analytic/formulas/printed.hpp, which wrote them out apart
// from the renderer.
#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "reference_scenes/engines/analytic/formulas/highlight.hpp"
#include "reference_scenes/engines/analytic/formulas/printed.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"

namespace lobelia::truth {

double coefficient(const Highlight& highlight) {
  if (highlight.normalisation == Normalisation::kExact)
    return coefficient(highlight.model, highlight.lobe, highlight.exponent);
  const ModelRow& model = model_row(highlight.model);
  const auto& row = *std::find_if(paper::kRows.begin(), paper::kRows.end(),
                                  [&](const auto& r) { return r.name == model.name; });
  const std::string_view lobe = info(highlight.lobe).name;
  if (lobe != "cosine" && lobe != "cs16")
    throw Error(ExitCode::kInput,
                fmt::format("the paper prints no coefficient for the lobe '{}'", lobe));
  const auto column = row.column(lobe == "cosine" ? paper::Lobe::kCosine : paper::Lobe::kCs16);
  return double(column(highlight.exponent) / model.parts);
}

}  // namespace lobelia::truth
