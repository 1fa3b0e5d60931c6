#include "reference_scenes/engines/analytic/formulas/big.hpp"
#include "reference_scenes/engines/analytic/formulas/highlight.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"

namespace lobelia::truth {

double shape(const Highlight& highlight, Vec3 normal, Vec3 to_eye, Vec3 to_light) {
  const Big3 n = normalize(Big3(normal)), v = normalize(Big3(to_eye)),
             l = normalize(Big3(to_light));
  const Big n_dot_l = dot(n, l);
  if (n_dot_l <= 0) return 0;
  const ModelRow& model = model_row(highlight.model);
  const Big lobe =
      lobe_of_cosine(highlight.lobe, lobe_cosine(model.angle, n, v, l), highlight.exponent);
  return double(model.radiance_has_cosine ? Big(lobe * n_dot_l) : lobe);
}

}  // namespace lobelia::truth
