// What a shader function costs beside ours and pow, and what half floats would make of it.
#pragma once

#include "studies/shader_check/arguments.hpp"
#include "studies/shader_check/check.hpp"

namespace lobelia::shader_check {

/// `values` are those of `domain`, which is in `points`. What cannot be measured is a remark of the record.
void add_costs(const Request& request, const Arguments& arguments, const std::vector<Point>& domain,
               const ShaderPoints& points, const std::vector<ShaderValue>& values,
               records::ShaderCheck& record);

}  // namespace lobelia::shader_check
