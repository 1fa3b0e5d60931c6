// SIMD registers of doubles for the formulas of metrics. Compiled once for each instruction set, like the files
// that include it.
#include <hwy/highway.h>

#include <cstddef>

#if defined(LOBELIA_COMPARE_METRICS_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_COMPARE_METRICS_LANES_INL_HPP
#undef LOBELIA_COMPARE_METRICS_LANES_INL_HPP
#else
#define LOBELIA_COMPARE_METRICS_LANES_INL_HPP
#endif

#include <hwy/contrib/math/math-inl.h>

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Formulas treat it as a number. D is Highway's tag. Products and sums are rounded separately.
template <class D>
struct LanesOf {
  hn::Vec<D> v;

  HWY_INLINE LanesOf(double x) : v(hn::Set(D(), x)) {}
  HWY_INLINE explicit LanesOf(hn::Vec<D> x) : v(x) {}

  friend HWY_INLINE LanesOf operator+(LanesOf a, LanesOf b) { return LanesOf(hn::Add(a.v, b.v)); }
  friend HWY_INLINE LanesOf operator-(LanesOf a, LanesOf b) { return LanesOf(hn::Sub(a.v, b.v)); }
  friend HWY_INLINE LanesOf operator*(LanesOf a, LanesOf b) { return LanesOf(hn::Mul(a.v, b.v)); }
  friend HWY_INLINE LanesOf operator/(LanesOf a, LanesOf b) { return LanesOf(hn::Div(a.v, b.v)); }
  friend HWY_INLINE LanesOf operator-(LanesOf a) { return LanesOf(hn::Neg(a.v)); }
  friend HWY_INLINE auto operator<(LanesOf a, LanesOf b) { return hn::Lt(a.v, b.v); }
  friend HWY_INLINE auto operator>(LanesOf a, LanesOf b) { return hn::Gt(a.v, b.v); }
  friend HWY_INLINE auto operator==(LanesOf a, LanesOf b) { return hn::Eq(a.v, b.v); }

  friend HWY_INLINE LanesOf abs(LanesOf a) { return LanesOf(hn::Abs(a.v)); }
  friend HWY_INLINE LanesOf sqrt(LanesOf a) { return LanesOf(hn::Sqrt(a.v)); }
  friend HWY_INLINE LanesOf exp(LanesOf a) { return LanesOf(hn::Exp(D(), a.v)); }
  friend HWY_INLINE LanesOf sin(LanesOf a) { return LanesOf(hn::Sin(D(), a.v)); }
  friend HWY_INLINE LanesOf cos(LanesOf a) { return LanesOf(hn::Cos(D(), a.v)); }
  friend HWY_INLINE LanesOf atan(LanesOf a) { return LanesOf(hn::Atan(D(), a.v)); }
  friend HWY_INLINE LanesOf max(LanesOf a, LanesOf b) { return LanesOf(hn::Max(a.v, b.v)); }
  friend HWY_INLINE LanesOf min(LanesOf a, LanesOf b) { return LanesOf(hn::Min(a.v, b.v)); }
  friend HWY_INLINE LanesOf where(hn::Mask<D> mask, LanesOf yes, LanesOf no) {
    return LanesOf(hn::IfThenElse(mask, yes.v, no.v));
  }
  /// a^b for a >= 0; 0^b is 0.
  friend HWY_INLINE LanesOf pow(LanesOf a, LanesOf b) {
    const auto positive = hn::Gt(a.v, hn::Zero(D()));
    const auto base = hn::IfThenElse(positive, a.v, hn::Set(D(), 1));
    return LanesOf(hn::IfThenElseZero(positive, hn::Exp(D(), hn::Mul(b.v, hn::Log(D(), base)))));
  }
};

/// Linear light of a display.
template <class D>
struct RgbLanes {
  LanesOf<D> r, g, b;
};

/// Reads three floats a pixel.
template <class D>
HWY_INLINE RgbLanes<D> load_rgb(D d, const float* rgb) {
  const hn::Rebind<float, D> narrow;
  hn::Vec<decltype(narrow)> r, g, b;
  hn::LoadInterleaved3(narrow, rgb, r, g, b);
  return {LanesOf<D>(hn::PromoteTo(d, r)), LanesOf<D>(hn::PromoteTo(d, g)),
          LanesOf<D>(hn::PromoteTo(d, b))};
}

/// Writes the values rounded to float.
template <class D>
HWY_INLINE void store(LanesOf<D> values, float* out) {
  const hn::Rebind<float, D> narrow;
  hn::StoreU(hn::DemoteTo(narrow, values.v), narrow, out);
}

using Wide = hn::ScalableTag<double>;
using Single = hn::CappedTag<double, 1>;

/// Calls work(tag, i) for registers of pixels from pixel i on; the last few one by one.
template <class Work>
HWY_INLINE void for_all_pixels(std::size_t count, Work work) {
  std::size_t i = 0;
  for (; i + hn::Lanes(Wide()) <= count; i += hn::Lanes(Wide())) work(Wide(), i);
  for (; i < count; ++i) work(Single(), i);
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOBELIA_COMPARE_METRICS_LANES_INL_HPP
