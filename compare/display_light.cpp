#include "compare/display_light.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "base/system/scratch_memory.hpp"

// As in renderer/kernels/kernels.cpp: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/display_light.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Values below 0 and NaN become 0.
template <class D>
HWY_INLINE hn::Vec<D> clipped(D d, hn::Vec<D> v) {
  return hn::IfThenElseZero(hn::Gt(v, hn::Zero(d)), hn::Min(v, hn::Set(d, 1)));
}

/// Calls convert(d, vector) for all values. The last vector overlaps the one before; fewer values come one by one.
template <class D, class Convert>
HWY_INLINE void for_all(D d, const float* in, float* out, std::size_t count, Convert convert) {
  std::size_t i = 0;
  for (; i + hn::Lanes(d) <= count; i += hn::Lanes(d))
    hn::StoreU(convert(d, hn::LoadU(d, in + i)), d, out + i);
  if (i > 0 && i < count) {
    i = count - hn::Lanes(d);
    hn::StoreU(convert(d, hn::LoadU(d, in + i)), d, out + i);
    return;
  }
  const hn::CappedTag<float, 1> one;
  for (; i < count; ++i) hn::StoreU(convert(one, hn::LoadU(one, in + i)), one, out + i);
}

void clip_lanes(double gain, const float* in, float* out, std::size_t count) {
  int exponent = 0;
  // A product with a power of two is as exact in float32.
  if (std::frexp(gain, &exponent) == 0.5 && std::abs(exponent) < 120)
    return for_all(hn::ScalableTag<float>(), in, out, count, [gain](auto d, auto v) HWY_ATTR {
      return clipped(d, hn::Mul(hn::Set(d, float(gain)), v));
    });
  for_all(hn::Rebind<float, hn::ScalableTag<double>>(), in, out, count,
          [gain](auto d, auto v) HWY_ATTR {
            const hn::Rebind<double, decltype(d)> wide;
            return hn::DemoteTo(
                d, clipped(wide, hn::Mul(hn::Set(wide, gain), hn::PromoteTo(wide, v))));
          });
}

void rational_lanes(const ToneConstants& constants, float gain, const float* in, float* out,
                    std::size_t count) {
  for_all(hn::ScalableTag<float>(), in, out, count, [&constants, gain](auto d, auto v) HWY_ATTR {
    const auto c = [&constants, d](int i) HWY_ATTR { return hn::Set(d, constants.c[i]); };
    const auto scaled = hn::Mul(hn::Set(d, gain), v);
    const auto x = hn::IfThenElseZero(hn::Gt(scaled, hn::Zero(d)), scaled), square = hn::Mul(x, x);
    const auto above = hn::Add(hn::Add(hn::Mul(square, c(0)), hn::Mul(x, c(1))), c(2));
    const auto below = hn::Add(hn::Add(hn::Mul(square, c(3)), hn::Mul(x, c(4))), c(5));
    const auto huge = hn::Gt(square, hn::Set(d, std::numeric_limits<float>::max()));
    return hn::IfThenElse(huge, hn::Set(d, 1.0f), clipped(d, hn::Div(above, below)));
  });
}

template <class D>
HWY_INLINE void reinhard(D d, float gain, const float* in, float* out) {
  hn::Vec<D> rgb[3];
  hn::LoadInterleaved3(d, in, rgb[0], rgb[1], rgb[2]);
  for (auto& v : rgb) {
    v = hn::Mul(hn::Set(d, gain), v);
    v = hn::IfThenElseZero(hn::Gt(v, hn::Zero(d)), v);
  }
  const auto luminance =
      hn::Add(hn::Add(hn::Mul(hn::Set(d, 0.2126f), rgb[0]), hn::Mul(hn::Set(d, 0.7152f), rgb[1])),
              hn::Mul(hn::Set(d, 0.0722f), rgb[2]));
  const auto factor = hn::Div(hn::Set(d, 1.0f), hn::Add(hn::Set(d, 1.0f), luminance));
  const auto is_huge =
      hn::Gt(hn::Mul(luminance, luminance), hn::Set(d, std::numeric_limits<float>::max()));
  for (auto& v : rgb)
    v = hn::IfThenElse(hn::And(is_huge, hn::Gt(v, hn::Zero(d))), hn::Set(d, 1.0f),
                       clipped(d, hn::Mul(v, factor)));
  hn::StoreInterleaved3(rgb[0], rgb[1], rgb[2], d, out);
}

void reinhard_lanes(float gain, const float* in, float* out, std::size_t count) {
  const hn::ScalableTag<float> d;
  std::size_t i = 0;
  for (; i + 3 * hn::Lanes(d) <= count; i += 3 * hn::Lanes(d)) reinhard(d, gain, in + i, out + i);
  for (; i < count; i += 3) reinhard(hn::CappedTag<float, 1>(), gain, in + i, out + i);
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(clip_lanes);
HWY_EXPORT(rational_lanes);
HWY_EXPORT(reinhard_lanes);

DisplayLight::DisplayLight(const Image& image, double exposure_stops, ToneCurve curve)
    : image_(&image),
      curve_(curve),
      gain_(curve == ToneCurve::kClip ? std::exp2(exposure_stops)
                                      : double(std::pow(2.0f, float(exposure_stops)))) {}

DisplayLight DisplayLight::of(const Image& image, double exposure_stops, const DisplayView* view) {
  if (!view) return {image, exposure_stops};
  auto shown = std::make_shared<const Image>(view->shown(image, exposure_stops));
  DisplayLight light(*shown, 0);
  light.shown_ = std::move(shown);
  return light;
}

void DisplayLight::fill(int y, int first, std::span<float> rgb) const {
  const std::size_t start = std::size_t(y) * std::size_t(width()) + std::size_t(first);
  const float* values = image_->values().data() + 3 * start;
  if (curve_ == ToneCurve::kClip)
    HWY_DYNAMIC_DISPATCH(clip_lanes)(gain_, values, rgb.data(), rgb.size());
  else if (curve_ == ToneCurve::kReinhard)
    HWY_DYNAMIC_DISPATCH(reinhard_lanes)(float(gain_), values, rgb.data(), rgb.size());
  else
    HWY_DYNAMIC_DISPATCH(rational_lanes)
  (tone_constants(curve_), float(gain_), values, rgb.data(), rgb.size());
  looked_at_row(rgb.size_bytes());
}

}  // namespace lobelia
#endif  // HWY_ONCE
