// GLSL's and OSL's arithmetic as C++ has it: float32, each operation rounded once. The exported
// functions are compiled against it as they are (write_functions.cpp).
#pragma once

#include <cmath>
#include <vector>

#include "renderer/highlight.hpp"

namespace lobelia::shader_functions {

/// float, to which a literal without suffix converts.
struct Real {
  float value;
  Real(double x) : value(float(x)) {}
  Real(float x) : value(x) {}
  friend Real operator+(Real a, Real b) { return a.value + b.value; }
  friend Real operator-(Real a, Real b) { return a.value - b.value; }
  friend Real operator*(Real a, Real b) { return a.value * b.value; }
  friend Real operator/(Real a, Real b) { return a.value / b.value; }
  friend Real operator-(Real a) { return -a.value; }
  friend bool operator<(Real a, Real b) { return a.value < b.value; }
  friend bool operator>(Real a, Real b) { return a.value > b.value; }
};
inline Real max(Real a, Real b) { return a < b ? b : a; }
inline Real min(Real a, Real b) { return b < a ? b : a; }
inline Real exp(Real x) { return std::exp(x.value); }
inline Real exp2(Real x) { return std::exp2(x.value); }
inline Real log(Real x) { return std::log(x.value); }

struct vec3 {
  Real x, y, z;
  friend vec3 operator+(vec3 a, vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend vec3 operator-(vec3 a, vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend vec3 operator*(Real k, vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
  friend vec3 operator/(vec3 a, Real k) { return {a.x / k, a.y / k, a.z / k}; }
};
using vector = vec3;
inline Real dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Real length(vec3 a) { return std::sqrt(dot(a, a).value); }

/// One exported function: with the exponent as a parameter and its coefficient's own function, or with
/// the exponent of `highlight` in it.
struct ShaderFunction {
  const char* name;
  Highlight highlight;
  Real (*of_exponent)(vec3, vec3, vec3, Real);
  Real (*coefficient)(Real);
  Real (*fixed)(vec3, vec3, vec3);
};

namespace glsl {
const std::vector<ShaderFunction>& table();
}
namespace osl {
const std::vector<ShaderFunction>& table();
}

}  // namespace lobelia::shader_functions
