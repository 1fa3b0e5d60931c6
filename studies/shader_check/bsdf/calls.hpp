// Calls of a BSDF's functions, as text behind somebody's shader.
#pragma once

#include "base/words/vec.hpp"
#include "studies/shader_check/bsdf/functions.hpp"

namespace lobelia::shader_check::bsdf {

/// A point of a run: world directions as the shader has them, random numbers, the exponent.
struct BsdfPoint {
  Vec3 normal, to_eye, to_light;
  Vec3 random;
  double exponent = 1;
};
ShaderPoints shader_points(const std::vector<BsdfPoint>& points);

/// The shader with functions that call its own, but without calls.
ShaderSource with_bsdf_calls(const ShaderSource& source, const BsdfFunctions& functions);

/// A roughness, an alpha or an exponent changed before the call.
enum class ChangedParameter : std::uint8_t { kNone, kSquared, kRoot, kDoubled, kHalved };

// Expressions for ShaderSource::calls.

std::string call_of_eval(ShaderText language, bool swapped);
std::string call_of_pdf(ShaderText language, ChangedParameter changed = ChangedParameter::kNone);
enum class Sampled : std::uint8_t {
  kDirection,
  kPdf,     ///< as sample() gave it, whether it is valid, and what pdf says of the direction
  kWeight,  ///< as sample() gave it
  kEval,    ///< of the direction
};
std::string call_of_sample(ShaderText language, Sampled what);

/// Whether sample() gives a pdf or a weight.
bool gives_pdf(const BsdfFunction& sample);
bool gives_weight(const BsdfFunction& sample);

}  // namespace lobelia::shader_check::bsdf
