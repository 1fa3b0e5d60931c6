// Lobes and models for any number type, for the .cpp files of this folder.
#pragma once

#include "reference_scenes/engines/analytic/formulas/big.hpp"
#include "reference_scenes/engines/analytic/formulas/vector.hpp"
#include "renderer/highlight.hpp"

namespace lobelia::truth {

/// The lobe's textbook definition by the cosine of its angle; 0 from a right angle on. For double and Big.
template <class Real>
Real lobe_of_cosine(LobeId lobe, const Real& cosine, double exponent);

/// The angle below which the lobe is above `value`; a right angle if there is none.
Big angle_at(const LobeId& lobe, double value, double exponent);

/// A model by its row of the paper's table, written out again.
struct ModelRow {
  std::string_view name;
  LobeAngle angle;
  bool radiance_has_cosine;    ///< N.L
  bool lobe_of_half_angle;     ///< in the integral: lobe(x/2), else lobe(x)
  bool integral_has_cosine;    ///< cos x
  int parts;                   ///< the radiance is lobe / parts: 4 for a distribution of normals
  bool has_shadowing = false;  ///< by Smith, in place of G = (N.L)(N.V)
};
/// Throws Error(kInternal) for a model without a row.
const ModelRow& model_row(std::string_view model);
inline const ModelRow& model_row(ModelId model) { return model_row(info(model).name); }

/// Cosine of the angle that the model's lobe sees, for unit vectors.
template <class Real>
Real lobe_cosine(LobeAngle angle, const Vector<Real>& normal, const Vector<Real>& to_eye,
                 const Vector<Real>& to_light) {
  if (angle == LobeAngle::kReflection)
    return 2 * dot(normal, to_eye) * dot(normal, to_light) - dot(to_eye, to_light);
  return dot(normal, normalize(to_light + to_eye));
}

/// The factor of the lobe, for a light above the horizon. Shadowing is as Heitz prints it, by Lambda; 0 for an eye below the
/// horizon.
template <class Real>
Real geometry(const ModelRow& model, double exponent, const Real& n_dot_l, const Real& n_dot_v) {
  using std::sqrt;
  const Real cosine = model.radiance_has_cosine ? n_dot_l : Real(1);
  if (!model.has_shadowing) return cosine;
  if (n_dot_v <= Real(0)) return Real(0);
  const auto lambda = [&](const Real& c) -> Real {
    return (sqrt(1 + Real(2) / Real(exponent + 2) * (1 / (c * c) - 1)) - 1) / 2;
  };
  return cosine / ((1 + lambda(n_dot_l) + lambda(n_dot_v)) * n_dot_l * n_dot_v);
}

}  // namespace lobelia::truth
