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
  /// The cube root to a rounding or two, for a in [1e-3, 1e3], in half of pow()'s time.
  friend HWY_INLINE LanesOf cube_root(LanesOf a) {
    // z = a^(-1/3): begins with a third of the float's bits, and is refined without a division. With h = 1 - a z^3,
    // a^(-1/3) = z (1 - h)^(-1/3) = z (1 + h/3 + 2/9 h^2 + 14/81 h^3 + ...).
    const hn::Rebind<float, D> narrow;
    const hn::RebindToSigned<decltype(narrow)> integers;
    const auto set = [narrow](float x) HWY_ATTR { return hn::Set(narrow, x); };
    const auto t = hn::DemoteTo(narrow, a.v);
    const auto bits = hn::ConvertTo(narrow, hn::BitCast(integers, t));
    auto rough = hn::BitCast(
        narrow, hn::ConvertTo(integers, hn::Sub(set(1.4199e9f), hn::Mul(bits, set(1.0f / 3)))));
    const auto rest = hn::Sub(set(1), hn::Mul(hn::Mul(t, rough), hn::Mul(rough, rough)));
    rough = hn::Add(
        rough, hn::Mul(hn::Mul(rough, rest), hn::Add(set(1.0f / 3), hn::Mul(set(2.0f / 9), rest))));
    // Here h is less than 1e-3, and 1e-12 after the step.
    LanesOf z(hn::PromoteTo(D(), rough));
    const LanesOf h = 1 - a * z * (z * z);
    z = z + z * h * (1.0 / 3 + h * (2.0 / 9 + h * (14.0 / 81)));
    const LanesOf root = a * (z * z);
    return root + root * ((1 - root * z) * (2.0 / 3));
  }
};

/// Whether all pixels of the register have the same light in both pictures.
template <class D>
HWY_INLINE bool are_equal(D, const float* rgb_a, const float* rgb_b) {
  const hn::Rebind<float, D> narrow;
  const std::size_t lanes = hn::Lanes(narrow);
  auto equal = hn::Eq(hn::LoadU(narrow, rgb_a), hn::LoadU(narrow, rgb_b));
  for (std::size_t i = 1; i < 3; ++i)
    equal = hn::And(
        equal, hn::Eq(hn::LoadU(narrow, rgb_a + i * lanes), hn::LoadU(narrow, rgb_b + i * lanes)));
  return hn::AllTrue(narrow, equal);
}

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

/// Writes difference(a, b) of each pixel, where a and b are RgbLanes, and 0 where the pictures are equal.
template <class Difference>
HWY_INLINE void store_differences(const float* rgb_a, const float* rgb_b, float* out,
                                  std::size_t count, Difference difference) {
  for_all_pixels(count, [&](auto d, std::size_t i) HWY_ATTR {
    const float *a = rgb_a + 3 * i, *b = rgb_b + 3 * i;
    // Much of a picture is often equal, such as the background.
    store(
        are_equal(d, a, b) ? LanesOf<decltype(d)>(0.0) : difference(load_rgb(d, a), load_rgb(d, b)),
        out + i);
  });
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // LOBELIA_COMPARE_METRICS_LANES_INL_HPP
