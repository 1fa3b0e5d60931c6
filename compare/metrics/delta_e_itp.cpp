// Delta E ITP: how far apart two colours look on a display of high dynamic range; 1 is just
// noticeable to an eye that is adapted to see it best.
//
// Source:       Recommendation ITU-R BT.2124-0 (2019), Annex 1. Its parts: primaries from Rec. 709 to
//               Rec. 2020 by ITU-R BT.2087-0; PQ and ICtCp by ITU-R BT.2100-2, Tables 4 and 7.
// Formula:      720 sqrt(dI^2 + dT^2 + dP^2), T = Ct / 2, P = Cp, per pixel; mean and max over all
//               pixels, p95 by nearest rank.
// Input:        DisplayLight (linear, clipped). Its white is put at 203 cd/m2, the reference white of
//               ITU-R BT.2408 for pictures of ordinary range in a PQ signal, so that a figure does
//               not depend on the display; black is 0 cd/m2.
// Agrees with:  the nine pairs in the tests of the package colour-science (delta_E_ITP), to 4e-8,
//               what their ten digits allow; and the whole way from light to difference with
//               the formulas in 50 decimal digits, to 2e-11.
#include "compare/metrics/delta_e_itp.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "compare/metrics/metric.hpp"
#include "compare/metrics/percentile.hpp"
#include "compare/metrics/pixel_differences.hpp"

namespace lobelia {
namespace {

/// BT.2408, section 2.1: HDR reference white.
constexpr double kWhite = 203;
/// BT.2124, Annex 1: brings a just noticeable difference to 1.
constexpr double kScale = 720;

// BT.2100-2, Table 4.
constexpr double kPeakLuminance = 10000;
constexpr double kM1 = 2610.0 / 16384, kM2 = 2523.0 / 4096 * 128;
constexpr double kC1 = 3424.0 / 4096, kC2 = 2413.0 / 4096 * 32, kC3 = 2392.0 / 4096 * 32;
static_assert(kC1 == kC3 - kC2 + 1);

constexpr MetricOutput kOutputs[] = {
    {"delta_e_itp.mean", Better::kLower, true, "delta E ITP colour difference, mean"},
    {"delta_e_itp.p95", Better::kLower, true, "95 % of the pixels do not exceed this"},
    {"delta_e_itp.max", Better::kLower, true, "the largest of all pixels"}};

void measure(const MetricInput& input, std::span<double> values) {
  std::vector<double> differences = pixel_differences(
      input, [](Rgb a, Rgb b) { return delta_e_itp(itp_from_display(a), itp_from_display(b)); });
  if (differences.empty()) {
    std::fill(values.begin(), values.end(), 0.0);
    return;
  }
  values[0] = mean(differences);
  values[1] = percentile(differences, 0.95);
  values[2] = maximum(differences);
}

}  // namespace

double pq_signal(double luminance) {
  const double y = std::pow(std::max(luminance, 0.0) / kPeakLuminance, kM1);
  return std::pow((kC1 + kC2 * y) / (1 + kC3 * y), kM2);
}

Itp itp_from_display(Rgb shown) {
  // BT.2087-0, annex, M2.
  const double r = kWhite * (0.6274 * shown.r + 0.3293 * shown.g + 0.0433 * shown.b);
  const double g = kWhite * (0.0691 * shown.r + 0.9195 * shown.g + 0.0114 * shown.b);
  const double b = kWhite * (0.0164 * shown.r + 0.0880 * shown.g + 0.8956 * shown.b);
  // BT.2100-2, Table 7.
  const double l = pq_signal((1688 * r + 2146 * g + 262 * b) / 4096);
  const double m = pq_signal((683 * r + 2951 * g + 462 * b) / 4096);
  const double s = pq_signal((99 * r + 309 * g + 3688 * b) / 4096);
  const double ct = (6610 * l - 13613 * m + 7003 * s) / 4096;
  const double cp = (17933 * l - 17390 * m - 543 * s) / 4096;
  return {(l + m) / 2, ct / 2, cp};
}

double delta_e_itp(Itp a, Itp b) {
  const double i = a.i - b.i, t = a.t - b.t, p = a.p - b.p;
  return kScale * std::sqrt(i * i + t * t + p * p);
}

extern const Metric delta_e_itp_metric;
constinit const Metric delta_e_itp_metric{kOutputs, Family::kColour, Needs::kNothing,
                                          "ITU-R BT.2124-0", measure};

}  // namespace lobelia
