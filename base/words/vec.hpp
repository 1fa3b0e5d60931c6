// Three-vectors and RGB triples.
#pragma once

#include <algorithm>
#include <cmath>

namespace lobelia {

/// A vector or a point in world space, right-handed, lengths in scene units.
struct Vec3 {
  double x = 0, y = 0, z = 0;
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(double k, Vec3 a) { return {k * a.x, k * a.y, k * a.z}; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Euclidean length without overflow or underflow for any finite input.
inline double length(Vec3 a) { return std::hypot(a.x, a.y, a.z); }
/// The unit vector along `a`; `a` must not be zero.
inline Vec3 normalize(Vec3 a) {
  // Scaled first, so that 1/length stays finite for denormal and huge vectors alike.
  const double m = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
  const Vec3 b{a.x / m, a.y / m, a.z / m};
  const double l = length(b);
  return {b.x / l, b.y / l, b.z / l};
}
/// The same, but keeps every bit of a unit vector, so that a scene survives writing and reading.
inline Vec3 as_unit(Vec3 a) { return std::abs(length(a) - 1) < 1e-15 ? a : normalize(a); }

/// The angle between unit vectors, radians, without the cancellation of acos near 0.
inline double angle_between(Vec3 a, Vec3 b) { return 2 * std::atan2(length(a - b), length(a + b)); }

/// Linear-light RGB, primaries of Rec. 709 (see docs/conventions.md).
struct Rgb {
  double r = 0, g = 0, b = 0;
  friend constexpr Rgb operator+(Rgb a, Rgb c) { return {a.r + c.r, a.g + c.g, a.b + c.b}; }
  friend constexpr Rgb operator*(double k, Rgb a) { return {k * a.r, k * a.g, k * a.b}; }
  friend constexpr Rgb operator*(Rgb a, Rgb c) { return {a.r * c.r, a.g * c.g, a.b * c.b}; }
  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

constexpr double max_component(Rgb a) { return std::max({a.r, a.g, a.b}); }
constexpr bool is_black(Rgb a) { return a.r == 0 && a.g == 0 && a.b == 0; }

}  // namespace lobelia
