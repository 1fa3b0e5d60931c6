#include "verify/definition.hpp"
#include "verify/truth/big_lobe.hpp"
#include "verify/truth/truth.hpp"

namespace lobelia::truth {

Big lobe_of_cosine(LobeId lobe, const Big& cosine, double exponent) {
  if (cosine <= 0) return 0;
  // The cosine of two equal directions may come out a last digit above 1.
  return lobe_definition(lobe, cosine < 1 ? cosine : Big(1), exponent);
}

double lobe(LobeId lobe, double s, double exponent) {
  return double(lobe_of_cosine(lobe, 1 - Big(s), exponent));
}

double one_minus_cos(double angle) {
  const Big sine = sin(Big(angle) / 2);
  return double(2 * sine * sine);
}

}  // namespace lobelia::truth
