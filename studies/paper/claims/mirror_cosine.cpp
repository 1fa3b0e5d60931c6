// cos theta = N.L = R.L: the angle of the mirror direction taken for that of the normal.
#include "studies/paper/claim.hpp"

namespace lobelia::paper {
namespace {

/// The largest |N.L - R.L| over lights above the horizon in the plane of incidence, and where. R is the mirror direction of an
/// eye at that angle from the normal.
struct Apart {
  Real largest = 0, light_degrees = 0;
};
Apart largest_apart(Real eye_degrees) {
  Apart apart;
  constexpr Real kDegree = kPi / 180;
  for (int light = -900; light <= 900; ++light) {
    const Real angle = light * kDegree / 10,
               off = std::abs(std::cos(angle) - std::cos(angle - eye_degrees * kDegree));
    if (off > apart.largest) apart = {off, light / 10.0L};
  }
  return apart;
}

}  // namespace

Claim cosine_of_reflection() {
  Claim claim{"cosine-of-reflection", "text on Phong's model", "cos theta = N.L = R.L", ""};
  const Apart at_30 = largest_apart(30), at_0 = largest_apart(0);
  claim.measured = {
      figure("largest |N.L - R.L|, eye at 30 degrees from the normal", at_30.largest, 3,
             "light at " + figure_text(double(at_30.light_degrees), 2) + " degrees"),
      vanishing("largest |N.L - R.L|, eye on the normal", at_0.largest, 1e-15)};
  claim.definition =
      "lights from -90 to 90 degrees in the plane of incidence, in steps of 0.1; R is the eye's mirror "
      "direction";
  claim.verdict = confirmed_if(at_30.largest < 1e-15);
  claim.reason =
      "R is at the eye's angle from the normal, so R.L = N.L only if the eye is on the normal, where R = N";
  return claim;
}

}  // namespace lobelia::paper
