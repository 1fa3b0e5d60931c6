// Vectors of float32, for the naive formulas.
#pragma once

#include <cmath>

#include "core/vec.hpp"
#include "renderer/highlight.hpp"

namespace lobelia::stability::naive {

struct Float3 {
  float x = 0, y = 0, z = 0;
  Float3() = default;
  Float3(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
  explicit Float3(Vec3 v) : x(float(v.x)), y(float(v.y)), z(float(v.z)) {}
  friend Float3 operator+(Float3 a, Float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Float3 operator-(Float3 a, Float3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Float3 operator*(float k, Float3 a) { return {k * a.x, k * a.y, k * a.z}; }
};
inline float dot(Float3 a, Float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Float3 cross(Float3 a, Float3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Float3 normalize(Float3 a) { return 1 / std::sqrt(dot(a, a)) * a; }

/// For unit vectors.
float unit_shape(const Highlight& highlight, Float3 normal, Float3 to_eye, Float3 to_light);

}  // namespace lobelia::stability::naive
