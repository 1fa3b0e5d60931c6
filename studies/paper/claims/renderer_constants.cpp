// The only claim that uses the renderer: whether its normalisation "paper" is the printed table.
#include <stdexcept>

#include "renderer/highlight.hpp"
#include "studies/paper/claim.hpp"

namespace lobelia::paper {

Claim renderer_constants() {
  Real worst = 0;
  for (const Row& row : kRows) {
    const auto model = find_model(row.name);
    if (!model) throw std::logic_error("the renderer has no model " + std::string(row.name));
    for (const Lobe lobe : {Lobe::kCosine, Lobe::kCs16})
      for (const Real n : {16.0L, 20.0L, 64.0L, 300.0L, 1024.0L}) {
        const Highlight highlight{*model, *find_lobe(lobe == Lobe::kCosine ? "cosine" : "cs16"),
                                  Normalisation::kPaper, double(n)};
        const Real share = row.distribution ? 0.25L : 1;  // f_r = D/4
        worst = std::max(
            worst, std::abs(radiance_coefficient(highlight) / (share * row.column(lobe)(n)) - 1));
      }
  }
  Claim claim{"renderer-constants", "table of coefficients",
              "Lobelia's normalisation 'paper' is the table as printed, misprints included", ""};
  claim.measured = {vanishing("largest relative difference", worst, 1e-14)};
  claim.definition = "every row and lobe, n = 16, 20, 64, 300, 1024";
  return claim;
}

}  // namespace lobelia::paper
