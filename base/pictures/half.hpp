// Half floats (IEEE 754 binary16), emulated exactly: 11 binary digits, 2^-24 to 65504.
//
// Every operation rounds once, to nearest, ties to even; what is too large becomes infinite. + - * are exact in
// double. / and sqrt are not, but double has more than the 2 * 11 + 2 digits with which a second rounding changes
// nothing (Figueroa 1995). exp, log, pow and the like are double's, rounded: correctly rounded, but for a case within
// double's own error of the middle between two half floats. A processor's may be worse.
#pragma once

#include <bit>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>

#include "base/words/vec.hpp"

namespace lobelia {

inline constexpr double kLeastNormalHalf = 0x1p-14, kGreatestHalf = 65504;

/// The nearest half float; infinite from 65520 on.
inline double rounded_to_half(double x) {
  constexpr int kDropped = 52 - 10;
  constexpr double kSubnormalStep = 0x1p-24, kAligned = 0x1.8p52 * kSubnormalStep;
  const double size = std::abs(x);
  if (size < kLeastNormalHalf) return std::copysign((size + kAligned) - kAligned, x);
  if (!(size < kGreatestHalf + 16))
    return std::isnan(x) ? x : std::copysign(std::numeric_limits<double>::infinity(), x);
  const auto bits = std::bit_cast<std::uint64_t>(x);
  constexpr std::uint64_t kRest = (std::uint64_t{1} << kDropped) - 1;
  return std::bit_cast<double>((bits + kRest / 2 + (bits >> kDropped & 1)) & ~kRest);
}

class Half {
 public:
  using Scalar = Half;

  Half() = default;
  // Not explicit, so that a formula may have numbers in it.
  Half(double x) : value_(float(rounded_to_half(x))) {}
  explicit operator double() const { return value_; }
  explicit operator float() const { return value_; }

  friend Half operator+(Half a, Half b) { return a.wide() + b.wide(); }
  friend Half operator-(Half a, Half b) { return a.wide() - b.wide(); }
  friend Half operator*(Half a, Half b) { return a.wide() * b.wide(); }
  friend Half operator/(Half a, Half b) { return a.wide() / b.wide(); }
  friend Half operator-(Half a) { return -a.wide(); }
  friend auto operator<=>(Half a, Half b) = default;

  friend Half sqrt(Half x) { return std::sqrt(x.wide()); }
  friend Half abs(Half x) { return std::abs(x.wide()); }
  friend Half max(Half a, Half b) { return a < b ? b : a; }
  friend Half min(Half a, Half b) { return b < a ? b : a; }
  friend Half exp(Half x) { return std::exp(x.wide()); }
  friend Half log(Half x) { return std::log(x.wide()); }
  friend Half pow(Half x, Half y) { return std::pow(x.wide(), y.wide()); }
  friend Half sin(Half x) { return std::sin(x.wide()); }
  friend Half cos(Half x) { return std::cos(x.wide()); }
  friend Half tan(Half x) { return std::tan(x.wide()); }
  friend Half asin(Half x) { return std::asin(x.wide()); }
  friend Half acos(Half x) { return std::acos(x.wide()); }
  friend Half atan(Half x) { return std::atan(x.wide()); }

 private:
  double wide() const { return value_; }

  float value_ = 0;
};

struct Half3 {
  Half x, y, z;
  Half3() = default;
  Half3(Half x_, Half y_, Half z_) : x(x_), y(y_), z(z_) {}
  explicit Half3(Vec3 a) : x(a.x), y(a.y), z(a.z) {}
  friend Half3 operator+(Half3 a, Half3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Half3 operator-(Half3 a, Half3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Half3 operator*(Half k, Half3 a) { return {k * a.x, k * a.y, k * a.z}; }
  friend Half3 operator/(Half3 a, Half k) { return {a.x / k, a.y / k, a.z / k}; }
  friend Half dot(Half3 a, Half3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend Half length(Half3 a) { return sqrt(dot(a, a)); }
};

}  // namespace lobelia
