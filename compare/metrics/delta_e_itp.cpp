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
//               to 2e-11. Each pixel of a picture: the formulas by std::pow, to 1e-7 of the difference and 1e-9.
// Differs:      the light of a pixel and its difference are rounded to float32, as in ciede2000.cpp.
#include "compare/metrics/delta_e_itp.hpp"

#include <type_traits>

#include "compare/metrics/shared_work.hpp"

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

/// BT.2408, section 2.1: HDR reference white, as a share of BT.2100-2's peak.
constexpr double kWhite = 203.0 / 10000;
/// BT.2124, Annex 1: scales a just noticeable difference to 1.
constexpr double kScale = 720;

// BT.2100-2, Table 4.
constexpr double kM1 = 2610.0 / 16384, kM2 = 2523.0 / 4096 * 128;
constexpr double kC1 = 3424.0 / 4096, kC2 = 2413.0 / 4096 * 32, kC3 = 2392.0 / 4096 * 32;
static_assert(kC1 == kC3 - kC2 + 1);

// BT.2087-0, annex, M2: from Rec. 709 to Rec. 2020. BT.2100-2, Table 7: from there to cones.
constexpr double kWide[3][3] = {
    {0.6274, 0.3293, 0.0433}, {0.0691, 0.9195, 0.0114}, {0.0164, 0.0880, 0.8956}};
constexpr double kCones[3][3] = {{1688, 2146, 262}, {683, 2951, 462}, {99, 309, 3688}};
/// Both in one, for the light of a cone as a share of BT.2100-2's peak.
constexpr double cone_weight(int cone, int channel) {
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += kCones[cone][i] * kWide[i][channel];
  return sum * kWhite / 4096;
}

template <class D>
struct ItpLanes {
  LanesOf<D> i, t, p;
};

/// ((c1 + c2 y) / (1 + c3 y))^m2 with y = light^m1, for light in [0, 1]. The logarithm of a fraction p / q is
/// -2 artanh((q - p) / (q + p)), here of at most 0.09, of which eight terms are enough.
template <class Real>
HWY_INLINE Real pq_signal(Real light) {
  const Real y = pow(light, kM1);
  const Real s = (1 - kC1) * (1 - y) / (1 + kC1 + (kC2 + kC3) * y), s2 = s * s;
  Real series = 1.0 / 15;
  for (const double term : {13, 11, 9, 7, 5, 3, 1}) series = series * s2 + 1 / term;
  return exp(-2 * kM2 * s * series);
}

template <class D>
HWY_INLINE ItpLanes<D> itp_from_display(const RgbLanes<D>& shown) {
  using Real = LanesOf<D>;
  const auto cone = [&](auto i) HWY_ATTR {
    constexpr double r = cone_weight(i, 0), g = cone_weight(i, 1), b = cone_weight(i, 2);
    return pq_signal<Real>(r * shown.r + g * shown.g + b * shown.b);
  };
  const Real l = cone(std::integral_constant<int, 0>()), m = cone(std::integral_constant<int, 1>()),
             s = cone(std::integral_constant<int, 2>());
  // BT.2100-2, Table 7, and T = Ct / 2.
  constexpr double kOne = 1.0 / 4096;
  return {(l + m) * 0.5, (6610 * l - 13613 * m + 7003 * s) * (0.5 * kOne),
          (17933 * l - 17390 * m - 543 * s) * kOne};
}

template <class D>
HWY_INLINE LanesOf<D> delta_e_itp(const ItpLanes<D>& a, const ItpLanes<D>& b) {
  using Real = LanesOf<D>;
  const Real i = a.i - b.i, t = a.t - b.t, p = a.p - b.p;
  return kScale * sqrt(i * i + t * t + p * p);
}

}  // namespace

void delta_e_itp_lanes(const float* rgb_a, const float* rgb_b, float* out, std::size_t count) {
  store_differences(rgb_a, rgb_b, out, count, [](const auto& a, const auto& b) HWY_ATTR {
    return delta_e_itp(itp_from_display(a), itp_from_display(b));
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
  const auto map = shared(input, "delta_e_itp", [&] {
    return delta_e_itp_of_pixels(input.shown_a, input.shown_b, input.needed());
  });
  write_figures(*map, input, {0.95}, values);
}

}  // namespace

Itp itp_from_display(Rgb shown) { return HWY_DYNAMIC_DISPATCH(itp_of_one)(shown); }

double delta_e_itp(Itp a, Itp b) { return HWY_DYNAMIC_DISPATCH(delta_e_itp_of_one)(a, b); }

PixelValues delta_e_itp_of_pixels(const DisplayLight& a, const DisplayLight& b,
                                  std::span<const std::uint8_t> needed) {
  return pixel_differences(a, b, HWY_DYNAMIC_DISPATCH(delta_e_itp_lanes), needed);
}

extern constinit const Metric delta_e_itp_metric{
    kOutputs, Family::kColour, Needs::kNothing, "ITU-R BT.2124-0", measure, "delta_e_itp"};

}  // namespace lobelia
#endif  // HWY_ONCE
