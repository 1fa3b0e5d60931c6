// The cos^n column of the table: coefficients in closed form, so the energy is to be 1 and not near it.
#include <fmt/format.h>

#include "studies/paper/claim.hpp"
#include "studies/paper/energy.hpp"
#include "studies/paper/search.hpp"

namespace lobelia::paper {
namespace {

constexpr char kCosineColumn[] = "table of coefficients, cos^n column";
constexpr Real kColumnExponents[] = {1, 2, 16, 17.5, 64, 128, 500, 1024};

Real largest_residual(const Row& row, Coefficient coefficient) {
  Real worst = 0;
  for (const Real n : kColumnExponents)
    worst =
        std::max(worst, std::abs(coefficient(n) * hemisphere_integral(row, Lobe::kCosine, n) - 1));
  return worst;
}

}  // namespace

Claim cosine_column() {
  Claim claim{"cosine-column", kCosineColumn, "rows 1, 2, 3, 5 and 6 make their integral exactly 1",
              ""};
  Real worst = 0;
  for (const Row& row : kRows)
    if (row.name != kRows[kModifiedBlinn].name)
      worst = std::max(worst, largest_residual(row, row.cosine_column));
  claim.measured = {vanishing("largest distance of the energy from 1 of the five", worst, 1e-14)};
  claim.definition =
      "printed coefficient times the row's integral; n = 1, 2, 16, 17.5, 64, 128, "
      "500, 1024, because the closed forms hold for every n";
  claim.verdict = confirmed_if(worst < 1e-14L);
  return claim;
}

Claim cosine_modified_blinn_phong() {
  const Row& row = kRows[kModifiedBlinn];
  Claim claim{"cosine-modified-blinn-phong", kCosineColumn,
              "modified Blinn-Phong: (n+2)(n+4)/(4 pi (2^(-n/2) + n)) makes the energy 1", "4 pi"};
  const Real at_16 = energy(row, Lobe::kCosine, 16), at_1024 = energy(row, Lobe::kCosine, 1024);
  const Real corrected = largest_residual(row, column::modified_blinn_phong_corrected);
  claim.measured = {fixed("energy", at_16, 5, "n = 16"), fixed("energy", at_1024, 5, "n = 1024"),
                    vanishing("largest distance of the energy from 1 with 8 pi", corrected, 1e-14)};
  claim.definition = "as for the other rows";
  claim.verdict = confirmed_if(std::abs(at_16 - 1) < 1e-14L);
  claim.reason = "a misprint: with 8 pi for 4 pi it is exact, as the paper's own bounds need";
  return claim;
}

}  // namespace lobelia::paper
