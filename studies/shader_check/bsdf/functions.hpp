// The functions of a BSDF in somebody's shader, eval, sample and pdf, and what each of them takes and gives.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "studies/shader_check/declarations.hpp"
#include "studies/shader_check/run_shaders.hpp"

namespace lobelia::shader_check::bsdf {

/// The meaning of a parameter, a result or a member of one.
enum class BsdfRole : std::uint8_t {
  kNormal,
  kEye,
  kLight,
  kRandom,     ///< one to three random numbers
  kExponent,   ///< n
  kAlpha,      ///< sqrt(2 / (n + 2))
  kRoughness,  ///< the root of alpha
  kNumber,     ///< a constant, such as a colour of 1
  kDirection,  ///< that sample() chose
  kPdf,
  kWeight,  ///< eval times cosine over pdf
  kValid,
  kEval,
  kUnused,
};

struct BsdfValue {
  BsdfRole role = BsdfRole::kUnused;
  std::string type, name;
  int components = 1;  ///< 0: not a number, such as a structure
  bool is_out = false;
  double number = 0;     ///< of kNumber
  int first_random = 0;  ///< of kRandom
};

struct BsdfFunction {
  std::string name;
  BsdfValue result;
  std::vector<BsdfValue> parameters;
  std::vector<BsdfValue> members;  ///< of the result, if it is a structure

  /// "mySample(V,u1,u2,alpha)": what it takes.
  std::string words() const;
  bool takes(BsdfRole role) const;
};

struct BsdfFunctions {
  BsdfFunction eval, sample, pdf;
  bool pdf_is_of_eval = false;  ///< there is no function for it: eval gives it as well
};

/// The names that --eval, --sample and --pdf give, each alone or with a list, "mySample(V,u1,u2,alpha)"; "": by the names in
/// the text. Throws Error(kInput) or Error(kUsage) that says what is missing, unclear or allowed.
BsdfFunctions bsdf_functions(const ShaderSource& source, const Declarations& declared,
                             const std::string& eval, const std::string& sample,
                             const std::string& pdf);

}  // namespace lobelia::shader_check::bsdf
