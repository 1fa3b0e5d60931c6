// The density of a lobe's samples. Its integral is taken in pieces of s that grow from the lobe's width on.
#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>

#include "reference_scenes/engines/analytic/formulas/big.hpp"
#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "reference_scenes/engines/analytic/formulas/highlight.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"

namespace lobelia::truth {
namespace {

/// The density, not normalised.
Big unnormalised(LobeId lobe, const Big& cosine, double exponent) {
  if (cosine <= 0) return 0;
  return lobe_of_cosine(lobe, cosine, exponent) * draw_factor(lobe, cosine, exponent);
}

/// The integral over the cosine from where the lobe ends to 1.
Big whole(LobeId lobe, double exponent) {
  const Big end = lobe.order > 0 ? Big(1 - cos(angle_at(lobe, 0, exponent))) : Big(1);
  Big sum = 0, from = 0, to = 1 / (2 * Big(exponent));
  for (; to < end; from = to, to *= 2)
    sum += boost::math::quadrature::gauss<Big, 30>::integrate(
        [&](const Big& s) { return unnormalised(lobe, 1 - s, exponent); }, from, to);
  // cos^n with a small n rises steeply from the right angle, so the points are crowded there.
  thread_local boost::math::quadrature::tanh_sinh<Big> corner;
  const Big piece = end - from, lowest = 1 - end;
  const auto from_end = [&](const Big& part) {
    return unnormalised(lobe, lowest + piece * part, exponent);
  };
  return sum + piece * corner.integrate(from_end, Big(0), Big(1), Big(1e-22));
}

}  // namespace

std::function<double(double s)> density(LobeId lobe, double exponent) {
  return [=, integral = whole(lobe, exponent)](double s) {
    return double(unnormalised(lobe, 1 - Big(s), exponent) / integral);
  };
}

}  // namespace lobelia::truth
