#include "reference_scenes/engines/analytic/formulas/big.hpp"
#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "reference_scenes/engines/analytic/formulas/highlight.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"

namespace lobelia::truth {

template <class Real>
Real lobe_of_cosine(LobeId lobe, const Real& cosine, double exponent) {
  if (cosine <= 0) return 0;
  // The cosine of two equal directions may come out a last digit above 1.
  return lobe_definition(lobe, cosine < 1 ? cosine : Real(1), exponent);
}
template double lobe_of_cosine(LobeId, const double&, double);
template Big lobe_of_cosine(LobeId, const Big&, double);

double lobe(LobeId lobe, double s, double exponent) {
  return double(lobe_of_cosine(lobe, Big(1 - Big(s)), exponent));
}

double one_minus_cos(double angle) {
  const Big sine = sin(Big(angle) / 2);
  return double(2 * sine * sine);
}

}  // namespace lobelia::truth
