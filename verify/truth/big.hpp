// The number that truths are computed in, and vectors of it. For .cpp files of verify/truth/ alone: it takes
// seconds to compile. The rest of the room sees truths rounded to double.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <limits>

#include "core/vec.hpp"

namespace lobelia::truth {

/// 50 decimal digits; no function of it is shared with the renderer, which has only those of the
/// standard library and of Highway.
using Big = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                          boost::multiprecision::et_off>;
static_assert(std::numeric_limits<Big>::digits >= 113);

struct Big3 {
  Big x = 0, y = 0, z = 0;
  Big3() = default;
  Big3(Big x_, Big y_, Big z_) : x(std::move(x_)), y(std::move(y_)), z(std::move(z_)) {}
  explicit Big3(Vec3 v) : x(v.x), y(v.y), z(v.z) {}
  friend Big3 operator+(const Big3& a, const Big3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Big3 operator-(const Big3& a, const Big3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Big3 operator*(const Big& k, const Big3& a) { return {k * a.x, k * a.y, k * a.z}; }
};
inline Big dot(const Big3& a, const Big3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Big3 cross(const Big3& a, const Big3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Big3 normalize(const Big3& a) { return Big(1 / sqrt(dot(a, a))) * a; }

}  // namespace lobelia::truth
