// The cost of a shader function beside ours and pow, and the effect of half floats on it.
#pragma once

#include "studies/shader_check/arguments.hpp"
#include "studies/shader_check/check.hpp"

namespace lobelia::shader_check {

/// `values` are those of `domain`, which is in `points`. What cannot be measured is a remark of the record.
void add_costs(const Request& request, const Arguments& arguments, const std::vector<Point>& domain,
               const ShaderPoints& points, const std::vector<ShaderValue>& values,
               records::ShaderCheck& record);

/// The time of a run over the points, over that of pow(N.H, n) in the same process.
double times_as_long_as_pow(const Request& request, const ShaderProgram& program,
                            const ShaderPoints& points);

}  // namespace lobelia::shader_check
