// The exported function of the model, which is run beside somebody's shader: a driver on which it is wrong tells nothing.
#pragma once

#include <span>

#include "studies/shader_check/check.hpp"

namespace lobelia::shader_check {

/// In the shader's own language, without the coefficient as an argument where there is a closed form.
ShaderSource own_source(const Request& request);

/// In the version of the shader `theirs`, which became `program`.
ShaderProgram own_program(const Request& request, const ShaderSource& theirs,
                          const ShaderProgram& program, const ShaderPoints& points);

/// Throws Error(kEngine) if the values that our export gave there are not the model's. `values` begin with the points'.
void require_right_driver(const Request& request, const std::string& device,
                          std::span<const Point> points, std::span<const ShaderValue> values);

}  // namespace lobelia::shader_check
