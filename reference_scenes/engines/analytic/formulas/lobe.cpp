#include "reference_scenes/engines/analytic/formulas/big.hpp"
#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "reference_scenes/engines/analytic/formulas/highlight.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"

namespace lobelia::truth {

template <class Real>
Real lobe_of_cosine(LobeId lobe, const Real& cosine, double exponent) {
  if (cosine <= 0) return 0;
  // The cosine between two equal directions may be rounded to just above 1.
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

double shape(const Highlight& highlight, Vec3 normal, Vec3 to_eye, Vec3 to_light) {
  const Big3 n = normalize(Big3(normal)), v = normalize(Big3(to_eye)),
             l = normalize(Big3(to_light));
  const Big n_dot_l = dot(n, l);
  if (n_dot_l <= 0) return 0;
  const ModelRow& model = model_row(highlight.model);
  const Big lobe =
      lobe_of_cosine(highlight.lobe, lobe_cosine(model.angle, n, v, l), highlight.exponent);
  return double(Big(lobe * geometry<Big>(model, highlight.exponent, n_dot_l, dot(n, v))));
}

}  // namespace lobelia::truth
