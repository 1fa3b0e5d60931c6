// The call of somebody's function, with a value for all that it takes and reads.
#pragma once

#include "studies/shader_check/arguments.hpp"
#include "studies/shader_check/check.hpp"

namespace lobelia::shader_check {

struct ShaderCall {
  ShaderSource source;  ///< its global variables are private ones, which the program around it sets
  Arguments arguments;
  std::string function, list;  ///< as they were given or found
  std::vector<records::ShaderBinding> bindings;
  std::vector<std::string> remarks;
};

/// Throws Error(kInput) for a text that is not a shader, Error(kUsage) if there is no one function to call, an argument or
/// a --set does not fit, or the function reads what nothing sets.
ShaderCall shader_call(const Request& request);

}  // namespace lobelia::shader_check
