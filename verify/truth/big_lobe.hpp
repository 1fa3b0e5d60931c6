// Lobes and models in 50 digits, for the .cpp files of verify/truth/.
#pragma once

#include "renderer/highlight.hpp"
#include "verify/truth/big.hpp"

namespace lobelia::truth {

/// The lobe's textbook definition of the cosine of its angle; 0 from a right angle on.
Big lobe_of_cosine(LobeId lobe, const Big& cosine, double exponent);

/// A model as its row of the paper's table says it, written out again.
struct ModelRow {
  std::string_view name;
  LobeAngle angle;
  bool radiance_has_cosine;  ///< N.L
  bool lobe_of_half_angle;   ///< in the integral: lobe(x/2), else lobe(x)
  bool integral_has_cosine;  ///< cos x
  int parts;                 ///< radiance has this part of D: 4 for a distribution of normals
};
/// Throws Error(kInternal) for a model whose row is missing.
const ModelRow& model_row(ModelId model);

/// Cosine of the angle that the model's lobe sees, for unit vectors.
Big lobe_cosine(LobeAngle angle, const Big3& normal, const Big3& to_eye, const Big3& to_light);

}  // namespace lobelia::truth
