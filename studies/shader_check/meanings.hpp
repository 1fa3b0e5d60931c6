// Meanings of the names of a shader's parameters and variables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "studies/shader_check/run_shaders.hpp"

namespace lobelia::shader_check {

/// A type by its parts: 3 floats of "vec3", "float3", "vec3<f32>" or "half3".
struct TypeShape {
  enum class Element : std::uint8_t { kFloat, kInt, kUint, kBool } element = Element::kFloat;
  int rows = 0, columns = 1;  ///< no rows: it is none of the language's own types
  bool is_number() const { return rows > 0; }
  int components() const { return rows * columns; }
};
TypeShape shape_of(std::string_view type);

struct Meaning {
  /// Words of --arguments, or lists of numbers, the likeliest first; empty of a name that tells nothing.
  std::vector<std::string> values;
  bool is_told = false;  ///< by the name and the type, so that no other one need be tried
};

/// `path` is a name or "material.shininess".
Meaning meaning_of(std::string_view path, const TypeShape& shape);

/// A value for a variable of which nothing is known but its name, to be set by hand: 1 for a colour of light, 0 for ambient.
std::string suggested_value(std::string_view path, const TypeShape& shape);

}  // namespace lobelia::shader_check
