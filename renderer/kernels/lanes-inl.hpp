// LanesOf<double>, LanesOf<float>: a SIMD register with the operators of a number and the functions of
// renderer/real.hpp. Compiled once for each instruction set.
#include <hwy/highway.h>

#include <bit>

#include "renderer/real.hpp"

#if defined(LOBELIA_RENDERER_KERNELS_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_RENDERER_KERNELS_LANES_INL_HPP
#undef LOBELIA_RENDERER_KERNELS_LANES_INL_HPP
#else
#define LOBELIA_RENDERER_KERNELS_LANES_INL_HPP
#endif

#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// P(s) of 2 asin^2(sqrt(s/2)) = s + s^2 P(s), interpolated at Chebyshev's points of [0, 1], constant term first:
/// within 4e-9 of P. The arc sine in float32 would be off by four units in the last place.
inline constexpr float kHalfSquareOfAngle[] = {0.1666666688f,   0.04444409844f,  0.01429481116f,
                                               0.004988465579f, 0.002371639728f, -0.0004488384646f,
                                               0.002161792173f, -0.00140708189f, 0.0006289906971f};

/// Q(f) of log(1 + f) = f - f^2/2 + f^3 Q(f) for 1 + f from sqrt(1/2) to sqrt(2), within 1.9e-7, and P(r) of
/// exp(r) = 1 + r + r^2 P(r) for |r| up to log(2)/2, within 6.5e-8: as above.
inline constexpr float kLogarithm[] = {0.3333333073f,  -0.2500030642f, 0.2000104509f,
                                       -0.1664128146f, 0.1421449592f,  -0.1299818376f,
                                       0.1262231985f,  -0.07902743772f};
inline constexpr float kExponential[] = {0.5f, 0.1666657703f, 0.04166655466f, 0.008363173075f,
                                         0.001392617612f};
/// log(2) in two parts; products of the first with an exponent of float32 are exact.
inline constexpr float kLog2High = 0x1.63p-1f, kLog2Low = -2.12194440e-4f;

template <class T>
struct LanesOf {
  using Scalar = T;
  using D = hn::ScalableTag<T>;
  hn::Vec<D> v;

  LanesOf() = default;
  HWY_INLINE LanesOf(double x) : v(hn::Set(D(), T(x))) {}
  HWY_INLINE explicit LanesOf(hn::Vec<D> x) : v(x) {}

  static HWY_INLINE std::size_t count() { return hn::Lanes(D()); }
  static HWY_INLINE LanesOf load(const T* from) { return LanesOf(hn::LoadU(D(), from)); }
  HWY_INLINE void store(T* to) const { hn::StoreU(v, D(), to); }

  friend HWY_INLINE LanesOf operator+(LanesOf a, LanesOf b) { return LanesOf(hn::Add(a.v, b.v)); }
  friend HWY_INLINE LanesOf operator-(LanesOf a, LanesOf b) { return LanesOf(hn::Sub(a.v, b.v)); }
  friend HWY_INLINE LanesOf operator*(LanesOf a, LanesOf b) { return LanesOf(hn::Mul(a.v, b.v)); }
  friend HWY_INLINE LanesOf operator/(LanesOf a, LanesOf b) { return LanesOf(hn::Div(a.v, b.v)); }
  friend HWY_INLINE LanesOf operator-(LanesOf a) { return LanesOf(hn::Neg(a.v)); }

