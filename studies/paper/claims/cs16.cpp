// How far cs16 is from cos^n.
#include <fmt/format.h>

#include "studies/paper/search.hpp"

namespace lobelia::paper {
namespace {

constexpr int kAngles = 100;

Real difference(Real x, Real n) { return cosine_lobe(x, n) - cs16_lobe(x, n); }

/// Over all angles; beyond cs16's support cos^n alone is left, and falls.
Extreme largest_excess(Real n, Real sign) {
  return largest([&](Real x) { return sign * difference(x, n); }, 0, cs16_support(n), kAngles);
}

/// "n = 1024, x = 3.54 degrees"
std::string place(Real n, Real x) {
  return fmt::format("{}, x = {} degrees", at_exponent(n), figure_text(double(degrees(x)), 3));
}

Real ratio(Real n) { return printed_theta_cr(n) / theta_cr(n); }

}  // namespace

// ---- the two figures that the paper prints beside eq. (1)

Claim cs16_largest_error() {
  const Extreme over_n = largest_over_n([](Real n) { return largest_excess(n, 1).value; });
  const Real at_16 = largest_excess(16, 1).value;
  Claim claim{"cs16-largest-error", "eq. (1)", "cos^n exceeds cs16 by 1.7e-2 at most", "1.7e-2"};
  claim.measured = {figure("largest cos^n - cs16", over_n.value, 3,
                           place(over_n.at, largest_excess(over_n.at, 1).at)),
                    vanishing("the same at n = 16, where both are one function", at_16, 1e-15)};
  claim.definition =
      "absolute difference, a share of the peak; n real in 16..1024, x over the hemisphere";
  claim.verdict = confirmed_if(rounds_to(over_n.value, 1.7e-2, 1e-3));
  return claim;
}

Claim cs16_smallest_error() {
  const Real least = -largest_over_n([](Real n) { return largest_excess(n, -1).value; }).value;
  // Below 16 cs16 does exceed cos^n: the exponent at which it does so by the printed figure.
  const auto over_printed = [](Real n) { return largest_excess(n, -1).value - 9.7e-3L; };
  Claim claim{"cs16-smallest-error", "eq. (1)", "cs16 exceeds cos^n by 9.7e-3 at most", "-9.7e-3"};
  claim.measured = {
      vanishing("least cos^n - cs16, n = 16..1024", least, 1e-15),
      figure("exponent at which it is -9.7e-3", root(over_printed, Real(10), Real(12), 30), 3)};
  claim.definition =
      "as for cs16-largest-error. Below 1e-15 is rounding: the two functions are equal at x = 0 and at n = "
      "16";
  claim.verdict = confirmed_if(rounds_to(least, -9.7e-3, 1e-4));
  claim.reason =
      "for n >= 16, (1 - n s/16)^(16/n) <= 1 - s with s = 1 - cos x (Bernoulli), so cs16 never exceeds "
      "cos^n. It does below 16, outside the paper's range";
  return claim;
}

Claim cs16_without_power() {
  const auto worst = [](Real n) { return largest_difference(cs16_base, n, cs16_support(n)); };
  const Extreme base = largest_over_n([&](Real n) { return worst(n).value; });
  const Extreme power = largest_over_n([](Real n) { return largest_excess(n, 1).value; });
  Claim claim{"cs16-without-power", "text before eq. (1)",
              "cos^n is approximated by n/16 (cos x - 1) + 1, without a power",
              "n/16 (cos x - 1) + 1"};
  claim.measured = {
      figure("largest difference from cos^n", base.value, 3, place(base.at, worst(base.at).at)),
      figure("the same of its 16th power", power, 3)};
  claim.definition =
      "absolute difference up to theta_cr, n = 16..1024. Confirmed if it is the printed 1.7e-2";
  claim.verdict = confirmed_if(rounds_to(base.value, 1.7e-2, 1e-3));
  claim.reason = "a misprint. The power 16 is missing; eq. (1) has it";
  return claim;
}

// ---- the angle where cs16 ends, and the 6/sqrt(n) that the paper uses instead

Claim theta_cr_approximation() {
  const Extreme above = largest_over_n([](Real n) { return ratio(n) - 1; });
  const Extreme below = largest_over_n([](Real n) { return 1 - ratio(n); });
  Claim claim{"theta-cr", "eq. (1)", "theta_cr = arccos((n - 16)/n) is nearly 6/sqrt(n)",
              "6/sqrt(n)"};
  claim.measured = {figure("largest share by which it is too large", above, 3),
                    figure("largest share by which it is too small", below, 3),
                    figure("exponent below which it is too small",
                           root([](Real n) { return ratio(n) - 1; }, Real(16), Real(64), 40), 3)};
  claim.definition =
      "6/sqrt(n) / theta_cr - 1, n = 16..1024. Confirmed if within 10 %; the paper prints no figure";
  claim.verdict = confirmed_if(above.value < 0.1L && below.value < 0.1L);
  claim.reason =
      "theta_cr = 2 arcsin(sqrt(8/n)) tends to 5.66/sqrt(n). 6 is 6.1 % too large in the limit, and too "
      "small for small n";
  return claim;
}

Claim theta_cr_beyond() {
  const Extreme added = largest_over_n(
      [](Real n) { return ratio(n) > 1 ? power_of_16(cs16_base(printed_theta_cr(n), n)) : 0; });
  const Extreme lost =
      largest_over_n([](Real n) { return ratio(n) < 1 ? cs16_lobe(printed_theta_cr(n), n) : 0; });
  Claim claim{"theta-cr-beyond", "eq. (1)",
              "the cut at 6/sqrt(n) in place of theta_cr changes the error negligibly", ""};
  claim.measured = {figure("largest value added, of a negative base", added, 2),
                    figure("largest value cut off", lost, 1)};
  claim.definition =
      "the 16th power of the base at x = 6/sqrt(n). Beyond theta_cr the base is negative and its power is "
      "not 0; before it, the lobe is cut off. Confirmed if both are below 1e-5, the last digit of the "
      "paper's smallest error";
  claim.verdict = confirmed_if(added.value < 1e-5L && lost.value < 1e-5L);
  claim.reason =
      "this holds for the lobe. Row 3's lobe of the half angle reaches twice as far, and its integral loses"
      " 0.4 % by the same cut (residual-blinn-phong-rdf)";
  return claim;
}

Claim theta_cr_growth() {
  // Where the base of eq. (1) is -level^(1/16), its 16th power is `level` again: n s/16 = 1 + level^(1/16).
  const auto exponent_at_right_angle = [](Real level) {
    return 16 * (1 + std::pow(level, 1 / 16.0L));
  };
  const auto reach = [&](Real n, Real level) {
    return 2 * std::asin(std::sqrt(exponent_at_right_angle(level) / n / 2)) / theta_cr(n);
  };
  constexpr Real kVisible = 1 / 255.0L;
  const Real first = exponent_at_right_angle(1);
  const Extreme latest = largest([&](Real n) { return reach(n, 1); }, first, kLastExponent, 992);
  Claim claim{"theta-cr-growth", "eq. (1)",
              "beyond theta_cr the 16th power of the base grows rapidly, so it must be cut", ""};
  claim.measured = {
      figure("the peak again at this times theta_cr, at the latest", latest, 3),
      figure("the same", reach(kLastExponent, 1), 3, "n = 1024"),
      figure("1/255 of the peak again at this times theta_cr", reach(kLastExponent, kVisible), 3,
             "n = 1024"),
      figure("value at a right angle, of the peak",
             power_of_16(cs16_base(kRightAngle, kLastExponent)), 3, "n = 1024"),
      figure("least exponent at which it is the peak again before a right angle", first, 3),
      figure("least exponent at which it is 1/255 of the peak again",
             exponent_at_right_angle(kVisible), 3)};
  claim.definition =
      "(n/16 (cos x - 1) + 1)^16 without the cut, from theta_cr to a right angle. Confirmed if it reaches "
      "the peak again before twice theta_cr, for every n at which it does so within the hemisphere; no "
      "figure is printed";
  claim.verdict = confirmed_if(latest.value < 2);
  claim.reason =
      "the base falls below 0, and its power is even. Below n = 27 an 8-bit display would not show it";
  return claim;
}

// ---- cs16 as a highlight: normalised, on a display of 8 bits

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
  claim.measured = {figure("Phong (RDF), peak too bright by", phong_peak, 3),
                    figure("Blinn-Phong (RDF), peak too bright by", blinn_peak, 3),
                    figure("Phong (RDF), flank too dark by, of the peak", phong_below, 3)};
  claim.definition =
      "cs16 times its printed coefficient, over the peak of cos^n times its own; n = 16..1024";
  claim.reason =
      "cs16 is narrower, so its coefficient is up to 17/16 of the other. Normalised highlights differ by "
      "several times the 1.7e-2 of the bare lobes";
  return claim;
}

Claim cs16_tail() {
  // The angle at which either lobe is `level` of its peak.
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
      "the blooming zone is a little narrower and its rim much darker. Schlick's lobe errs the other way, "
      "and far more (schlick-tail)";
  return claim;
}

}  // namespace lobelia::paper
