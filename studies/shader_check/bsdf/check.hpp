// Tests the functions of a BSDF against each other: `lobelia check-shader --bsdf`.
#pragma once

#include <string>
#include <vector>

#include "base/records/bsdf_check.hpp"
#include "studies/shader_check/run_shaders.hpp"

namespace lobelia::shader_check::bsdf {

inline constexpr double kBsdfExponents[] = {1, 16, 256};
inline constexpr double kEyeDegrees[] = {0, 30, 60, 80, 87};

struct BsdfRequest {
  std::string file, text;
  ShaderText language = ShaderText::kGlsl;
  ShaderApi api = ShaderApi::kEgl;
  std::string eval, sample, pdf;  ///< as --eval and the like give them; "": found by name
  std::vector<double> exponents{std::begin(kBsdfExponents), std::end(kBsdfExponents)};
  /// Names of uniforms and the like, and their numbers with commas.
  std::vector<std::pair<std::string, std::string>> settings;
  std::size_t samples = 32768;  ///< for each exponent and angle
  TimeLimit time_limit = kShaderTimeLimit;
};

/// A record without a command. Throws as check_shader() and bsdf_functions().
records::BsdfCheck check_bsdf(const BsdfRequest& request);

std::string bsdf_report(const records::BsdfCheck& record);

}  // namespace lobelia::shader_check::bsdf
