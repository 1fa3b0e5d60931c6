// The angle where cs16 ends, and the 6/sqrt(n) that the paper puts in its place.
#include <boost/math/tools/toms748_solve.hpp>

#include <fmt/format.h>

#include "studies/paper/claim.hpp"
#include "studies/paper/search.hpp"

namespace lobelia::paper {
namespace {

Real ratio(Real n) { return printed_theta_cr(n) / theta_cr(n); }

/// Where 6/sqrt(n) is theta_cr.
Real crossing() {
  std::uintmax_t iterations = 60;
  return boost::math::tools::toms748_solve([](Real n) { return ratio(n) - 1; }, Real(16), Real(64),
                                           boost::math::tools::eps_tolerance<Real>(40), iterations)
      .first;
}

}  // namespace

Claim theta_cr_approximation() {
  const Extreme above = largest_over_n([](Real n) { return ratio(n) - 1; });
  const Extreme below = largest_over_n([](Real n) { return 1 - ratio(n); });
  Claim claim{"theta-cr", "eq. (1)", "theta_cr = arccos((n - 16)/n) is nearly 6/sqrt(n)",
              "6/sqrt(n)"};
  claim.measured = {
      figure("largest share by which it is too large", above.value, 3, at_exponent(above.at)),
      figure("largest share by which it is too small", below.value, 3, at_exponent(below.at)),
      figure("exponent below which it is too small", crossing(), 3)};
  claim.definition =
      "6/sqrt(n) / theta_cr - 1, n = 16..1024. The paper prints no figure; confirmed if within "
      "10 %";
  claim.verdict = confirmed_if(above.value < 0.1L && below.value < 0.1L);
  claim.reason =
      "theta_cr = 2 arcsin(sqrt(8/n)), which tends to sqrt(32/n) = 5.66/sqrt(n): 6 is 6.1 % too "
      "large in the limit, and too small where the arcsine bends";
  return claim;
}

Claim theta_cr_beyond() {
  const Extreme added = largest_over_n(
      [](Real n) { return ratio(n) > 1 ? power_of_16(cs16_base(printed_theta_cr(n), n)) : 0; });
  const Extreme lost =
      largest_over_n([](Real n) { return ratio(n) < 1 ? cs16_lobe(printed_theta_cr(n), n) : 0; });
  Claim claim{"theta-cr-beyond", "eq. (1)",
              "the cut at 6/sqrt(n) in place of theta_cr changes the error negligibly", ""};
  claim.measured = {
      figure("largest value added, of a negative base", added.value, 2, at_exponent(added.at)),
      figure("largest value cut off", lost.value, 1, at_exponent(lost.at))};
  claim.definition =
      "the 16th power of the base at x = 6/sqrt(n): beyond theta_cr the base is negative and its "
      "even power is not 0; where 6/sqrt(n) is the smaller, the lobe ends before it is 0. Confirmed if "
      "both are below 1e-5, the last digit of the smallest error that the paper prints";
  claim.verdict = confirmed_if(added.value < 1e-5L && lost.value < 1e-5L);
  claim.reason =
      "of the lobe itself. The integral of row 3, whose lobe of the half angle reaches twice as far, loses "
      "0.4 % by the same cut (residual-blinn-phong-rdf)";
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
              "beyond theta_cr the 16th power of the base grows rapidly, so that it must be cut",
              ""};
  claim.measured = {
      figure("the peak again at this times theta_cr, at the latest", latest.value, 3,
             at_exponent(latest.at)),
      figure("the same", reach(kLastExponent, 1), 3, "n = 1024"),
      figure("1/255 of the peak again at this times theta_cr", reach(kLastExponent, kVisible), 3,
             "n = 1024"),
      figure("value at a right angle, of the peak",
             power_of_16(cs16_base(kRightAngle, kLastExponent)), 3, "n = 1024"),
      figure("least exponent at which it is the peak again before a right angle", first, 3),
      figure("least exponent at which it is 1/255 of the peak again",
             exponent_at_right_angle(kVisible), 3)};
  claim.definition =
      "(n/16 (cos x - 1) + 1)^16 without the cut, from theta_cr to a right angle. No figure is printed; "
      "confirmed if it has reached the peak again before twice theta_cr, for every n of the paper's range "
      "at which it does so within the hemisphere";
  claim.verdict = confirmed_if(latest.value < 2);
  claim.reason =
      "the base falls on past 0, and its power is even. Below n = 27 a display of 8 bits would not show it: the "
      "hemisphere ends first";
  return claim;
}

}  // namespace lobelia::paper