  friend HWY_INLINE LanesOf sqrt(LanesOf a) { return LanesOf(hn::Sqrt(a.v)); }
  friend HWY_INLINE LanesOf positive_part(LanesOf a) {
    return LanesOf(hn::Max(a.v, hn::Zero(D())));
  }
  friend HWY_INLINE LanesOf where_less(LanesOf a, LanesOf b, LanesOf value) {
    return LanesOf(hn::IfThenElseZero(hn::Lt(a.v, b.v), value.v));
  }
  friend HWY_INLINE LanesOf exp_or_zero(LanesOf x) {
    const D d;
    // The logarithm of the smallest normal number, rounded towards 0; and a bound of arguments that count as 0,
    // because their powers in a polynomial would be subnormal.
    constexpr T kLowest = std::is_same_v<T, float> ? T(-87.3365402) : T(-708.3964185322640);
    constexpr T kHighest = -std::numeric_limits<T>::epsilon() / 8;
    const auto normal = hn::Ge(x.v, hn::Set(d, kLowest));
    const auto counts = hn::And(normal, hn::Le(x.v, hn::Set(d, kHighest)));
    const auto inside = hn::IfThenElseZero(counts, x.v);
    if constexpr (std::is_same_v<T, float>)
      return LanesOf(hn::IfThenElseZero(normal, exp32(LanesOf(inside)).v));
    else
      return LanesOf(hn::IfThenElseZero(normal, hn::Exp(d, inside)));
  }
  friend HWY_INLINE LanesOf log_one_minus(LanesOf s) {
    const D d;
    // There is no logarithm for s >= 1; s = 0 instead keeps the arithmetic finite.
    const auto inside = hn::IfThenElseZero(hn::Lt(s.v, hn::Set(d, T(1))), s.v);
    if constexpr (std::is_same_v<T, float>)
      return log_one_minus32(LanesOf(inside));
    else
      return LanesOf(hn::Log1p(d, hn::Neg(inside)));
  }
  friend HWY_INLINE LanesOf half_square_of_angle(LanesOf s) {
    const D d;
    const LanesOf inside(hn::Min(s.v, hn::Set(d, T(1))));
    if constexpr (std::is_same_v<T, float>) {
      return inside + inside * inside * horner(kHalfSquareOfAngle, inside);
    } else {
      const LanesOf half_angle(hn::Asin(d, sqrt(LanesOf(0.5) * inside).v));
      return LanesOf(2.0) * half_angle * half_angle;
    }
  }
  friend HWY_INLINE LanesOf multiply_add(LanesOf a, LanesOf b, LanesOf c) {
    return LanesOf(hn::MulAdd(a.v, b.v, c.v));
  }
  friend HWY_INLINE LanesOf one_minus_product(double q, LanesOf s) {
    if constexpr (std::is_same_v<T, float>) {
      const D d;
#if HWY_NATIVE_FMA
      const LanesOf high(q), low(q - double(float(q)));
      return LanesOf(hn::NegMulAdd(high.v, s.v, hn::Set(d, 1.0f))) - low * s;
#else
      const hn::ScalableTag<double> wide;
      const hn::Half<D> half;
      const auto difference = [&](auto lanes) HWY_ATTR {
        const auto product = hn::Mul(hn::Set(wide, q), hn::PromoteTo(wide, lanes));
        return hn::DemoteTo(half, hn::Sub(hn::Set(wide, 1.0), product));
      };
      return LanesOf(hn::Combine(d, difference(hn::UpperHalf(half, s.v)),
                                 difference(hn::LowerHalf(half, s.v))));
#endif
    } else {
      return LanesOf(1.0) - LanesOf(q) * s;
    }
  }

 private:
  template <std::size_t kTerms>
  static HWY_INLINE LanesOf horner(const float (&c)[kTerms], LanesOf x) {
    LanesOf sum(c[kTerms - 1]);
    for (std::size_t i = kTerms - 1; i-- > 0;) sum = multiply_add(sum, x, LanesOf(c[i]));
    return sum;
  }
  /// The float32 functions below are within two units in the last place, and so a power within 1e-7 of its peak, in two
  /// thirds of the time of Highway's, which hold for all arguments.
  /// For s from 0 to below 1.
  static HWY_INLINE LanesOf log_one_minus32(LanesOf s) {
    const D d;
    const hn::RebindToSigned<D> whole;
    const LanesOf c = LanesOf(1.0) - s;
    const LanesOf lost =
        (LanesOf(1.0) - c) - s;  // c + lost is 1 - s exactly; lost is 0 where c is far from 1
    constexpr std::int32_t kRootOfHalf = 0x3f3504f3;
    const auto bits = hn::BitCast(whole, c.v);
    const auto k = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(whole, kRootOfHalf)));
    const LanesOf power(hn::ConvertTo(d, k));
    const LanesOf f = LanesOf(hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(k)))) - LanesOf(1.0);
    const LanesOf square = f * f;
    LanesOf sum = multiply_add(power, LanesOf(kLog2Low), lost);
    sum = multiply_add(f * square, horner(kLogarithm, f), sum);
    sum = multiply_add(LanesOf(-0.5), square, sum) + f;
    return multiply_add(power, LanesOf(kLog2High), sum);
  }
  /// For x from the logarithm of the smallest normal number to 0.
  static HWY_INLINE LanesOf exp32(LanesOf x) {
    const D d;
    const hn::RebindToSigned<D> whole;
    const LanesOf power(hn::Round((x * LanesOf(1.44269504)).v));
    LanesOf r = multiply_add(power, LanesOf(-kLog2High), x);
    r = multiply_add(power, LanesOf(-kLog2Low), r);
    const LanesOf value = multiply_add(r * r, horner(kExponential, r), LanesOf(1.0) + r);
    const auto bits =
        hn::Add(hn::BitCast(whole, value.v), hn::ShiftLeft<23>(hn::ConvertTo(whole, power.v)));
    return LanesOf(hn::BitCast(d, bits));
  }
};
using Lanes = LanesOf<double>;
using Lanes32 = LanesOf<float>;

/// Two registers of doubles rounded to one of floats, and back.
HWY_INLINE Lanes32 narrow(Lanes low, Lanes high) {
  const hn::ScalableTag<float> d;
  const hn::Half<hn::ScalableTag<float>> half;
  return Lanes32(hn::Combine(d, hn::DemoteTo(half, high.v), hn::DemoteTo(half, low.v)));
}
HWY_INLINE void widen(Lanes32 a, Lanes& low, Lanes& high) {
  const hn::ScalableTag<double> wide;
  const hn::Half<hn::ScalableTag<float>> half;
  low = Lanes(hn::PromoteTo(wide, hn::LowerHalf(half, a.v)));
  high = Lanes(hn::PromoteTo(wide, hn::UpperHalf(half, a.v)));
}

