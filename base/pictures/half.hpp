// Half floats (IEEE 754 binary16), emulated exactly: 11 binary digits, 2^-24 to 65504.
//
// Every operation rounds once, to nearest, ties to even; what is too large becomes infinite. + - * are exact in
// double. / and sqrt are not, but double has more than the 2 * 11 + 2 digits with which a second rounding changes
// nothing (Figueroa 1995). exp, log, pow and the like are double's, rounded: correctly rounded, but for a case within
// double's own error of the middle between two half floats. A processor's may be worse.
#pragma once

#include <bit>
#include <cmath>
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

/// Some processors replace subnormal operands and results by 0. GLSL and HLSL allow it.
enum class Subnormals : std::uint8_t { kKept, kFlushed };

template <Subnormals kSubnormals>
class HalfOf {
 public:
  using Scalar = HalfOf;

  HalfOf() = default;
  // Not explicit, so that a formula may have numbers in it.
  HalfOf(double x) : value_(float(rounded_to_half(x))) {
    if (kSubnormals == Subnormals::kFlushed && std::abs(value_) < float(kLeastNormalHalf))
      value_ = std::copysign(0.0f, value_);
  }
  explicit operator double() const { return value_; }
  explicit operator float() const { return value_; }

  friend HalfOf operator+(HalfOf a, HalfOf b) { return a.wide() + b.wide(); }
  friend HalfOf operator-(HalfOf a, HalfOf b) { return a.wide() - b.wide(); }
  friend HalfOf operator*(HalfOf a, HalfOf b) { return a.wide() * b.wide(); }
  friend HalfOf operator/(HalfOf a, HalfOf b) { return a.wide() / b.wide(); }
  friend HalfOf operator-(HalfOf a) { return -a.wide(); }
  friend bool operator==(HalfOf a, HalfOf b) { return a.value_ == b.value_; }
  friend auto operator<=>(HalfOf a, HalfOf b) { return a.value_ <=> b.value_; }

  friend HalfOf sqrt(HalfOf x) { return std::sqrt(x.wide()); }
  friend HalfOf abs(HalfOf x) { return std::abs(x.wide()); }
  friend HalfOf max(HalfOf a, HalfOf b) { return a < b ? b : a; }
  friend HalfOf min(HalfOf a, HalfOf b) { return b < a ? b : a; }
  friend HalfOf exp(HalfOf x) { return std::exp(x.wide()); }
  friend HalfOf log(HalfOf x) { return std::log(x.wide()); }
  friend HalfOf pow(HalfOf x, HalfOf y) { return std::pow(x.wide(), y.wide()); }
  friend HalfOf sin(HalfOf x) { return std::sin(x.wide()); }
  friend HalfOf cos(HalfOf x) { return std::cos(x.wide()); }
  friend HalfOf tan(HalfOf x) { return std::tan(x.wide()); }
  friend HalfOf asin(HalfOf x) { return std::asin(x.wide()); }
  friend HalfOf acos(HalfOf x) { return std::acos(x.wide()); }
  friend HalfOf atan(HalfOf x) { return std::atan(x.wide()); }

 private:
  double wide() const { return value_; }

  float value_ = 0;
};
using Half = HalfOf<Subnormals::kKept>;
using FlushedHalf = HalfOf<Subnormals::kFlushed>;

template <class T>
struct Half3Of {
  T x, y, z;
  Half3Of() = default;
  Half3Of(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
  explicit Half3Of(Vec3 a) : x(a.x), y(a.y), z(a.z) {}
  friend Half3Of operator+(Half3Of a, Half3Of b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Half3Of operator-(Half3Of a, Half3Of b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Half3Of operator*(T k, Half3Of a) { return {k * a.x, k * a.y, k * a.z}; }
  friend Half3Of operator/(Half3Of a, T k) { return {a.x / k, a.y / k, a.z / k}; }
  friend T dot(Half3Of a, Half3Of b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend T length(Half3Of a) { return sqrt(dot(a, a)); }
};
using Half3 = Half3Of<Half>;

}  // namespace lobelia
