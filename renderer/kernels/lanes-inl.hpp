// Lanes: a SIMD register of doubles that can be written like a double, with the functions of
// renderer/real.hpp. Compiled once for each instruction set.
//
// Double precision throughout: float32 unit vectors alone cost 2e-4 of the peak at n = 1e5.
#include <hwy/highway.h>

#include <cstddef>

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

struct Lanes {
  using D = hn::ScalableTag<double>;
  hn::Vec<D> v;

  Lanes() = default;
  HWY_INLINE Lanes(double x) : v(hn::Set(D(), x)) {}
  HWY_INLINE explicit Lanes(hn::Vec<D> x) : v(x) {}

  static HWY_INLINE std::size_t count() { return hn::Lanes(D()); }
  static HWY_INLINE Lanes load(const double* from) { return Lanes(hn::LoadU(D(), from)); }
  HWY_INLINE void store(double* to) const { hn::StoreU(v, D(), to); }

  friend HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return Lanes(hn::Add(a.v, b.v)); }
  friend HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return Lanes(hn::Sub(a.v, b.v)); }
  friend HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return Lanes(hn::Mul(a.v, b.v)); }
  friend HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return Lanes(hn::Div(a.v, b.v)); }
  friend HWY_INLINE Lanes operator-(Lanes a) { return Lanes(hn::Neg(a.v)); }

  friend HWY_INLINE Lanes sqrt(Lanes a) { return Lanes(hn::Sqrt(a.v)); }
  friend HWY_INLINE Lanes positive_part(Lanes a) { return Lanes(hn::ZeroIfNegative(a.v)); }
  friend HWY_INLINE Lanes step_positive(Lanes a) { return zero_unless_positive(a, Lanes(1.0)); }
  /// b where a > 0, else 0, even where b is NaN.
  friend HWY_INLINE Lanes zero_unless_positive(Lanes a, Lanes b) {
    return Lanes(hn::IfThenElseZero(hn::Gt(a.v, hn::Zero(D())), b.v));
  }
  friend HWY_INLINE Lanes power_of_one_minus(Lanes s, Lanes n) {
    const D d;
    const auto inside = hn::Lt(s.v, hn::Set(d, 1.0));
    // Where s >= 1 the logarithm has no value; s = 0 there keeps the arithmetic finite.
    const auto safe = hn::IfThenElseZero(inside, s.v);
    const auto value = hn::Exp(d, hn::Mul(n.v, hn::Log1p(d, hn::Neg(safe))));
    return Lanes(hn::IfThenElseZero(inside, value));
  }
};

struct Lanes3 {
  Lanes x, y, z;
  friend HWY_INLINE Lanes3 operator+(Lanes3 a, Lanes3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend HWY_INLINE Lanes3 operator-(Lanes3 a, Lanes3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend HWY_INLINE Lanes3 operator*(Lanes k, Lanes3 a) { return {k * a.x, k * a.y, k * a.z}; }
  friend HWY_INLINE Lanes dot(Lanes3 a, Lanes3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
};

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