/// (1 - s)^n by squaring, in float64: there a power multiplies no rounding that float32 would show. n >= 1; 0 where
/// 1 - s is less than `smallest` (smallest_base() in renderer/real.hpp).
HWY_INLINE Lanes32 power_of_one_minus(Lanes32 s, int n, double smallest) {
  const hn::ScalableTag<double> d;
  Lanes low, high;
  widen(s, low, high);
  const auto base = [&](Lanes x) HWY_ATTR {
    const auto rest = hn::Sub(hn::Set(d, 1.0), x.v);
    return Lanes(hn::IfThenElseZero(hn::Ge(rest, hn::Set(d, smallest)), rest));
  };
  low = base(low), high = base(high);
  Lanes low_power = low, high_power = high;
  for (int bit = std::bit_floor(unsigned(n)) >> 1; bit > 0; bit >>= 1) {
    low_power = low_power * low_power, high_power = high_power * high_power;
    if (n & bit) low_power = low_power * low, high_power = high_power * high;
  }
  return narrow(low_power, high_power);
}

/// 1 / sqrt(a) within 1.5 units in the last place, for a from 1e-30 to 1e30: the float32 value and a step of third
/// order. Takes half the time of float64's root and division.
using Starts = hn::Rebind<float, hn::ScalableTag<double>>;
HWY_INLINE hn::Vec<Starts> start_of_inverse_sqrt(Lanes a) {
  return hn::Div(hn::Set(Starts(), 1.0f), hn::Sqrt(hn::DemoteTo(Starts(), a.v)));
}
/// The same of two registers.
HWY_INLINE Lanes32 starts_of_inverse_sqrt(Lanes low, Lanes high) {
  return Lanes32(1.0f) / sqrt(narrow(low, high));
}
HWY_INLINE Lanes refine_inverse_sqrt(Lanes a, hn::Vec<Starts> start) {
  const hn::ScalableTag<double> d;
  const auto y = hn::PromoteTo(d, start);
  const auto rest = hn::NegMulAdd(hn::Mul(a.v, y), y, hn::Set(d, 1.0));
  const auto share = hn::MulAdd(rest, hn::Set(d, 0.375), hn::Set(d, 0.5));
  return Lanes(hn::MulAdd(hn::Mul(y, rest), share, y));
}
HWY_INLINE Lanes inverse_sqrt(Lanes a) { return refine_inverse_sqrt(a, start_of_inverse_sqrt(a)); }

template <class T>
struct Lanes3Of {
  LanesOf<T> x, y, z;
  Lanes3Of() = default;
  HWY_INLINE Lanes3Of(LanesOf<T> x_, LanesOf<T> y_, LanesOf<T> z_) : x(x_), y(y_), z(z_) {}
  // Register by register: GCC 12 would copy the structure as bytes, through memory.
  HWY_INLINE Lanes3Of(const Lanes3Of& a) : x(a.x), y(a.y), z(a.z) {}
  HWY_INLINE Lanes3Of& operator=(const Lanes3Of& a) {
    x = a.x, y = a.y, z = a.z;
    return *this;
  }
  friend HWY_INLINE Lanes3Of operator+(Lanes3Of a, Lanes3Of b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend HWY_INLINE Lanes3Of operator-(Lanes3Of a, Lanes3Of b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend HWY_INLINE Lanes3Of operator*(LanesOf<T> k, Lanes3Of a) {
    return {k * a.x, k * a.y, k * a.z};
  }
  // Fused if the processor can: half of the instructions, and one rounding less.
  friend HWY_INLINE LanesOf<T> dot(Lanes3Of a, Lanes3Of b) {
    return LanesOf<T>(hn::MulAdd(a.z.v, b.z.v, hn::MulAdd(a.y.v, b.y.v, hn::Mul(a.x.v, b.x.v))));
  }
  /// k a + b
  friend HWY_INLINE Lanes3Of add_scaled(LanesOf<T> k, Lanes3Of a, Lanes3Of b) {
    return {LanesOf<T>(hn::MulAdd(k.v, a.x.v, b.x.v)), LanesOf<T>(hn::MulAdd(k.v, a.y.v, b.y.v)),
            LanesOf<T>(hn::MulAdd(k.v, a.z.v, b.z.v))};
  }
  /// b - k a
  friend HWY_INLINE Lanes3Of subtract_scaled(LanesOf<T> k, Lanes3Of a, Lanes3Of b) {
    return {LanesOf<T>(hn::NegMulAdd(k.v, a.x.v, b.x.v)),
            LanesOf<T>(hn::NegMulAdd(k.v, a.y.v, b.y.v)),
            LanesOf<T>(hn::NegMulAdd(k.v, a.z.v, b.z.v))};
  }
};
using Lanes3 = Lanes3Of<double>;

HWY_INLINE Lanes3Of<float> narrow(Lanes3 low, Lanes3 high) {
  return {narrow(low.x, high.x), narrow(low.y, high.y), narrow(low.z, high.z)};
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
