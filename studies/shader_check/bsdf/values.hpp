// The values that a BSDF's functions gave, as the judge takes them. Directions are local: the normal is z.
#pragma once

#include <string>
#include <vector>

#include "studies/shader_check/bsdf/grid.hpp"

namespace lobelia::shader_check::bsdf {

struct BsdfSample {
  Vec3 direction;
  bool is_valid = true;  ///< as sample() says, and a unit vector
  double given_pdf = 0, given_weight = 0;
  double pdf = 0, eval = 0;  ///< of the direction, by the functions themselves
};

struct NodeValue {
  double eval = 0, swapped = 0;  ///< swapped: light and eye exchanged
  double pdf = 0;
};

/// A grid with the values at its nodes.
struct GridValues {
  HemisphereGrid grid;
  std::vector<NodeValue> values;
};

/// One exponent, and one angle of the eye.
struct BsdfSettingValues {
  double exponent = 1, eye_degrees = 0;
  Vec3 eye;
  GridValues above, check, below;  ///< `check` estimates the error of integrals over `above`
  std::vector<BsdfSample> samples;
};

struct BsdfValues {
  std::vector<BsdfSettingValues> settings;
  bool has_given_pdf = false, has_given_weight = false;
  std::size_t calls = 0, not_finite = 0, negative = 0, not_unit = 0, coloured = 0;
  std::string first_odd;       ///< the first call that is not finite or negative
  bool random_unused[2] = {};  ///< sample() gives the same direction whatever u1, or u2, is
};

Vec3 eye_at(double degrees);

}  // namespace lobelia::shader_check::bsdf
