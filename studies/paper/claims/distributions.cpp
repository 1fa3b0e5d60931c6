// What rows 5 and 6 are not: their integral is that of a distribution of normals.
#include <fmt/format.h>

#include "studies/paper/claim.hpp"
#include "studies/paper/energy.hpp"

namespace lobelia::paper {

Claim distribution_as_rdf() {
  Claim claim{"distribution-as-rdf", "table of coefficients, row 5",
              "the energy of the NDF's coefficient used for reflected light: four times too much "
              "in the limit",
              ""};
  for (const Real n : {16.0L, 64.0L, 1024.0L})
    claim.measured.push_back(
        figure("energy",
               kRows[kNdf].cosine_column(n) * hemisphere_integral(kRows[kBlinn], Lobe::kCosine, n),
               4, at_exponent(n)));
  claim.definition = "row 5's coefficient for cos^n times row 3's integral, at normal incidence";
  claim.reason = "the angle of H is half that of the reflected ray, its solid angle a quarter";
  return claim;
}

Claim distribution_as_brdf() {
  Claim claim{"distribution-as-brdf", "table of coefficients, rows 5 and 6",
              "the share of light that the normalised distributions reflect is below 1", ""};
  for (const RowNumber number : {kNdf, kHeightfield})
    for (const Real n : {16.0L, 1024.0L}) {
      const Row& row = kRows[number];
      claim.measured.push_back(figure(
          std::string(row.title),
          albedo(row, Lobe::kCosine, n, row.cosine_column(n), 0, Held::kBeam), 3, at_exponent(n)));
    }
  claim.definition =
      "reflected over arriving power at normal incidence, cos^n, f_r = D/4 (F = 1, G = (N.L)(N.V))";
  claim.reason = "normals are normalised, not light: what the implicit geometry hides is lost";
  return claim;
}

}  // namespace lobelia::paper
