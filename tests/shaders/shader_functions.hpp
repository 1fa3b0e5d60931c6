// The arithmetic of GLSL, HLSL, OSL and MSL as C++ has it: float32, each operation rounded once. The exported
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
  friend bool operator>=(Real a, Real b) { return a.value >= b.value; }
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
using color = vec3;
using float3 = vec3;
inline Real dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Real length(vec3 a) { return std::sqrt(dot(a, a).value); }

inline vec3 as_colour(Real radiance) { return {radiance, radiance, radiance}; }
inline vec3 as_colour(vec3 radiance) { return radiance; }

/// One exported function.
struct ShaderFunction {
  const char* name;
  Highlight highlight;  ///< its exponent is the function's if that is fixed
  bool is_fixed, has_fresnel;
  Real (*coefficient)(Real);  ///< of the exponent; null if the export has none
  /// The arguments that the function does not have are ignored.
  vec3 (*radiance)(vec3 normal, vec3 to_eye, vec3 to_light, Real exponent, Real coefficient,
                   vec3 reflectance);
};

using Table = std::vector<ShaderFunction>;
namespace glsl {
const Table& table();
}
namespace hlsl {
const Table& table();
}
namespace msl {
const Table& table();
}
namespace osl {
const Table& table();
}

}  // namespace lobelia::shader_functions
