// The residuals of the cs16 column: how far the reflected energy at normal incidence is from 1.
#include <fmt/format.h>

#include "studies/paper/claim.hpp"
#include "studies/paper/energy.hpp"
#include "studies/paper/search.hpp"

namespace lobelia::paper {
namespace {

constexpr char kResidualTables[] = "table of coefficients, cs16 column; Figs. 3 to 5";

/// The claim "the residual of this row is at most `printed`", where `unit` is that of its last digit.
Claim residual(const char* name, RowNumber number, double printed, double unit,
               Cut cut = Cut::kSupport) {
  const Row& row = kRows[number];
  const auto excess = [&](Real n) { return energy(row, Lobe::kCs16, n, cut) - 1; };
  const Extreme over = largest_over_n(excess);
  const Extreme under = largest_over_n([&](Real n) { return -excess(n); });
  const Extreme worst = over.value >= under.value ? over : under;
  Claim claim{name, kResidualTables,
              fmt::format("{}: the energy is within {} of 1", row.title, figure_text(printed, 2)),
              figure_text(printed, 2)};
  claim.measured = {
      figure("largest distance of the energy from 1", worst.value, 3,
             std::abs(over.value + under.value) < 1e-12L ? "every n" : at_exponent(worst.at)),
      fixed("least energy", 1 - under.value, 5), fixed("largest energy", 1 + over.value, 5)};
  claim.definition = fmt::format(
      "printed coefficient times 2 pi times the integral of lobe({}){} sin x {}; n real in 16..1024",
      row.half_angle ? "x/2" : "x", row.cosine ? " cos x" : "",
      cut == Cut::kPrinted ? "up to x = 6/sqrt(n), as the paper's integral has it"
      : row.half_angle     ? "over the lobe's whole support, which in x is twice theta_cr"
                           : "over the lobe's support");
  claim.verdict = confirmed_if(rounds_to(worst.value, printed, unit));
  return claim;
}

}  // namespace

Claim residual_phong_rdf() {
  Claim claim = residual("residual-phong-rdf", kPhong, 4.7e-4, 1e-5);
  claim.reason = "all of it is 1.063 for 17/16: the same at every n, and always above 1";
  return claim;
}

Claim residual_modified_phong() {
  Claim claim = residual("residual-modified-phong", kModifiedPhong, 1.3e-3, 1e-4);
  claim.reason = "above 1 at every n";
  return claim;
}

Claim residual_blinn_phong_rdf_cut() {
  return residual("residual-blinn-phong-rdf-cut", kBlinn, 1.5e-3, 1e-4, Cut::kPrinted);
}

Claim residual_blinn_phong_rdf() {
  Claim claim = residual("residual-blinn-phong-rdf", kBlinn, 1.5e-3, 1e-4);
  claim.reason =
      "the figure is that of the integral cut at x = 6/sqrt(n), but the lobe of the half angle "
      "reaches twice as far; the coefficient is too large by what was cut off, above 1 at every n";
  return claim;
}

Claim residual_modified_blinn_phong() {
  Claim claim = residual("residual-modified-blinn-phong", kModifiedBlinn, 9.5e-3, 1e-4);
  const Row& row = kRows[kModifiedBlinn];
  const Extreme cut =
      largest_over_n([&](Real n) { return 1 - energy(row, Lobe::kCs16, n, Cut::kPrinted); });
  const Extreme wide =
      largest([&](Real n) { return 1 - energy(row, Lobe::kCs16, n); }, 32, kLastExponent, 992);
  claim.measured.push_back(figure("largest from n = 32 on", wide.value, 2, at_exponent(wide.at)));
  claim.measured.push_back(
      figure("largest, cut at x = 6/sqrt(n)", cut.value, 2, at_exponent(cut.at)));
  claim.reason =
      "energy is lost at every n. 1.027 is far from the 17/16 = 1.0625 that the coefficient tends "
      "to; where it comes from is not known (best-digits)";
  return claim;
}

Claim residual_distributions() {
  Claim claim = residual("residual-distributions", kNdf, 4.7e-4, 1e-5);
  const Claim heightfield = residual("", kHeightfield, 1.3e-3, 1e-4);
  claim.statement =
      "Blinn-Phong (NDF) and (heightfield): the integral is within 4.7e-4 and 1.3e-3 of 1, as "
      "for rows 1 and 2";
  claim.printed = "4.7e-4, 1.3e-3";
  claim.measured[0].what = "NDF, " + claim.measured[0].what;
  claim.measured.resize(1);
  claim.measured.push_back(heightfield.measured[0]);
  claim.measured[1].what = "heightfield, " + claim.measured[1].what;
  claim.definition =
      "as rows 1 and 2, whose coefficients and integrands these rows share, with x the angle "
      "between normal and half vector; n real in 16..1024";
  if (heightfield.verdict != kConfirmed) claim.verdict = kNotReproduced;
  claim.reason = "a distribution's integral is not the reflected energy (distribution-as-brdf)";
  return claim;
}

}  // namespace lobelia::paper
