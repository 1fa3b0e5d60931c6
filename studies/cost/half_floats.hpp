// Highlights in half floats: the textbook, ours and what is exported, from three vectors to a value.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/pictures/half.hpp"
#include "renderer/highlight.hpp"
#include "studies/cost/table.hpp"

namespace lobelia::cost {

/// How a shader computes a highlight, every operation in half floats.
enum class HalfForm {
  kTextbook,             ///< the cosine, and the formula of it
  kStable,               ///< s from the difference of the vectors, and the catalogue's lobe
  kExported,             ///< `lobelia export --precision min16float`
  kDifferenceInFloat32,  ///< the same with s in float32, and the exported lobe in half floats
};
inline constexpr std::array kHalfForms{HalfForm::kTextbook, HalfForm::kStable, HalfForm::kExported,
                                       HalfForm::kDifferenceInFloat32};
std::string name(HalfForm form);

/// The largest of the peak: against cos^n, and against the lobe itself without rounding.
struct HalfErrors {
  double all = 0, rounding = 0;
};
inline constexpr std::array kHalfExponents{8.0, 32.0, 128.0, 512.0, 1024.0};
/// `exponent` is one of kHalfExponents. Over random vectors in and about the highlight, the same for all forms and lobes.
HalfErrors half_errors(HalfForm form, LobeAngle angle, LobeId lobe, double exponent,
                       Subnormals subnormals);

/// "lobe-float16-reflection", "lobe-float16-half": nothing is timed.
std::vector<Table> half_float_tables();

}  // namespace lobelia::cost
