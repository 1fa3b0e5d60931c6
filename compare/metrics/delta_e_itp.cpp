// Delta E ITP: how far apart two colours look on a display of high dynamic range. 1 is just noticeable
// to an eye in its best state of adaptation.
//
// Source:       Recommendation ITU-R BT.2124-0 (2019), Annex 1. Its parts: primaries from Rec. 709 to
//               Rec. 2020 by ITU-R BT.2087-0; PQ and ICtCp by ITU-R BT.2100-2, Tables 4 and 7.
// Formula:      720 sqrt(dI^2 + dT^2 + dP^2), T = Ct / 2, P = Cp, per pixel; mean and max over all
//               pixels, p95 by nearest rank.
// Input:        DisplayLight (linear, clipped). White is 203 cd/m2, the reference white of ITU-R BT.2408
//               for pictures of ordinary range in a PQ signal; black is 0 cd/m2. A figure therefore does
//               not depend on the display.
// Agrees with:  the nine pairs in the tests of the package colour-science (delta_E_ITP), to 4e-8, the
//               limit of their ten digits. From light to difference: the formulas in 50 decimal digits,
//               to 2e-11.
// Differs:      the light of a pixel and its difference are rounded to float32, as in ciede2000.cpp.
#include "compare/metrics/delta_e_itp.hpp"

#include "compare/metrics/metric.hpp"

// As in renderer/kernels/kernels.cpp: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/metrics/delta_e_itp.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "compare/metrics/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

/// BT.2408, section 2.1: HDR reference white.
constexpr double kWhite = 203;
/// BT.2124, Annex 1: scales a just noticeable difference to 1.
constexpr double kScale = 720;

// BT.2100-2, Table 4.
constexpr double kPeakLuminance = 10000;
constexpr double kM1 = 2610.0 / 16384, kM2 = 2523.0 / 4096 * 128;
constexpr double kC1 = 3424.0 / 4096, kC2 = 2413.0 / 4096 * 32, kC3 = 2392.0 / 4096 * 32;
static_assert(kC1 == kC3 - kC2 + 1);

template <class D>
struct ItpLanes {
  LanesOf<D> i, t, p;
};

template <class Real>
HWY_INLINE Real pq_signal(Real luminance) {
  const Real y = pow(luminance / kPeakLuminance, kM1);
  return pow((kC1 + kC2 * y) / (1 + kC3 * y), kM2);
}

template <class D>
HWY_INLINE ItpLanes<D> itp_from_display(const RgbLanes<D>& shown) {
  using Real = LanesOf<D>;
  // BT.2087-0, annex, M2.
  const Real r = kWhite * (0.6274 * shown.r + 0.3293 * shown.g + 0.0433 * shown.b);
  const Real g = kWhite * (0.0691 * shown.r + 0.9195 * shown.g + 0.0114 * shown.b);
  const Real b = kWhite * (0.0164 * shown.r + 0.0880 * shown.g + 0.8956 * shown.b);
  // BT.2100-2, Table 7.
  const Real l = pq_signal((1688 * r + 2146 * g + 262 * b) / 4096);
  const Real m = pq_signal((683 * r + 2951 * g + 462 * b) / 4096);
  const Real s = pq_signal((99 * r + 309 * g + 3688 * b) / 4096);
  const Real ct = (6610 * l - 13613 * m + 7003 * s) / 4096;
  const Real cp = (17933 * l - 17390 * m - 543 * s) / 4096;
  return {(l + m) / 2, ct / 2, cp};
}

template <class D>
HWY_INLINE LanesOf<D> delta_e_itp(const ItpLanes<D>& a, const ItpLanes<D>& b) {
  using Real = LanesOf<D>;
  const Real i = a.i - b.i, t = a.t - b.t, p = a.p - b.p;
  return kScale * sqrt(i * i + t * t + p * p);
}

}  // namespace

void delta_e_itp_lanes(const float* rgb_a, const float* rgb_b, float* out, std::size_t count) {
  for_all_pixels(count, [&](auto d, std::size_t i) HWY_ATTR {
    store(delta_e_itp(itp_from_display(load_rgb(d, rgb_a + 3 * i)),
                      itp_from_display(load_rgb(d, rgb_b + 3 * i))),
          out + i);
  });
}

Itp itp_of_one(Rgb shown) {
  using Real = LanesOf<Single>;
  const auto itp = itp_from_display<Single>({Real(shown.r), Real(shown.g), Real(shown.b)});
  return {hn::GetLane(itp.i.v), hn::GetLane(itp.t.v), hn::GetLane(itp.p.v)};
}

double delta_e_itp_of_one(Itp a, Itp b) {
  using Real = LanesOf<Single>;
  return hn::GetLane(
      delta_e_itp<Single>({Real(a.i), Real(a.t), Real(a.p)}, {Real(b.i), Real(b.t), Real(b.p)}).v);
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {
namespace {

constexpr MetricOutput kOutputs[] = {
    {"delta_e_itp.mean", "Delta E ITP, mean", Unit::kPlain, Better::kLower, true,
     "delta E ITP colour difference, mean",
     "Colour difference on a display of high dynamic range, white at 203 cd/m²; 1 is just noticeable at best."},
    {"delta_e_itp.p95", "Delta E ITP, 95th percentile", Unit::kPlain, Better::kLower, true,
     "95 % of the pixels do not exceed this", "95 of 100 pixels differ by no more than this."},
    {"delta_e_itp.max", "Delta E ITP, largest", Unit::kPlain, Better::kLower, true,
     "the largest of all pixels", "The pixel whose colour differs most."}};

HWY_EXPORT(delta_e_itp_lanes);
HWY_EXPORT(itp_of_one);
HWY_EXPORT(delta_e_itp_of_one);

void measure(const MetricInput& input, std::span<double> values) {
  delta_e_itp_of_pixels(input.shown_a, input.shown_b, input.region).write_figures({0.95}, values);
}

}  // namespace

Itp itp_from_display(Rgb shown) { return HWY_DYNAMIC_DISPATCH(itp_of_one)(shown); }

double delta_e_itp(Itp a, Itp b) { return HWY_DYNAMIC_DISPATCH(delta_e_itp_of_one)(a, b); }

PixelDifferences delta_e_itp_of_pixels(const DisplayLight& a, const DisplayLight& b,
                                       std::span<const std::uint8_t> region) {
  return pixel_differences(a, b, HWY_DYNAMIC_DISPATCH(delta_e_itp_lanes), region);
}

extern constinit const Metric delta_e_itp_metric{kOutputs, Family::kColour, Needs::kNothing,
                                                 "ITU-R BT.2124-0", measure};

}  // namespace lobelia
#endif  // HWY_ONCE
