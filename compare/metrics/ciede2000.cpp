// CIEDE2000: how far apart two colours look, in units of about one just noticeable difference.
//
// Source:       G. Sharma, W. Wu, E. N. Dalal, "The CIEDE2000 color-difference formula:
//               implementation notes, supplementary test data, and mathematical observations",
//               Color Research and Application 30 (2005) 21-30; equation numbers below are theirs.
// Formula:      per pixel between a and b; k_L = k_C = k_H = 1. mean and max over all pixels; p50,
//               p95 and p99 by nearest rank, without interpolation (percentile()).
// Input:        DisplayLight (linear, clipped). Converted to XYZ by the matrix of IEC 61966-2-1 (sRGB).
//               Its rows add up to the standard's D65 white (0.9505, 1, 1.0890). Lab uses that white, so
//               a grey is exactly neutral.
// Agrees with:  the 34 pairs of Sharma's Table 1, to the four digits printed there, in both orders.
// The tie:      hues exactly 180 degrees apart have two mean hues, and so two values. Pair 14 is such a
//               pair in decimal numbers (4.8045 or 4.7461). Eq. (10) and (14) take the plain mean of the
//               angles wherever they differ by no more than 180. So do we, which gives 4.8045, as printed.
//               In binary the angles come out within 1e-13 of the tie, on either side. A difference of
//               up to kTieDegrees over 180 therefore counts as 180.
// Differs:      the light of a pixel and its difference are rounded to float32, 6e-8 of each, before mean,
//               percentiles and maximum are taken. Everything between is in double, its powers, sines and cosines
//               by shorter ways than the formula: a test holds each pixel to the formula by std::, within 1e-7 of
//               the difference and 1e-9.
#include "compare/metrics/ciede2000.hpp"

#include <cmath>
#include <numbers>

#include "compare/metrics/shared_work.hpp"

// As in renderer/kernels/kernels.cpp: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/metrics/ciede2000.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "compare/metrics/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// So little over 180 is a tie decided by rounding: the angles have a few roundings of numbers up to 360.
constexpr double kTieDegrees = 1e-10;

template <class D>
struct LabLanes {
  LanesOf<D> l, a, b;
};

template <class Real>
HWY_INLINE Real squared(Real x) {
  return x * x;
}

template <class Real>
HWY_INLINE Real length(Real x, Real y) {
  return sqrt(squared(x) + squared(y));
}

/// C^7 / (C^7 + 25^7), in eq. (4) and (15).
template <class Real>
HWY_INLINE Real chroma_saturation(Real chroma) {
  const Real c2 = squared(chroma), c7 = squared(c2) * c2 * chroma;
  constexpr double k25To7 = 6103515625.0;
  return c7 / (c7 + k25To7);
}

/// Hue angle in degrees, [0, 360]; 0 for a neutral colour, eq. (7).
template <class Real>
HWY_INLINE Real hue(Real a, Real b) {
  const Real larger = max(abs(a), abs(b)), smaller = min(abs(a), abs(b));
  // Within the first eighth of the circle, then unfolded.
  const Real eighth = atan(smaller / where(larger > 0.0, larger, 1.0)) * (1 / kDegree);
  const Real quarter = where(abs(b) > abs(a), 90 - eighth, eighth);
  const Real half = where(a < 0.0, 180 - quarter, quarter);
  return where(b < 0.0, 360 - half, half);
}

