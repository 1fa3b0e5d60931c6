// The angle where cs16 ends, and the 6/sqrt(n) that the paper puts in its place.
#include <boost/math/tools/toms748_solve.hpp>

#include <fmt/format.h>

#include "verify/paper/catalogue.hpp"
#include "verify/paper/search.hpp"

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
              "what the cut at 6/sqrt(n) adds to the lobe or takes from it", ""};
  claim.measured = {
      figure("largest value added, of a negative base", added.value, 2, at_exponent(added.at)),
      figure("largest value cut off", lost.value, 1, at_exponent(lost.at))};
  claim.definition =
      "the 16th power of the base at x = 6/sqrt(n): beyond theta_cr the base is negative and its "
      "even power is not 0; where 6/sqrt(n) is the smaller, the lobe ends before it is 0";
  claim.reason = "harmless either way: a display shows 1/255";
  return claim;
}

}  // namespace lobelia::paper
