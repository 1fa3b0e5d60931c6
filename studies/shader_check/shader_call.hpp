// The call of somebody's function, with a value for all that it takes and reads.
#pragma once

#include "studies/shader_check/arguments.hpp"
#include "studies/shader_check/check.hpp"

namespace lobelia::shader_check {

struct ShaderCall {
  ShaderSource source;  ///< its global variables are private ones, which the program around it sets
  std::string function, list;  ///< as they were given or found
  bool of_roughness = false;   ///< it can know the exponent only through a roughness
  std::vector<records::ShaderBinding> bindings;
  std::vector<std::string> remarks;
};

/// Calls of one function, one for each meaning that its parameters may have, the likeliest first. They share their
/// arguments' components.
struct ShaderCalls {
  std::vector<ShaderCall> calls;
  Arguments arguments;
};

/// At most `most` calls, and one if --arguments or the names tell. Throws Error(kInput) for a text that is not a shader,
/// Error(kUsage) if there is no one function to call, an argument or a --set does not fit, or the function reads what
/// nothing sets.
ShaderCalls shader_calls(const Request& request, std::size_t most);

}  // namespace lobelia::shader_check
