// Mistakes that explain the failures of a BSDF, named only if putting it right, in double, lets the tests pass.
#pragma once

#include <span>

#include "studies/shader_check/bsdf/judge.hpp"

namespace lobelia::shader_check::bsdf {

struct BsdfMistake {
  std::string_view name, sentence;
};
/// All that can be named.
std::span<const BsdfMistake> bsdf_mistakes();

/// The values with pdf called with another parameter.
struct BsdfVariant {
  std::string_view mistake, sentence;
  BsdfValues values;
};
/// Whether only values of a changed parameter could explain the failures.
bool needs_variants(const BsdfValues& values, const records::BsdfCheck& record);

/// Adds the explanations to a judged record.
void explain_bsdf(const BsdfValues& values, std::span<const BsdfVariant> variants,
                  records::BsdfCheck& record);

}  // namespace lobelia::shader_check::bsdf