template <class D>
HWY_INLINE LabLanes<D> lab_from_display(const RgbLanes<D>& shown) {
  using Real = LanesOf<D>;
  const Real x = 0.4124 * shown.r + 0.3576 * shown.g + 0.1805 * shown.b;
  const Real y = 0.2126 * shown.r + 0.7152 * shown.g + 0.0722 * shown.b;
  const Real z = 0.0193 * shown.r + 0.1192 * shown.g + 0.9505 * shown.b;
  const auto f = [](Real t) HWY_ATTR {
    constexpr double kDelta = 6.0 / 29.0;
    return where(t > kDelta * kDelta * kDelta, cube_root(t),
                 t * (1 / (3 * kDelta * kDelta)) + 4.0 / 29.0);
  };
  const Real fx = f(x * (1 / 0.9505)), fy = f(y), fz = f(z * (1 / 1.0890));
  return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

template <class D>
HWY_INLINE LanesOf<D> ciede2000(const LabLanes<D>& a, const LabLanes<D>& b) {
  using Real = LanesOf<D>;
  // (2)-(7): chroma and hue with the a axis stretched for colours near neutral.
  const Real mean_chroma_ab = (length(a.a, a.b) + length(b.a, b.b)) * 0.5;
  const Real stretch = 1.5 - 0.5 * sqrt(chroma_saturation(mean_chroma_ab));
  const Real a1 = stretch * a.a, a2 = stretch * b.a;
  const Real c1 = length(a1, a.b), c2 = length(a2, b.b);
  const Real h1 = hue(a1, a.b), h2 = hue(a2, b.b);
  const auto neutral = c1 * c2 == 0.0;

  // (8)-(11): the hue difference along the shorter arc.
  Real hue_step = where(neutral, 0.0, h2 - h1);
  hue_step = where(hue_step > 180 + kTieDegrees, hue_step - 360, hue_step);
  hue_step = where(hue_step < -180 - kTieDegrees, hue_step + 360, hue_step);
  const Real dl = b.l - a.l, dc = c2 - c1;
  const Real dh = 2 * sqrt(c1 * c2) * sin(hue_step * (0.5 * kDegree));

  // (12)-(14): the mean hue likewise.
  const Real mean_l = (a.l + b.l) * 0.5, mean_c = (c1 + c2) * 0.5, sum_h = h1 + h2;
  const Real around = sum_h + where(sum_h < 360.0, Real(360.0), -360.0);
  const Real mean_h =
      where(neutral, sum_h, where(abs(h1 - h2) > 180 + kTieDegrees, around, sum_h) * 0.5);

  // (15)-(21): the weights.
  // cos(n h + angle) by the cosines and sines of n h, which follow from those of h.
  const Real radians = mean_h * kDegree, cos_1 = cos(radians), sin_1 = sin(radians);
  const Real cos_2 = squared(cos_1) - squared(sin_1), sin_2 = 2 * cos_1 * sin_1;
  const Real cos_3 = cos_2 * cos_1 - sin_2 * sin_1, sin_3 = sin_2 * cos_1 + cos_2 * sin_1;
  const Real cos_4 = squared(cos_2) - squared(sin_2), sin_4 = 2 * cos_2 * sin_2;
  const double cos_30 = std::cos(30 * kDegree), cos_6 = std::cos(6 * kDegree),
               sin_6 = std::sin(6 * kDegree), cos_63 = std::cos(63 * kDegree),
               sin_63 = std::sin(63 * kDegree);
  const Real t = 1 - 0.17 * (cos_30 * cos_1 + 0.5 * sin_1) + 0.24 * cos_2 +
                 0.32 * (cos_6 * cos_3 - sin_6 * sin_3) - 0.20 * (cos_63 * cos_4 + sin_63 * sin_4);
  const Real rotation = 30 * exp(-squared((mean_h - 275) * (1.0 / 25)));
  const Real rc = 2 * sqrt(chroma_saturation(mean_c));
  const Real lightness = squared(mean_l - 50);
  const Real sl = 1 + 0.015 * lightness / sqrt(20 + lightness);
  const Real sc = 1 + 0.045 * mean_c;
  const Real sh = 1 + 0.015 * mean_c * t;
  const Real rt = -sin(2 * rotation * kDegree) * rc;

  // (22). The rotation term can make the sum negative by rounding alone.
  const Real l = dl / sl, c = dc / sc, h = dh / sh;
  const Real sum = squared(l) + squared(c) + squared(h) + rt * c * h;
  return sqrt(max(sum, 0.0));
}

}  // namespace

void ciede2000_lanes(const float* rgb_a, const float* rgb_b, float* out, std::size_t count) {
  store_differences(rgb_a, rgb_b, out, count, [](const auto& a, const auto& b) HWY_ATTR {
    return ciede2000(lab_from_display(a), lab_from_display(b));
  });
}

double ciede2000_of_one(Lab a, Lab b) {
  using Real = LanesOf<Single>;
  return hn::GetLane(
      ciede2000<Single>({Real(a.l), Real(a.a), Real(a.b)}, {Real(b.l), Real(b.a), Real(b.b)}).v);
}

Lab lab_of_one(Rgb shown) {
  using Real = LanesOf<Single>;
  const auto lab = lab_from_display<Single>({Real(shown.r), Real(shown.g), Real(shown.b)});
  return {hn::GetLane(lab.l.v), hn::GetLane(lab.a.v), hn::GetLane(lab.b.v)};
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {
namespace {

constexpr MetricOutput kOutputs[] = {
    {"ciede2000.mean", "CIEDE2000, mean", Unit::kPlain, Better::kLower, true,
     "CIEDE2000 colour difference, mean",
     "Colour difference as seen on a display at the cell’s exposure; 1 is about just noticeable."},
    {"ciede2000.p50", "CIEDE2000, median", Unit::kPlain, Better::kLower, true,
     "half of the pixels do not exceed this", "Half of the pixels differ by no more than this."},
    {"ciede2000.p95", "CIEDE2000, 95th percentile", Unit::kPlain, Better::kLower, true,
     "95 % of the pixels do not exceed this", "95 of 100 pixels differ by less than this."},
    {"ciede2000.p99", "CIEDE2000, 99th percentile", Unit::kPlain, Better::kLower, true,
     "99 % of the pixels do not exceed this", "99 of 100 pixels differ by no more than this."},
    {"ciede2000.max", "CIEDE2000, largest", Unit::kPlain, Better::kLower, true,
     "the largest of all pixels", "The pixel whose colour differs most."}};

void measure(const MetricInput& input, std::span<double> values) {
  const auto map = shared(input, "ciede2000", [&] {
    return ciede2000_of_pixels(input.shown_a, input.shown_b, input.needed());
  });
  write_figures(*map, input, {0.50, 0.95, 0.99}, values);
}

}  // namespace

HWY_EXPORT(ciede2000_lanes);
HWY_EXPORT(ciede2000_of_one);
HWY_EXPORT(lab_of_one);

double ciede2000(Lab a, Lab b) { return HWY_DYNAMIC_DISPATCH(ciede2000_of_one)(a, b); }

Lab lab_from_display(Rgb shown) { return HWY_DYNAMIC_DISPATCH(lab_of_one)(shown); }

PixelValues ciede2000_of_pixels(const DisplayLight& a, const DisplayLight& b,
                                std::span<const std::uint8_t> needed) {
  return pixel_differences(a, b, HWY_DYNAMIC_DISPATCH(ciede2000_lanes), needed);
}

extern constinit const Metric ciede2000_metric{
    kOutputs, Family::kColour, Needs::kNothing, "Sharma, Wu, Dalal 2005", measure, "ciede2000"};

}  // namespace lobelia
#endif  // HWY_ONCE
