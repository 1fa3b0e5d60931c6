// cs16 as a highlight rather than as a function: the paper compares the bare lobes, but a picture shows
// them normalised, on a display of 8 bits.
#include <fmt/format.h>

#include "studies/paper/claim.hpp"
#include "studies/paper/search.hpp"

namespace lobelia::paper {

Claim cs16_normalised() {
  // Each with its printed coefficient, as a share of the peak of the normalised cos^n.
  const auto peak = [](const Row& row) {
    return largest_over_n([&](Real n) { return row.cs16_column(n) / row.cosine_column(n) - 1; });
  };
  const Row& phong = kRows[kPhong];
  const auto below = [&](Real n) {
    return largest(
               [&](Real x) {
                 return cosine_lobe(x, n) -
                        phong.cs16_column(n) / phong.cosine_column(n) * cs16_lobe(x, n);
               },
               0, cs16_support(n), 100)
        .value;
  };
  const Extreme phong_peak = peak(phong), blinn_peak = peak(kRows[kBlinn]);
  const Extreme phong_below = largest_over_n(below);
  Claim claim{"cs16-normalised", "eq. (1) and table of coefficients",
              "how far cs16 is from cos^n when both are normalised", ""};
  claim.measured = {
      figure("Phong (RDF), peak too bright by", phong_peak.value, 3, at_exponent(phong_peak.at)),
      figure("Blinn-Phong (RDF), peak too bright by", blinn_peak.value, 3,
             at_exponent(blinn_peak.at)),
      figure("Phong (RDF), flank too dark by, of the peak", phong_below.value, 3,
             at_exponent(phong_below.at))};
  claim.definition =
      "lobe times printed coefficient, over the peak of cos^n times its own; n = 16..1024";
  claim.reason =
      "cs16 is the narrower lobe, so the coefficient that gives it the same energy is up to 17/16 of "
      "the other: a highlight drawn with it differs by several times the 1.7e-2 of the bare lobes";
  return claim;
}

Claim cs16_tail() {
  // Where either lobe is `level` of its peak.
  const auto reach = [](Real n, Real level, bool cs16) {
    const Real s = cs16 ? 16 * (1 - std::pow(level, 1 / 16.0L)) / n : 1 - std::pow(level, 1 / n);
    return 2 * std::asin(std::sqrt(s / 2));
  };
  constexpr Real kVisible = 1 / 255.0L, kN = kLastExponent;
  const Real end = reach(kN, kVisible, false);
  Claim claim{"cs16-tail", "eq. (1)", "how cs16 ends, beside cos^n", ""};
  claim.measured = {figure("its reach over that of cos^n, to 1/255 of the peak",
                           reach(kN, kVisible, true) / end, 3, at_exponent(kN)),
                    figure("the same to half of the peak",
                           reach(kN, 0.5L, true) / reach(kN, 0.5L, false), 3, at_exponent(kN)),
                    figure("cs16 / cos^n where cos^n is 1/255",
                           cs16_lobe(end, kN) / cosine_lobe(end, kN), 3, at_exponent(kN))};
  claim.definition = "the bare lobes at n = 1024, where they are farthest apart";
  claim.reason =
      "the blooming zone is a little narrower and its rim much darker: the opposite of "
      "Schlick's fault, and far smaller (schlick-tail)";
  return claim;
}

}  // namespace lobelia::paper
