// Checks a shader function against a model: `lobelia check-shader`.
#pragma once

#include <string>
#include <vector>

#include "base/pictures/image.hpp"
#include "base/records/shader_check.hpp"
#include "renderer/highlight.hpp"
#include "studies/shader_check/arguments.hpp"
#include "studies/shader_check/judge.hpp"

namespace lobelia::shader_check {

struct Request {
  std::string file, text;
  ShaderText language = ShaderText::kGlsl;
  ShaderApi api = ShaderApi::kEgl;
  std::string function, arguments;  ///< "" if they are to be found
  /// Values of variables and parameters: {"material.shininess", "n"}, {"lightColor", "1,1,1"}.
  std::vector<std::pair<std::string, std::string>> settings = {};
  Highlight highlight;  ///< without its exponent
  std::vector<Highlight> highlights =
      {};                         ///< to find the shader's own among, in place of `highlight`
  std::vector<double> exponents;  ///< not empty
  double shown_exponent = 64;     ///< of pictures and the curve
  TimeLimit time_limit = kShaderTimeLimit;  ///< of all that compiles and runs shaders, together
  bool costs = true;                        ///< whether to measure half floats and instructions
  bool worst_spheres =
      false;  ///< besides, if it differs, those of the exponent that is furthest above what is allowed
};

/// A lit sphere: light, theirs and the model's.
struct SpherePair {
  double light_degrees = 0;
  Image theirs, model;
};

struct Spheres {
  double exponent = 1, peak = 1;  ///< peak: of the model, as in the errors of the record
  std::vector<SpherePair> pairs;
};

struct Curve {
  std::vector<double> degrees;  ///< of the normal from the half vector
  std::vector<double> theirs, model;
};

struct Check {
  records::ShaderCheck record;   ///< without a command
  std::vector<Spheres> spheres;  ///< of the exponent shown, and of the worst one
  Curve curve;
  double shown_exponent = 64;
};

/// Throws what shader_calls() does, Error(kInput) if the function does not compile, does not end or
/// writes nothing, and Error(kEngine) if nothing runs shaders here.
Check check_shader(const Request& request);

std::string report_text(const records::ShaderCheck& record);

/// One HTML file, without a script and with its pictures in it.
std::string report_page(const Check& check);

// Parts of the check: the cost of a shader function beside ours and pow, and the effect of half floats on it.

/// `values` are those of `domain`, which is in `points`. What cannot be measured is a remark of the record.
void add_costs(const Request& request, const ShaderSource& source, const std::vector<Point>& domain,
               const ShaderPoints& points, const std::vector<ShaderValue>& values,
               records::ShaderCheck& record);

/// The time of a run over the points, over that of pow(N.H, n) in the same process.
double times_as_long_as_pow(const Request& request, const ShaderProgram& program,
                            const ShaderPoints& points);

}  // namespace lobelia::shader_check
