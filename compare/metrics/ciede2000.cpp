// CIEDE2000: how far apart two colours look, in units of about one just noticeable difference.
//
// Source:       G. Sharma, W. Wu, E. N. Dalal, "The CIEDE2000 color-difference formula:
//               implementation notes, supplementary test data, and mathematical observations",
//               Color Research and Application 30 (2005) 21-30; equation numbers below are theirs.
// Formula:      per pixel between a and b; k_L = k_C = k_H = 1. mean and max over all pixels; p50,
//               p95 and p99 are the smallest value that at least so many per cent of the pixels do
//               not exceed (nearest rank, no interpolation).
// Input:        DisplayLight (linear, clipped). To XYZ by the matrix of IEC 61966-2-1 (sRGB), whose
//               rows add up to the standard's D65 white (0.9505, 1, 1.0890): that white is used for
//               Lab, so that a grey is exactly neutral.
// Agrees with:  the 34 pairs of Sharma's Table 1, to the four digits printed there, in both orders.
// The tie:      hues exactly 180 degrees apart have two mean hues, and with them two values. Pair 14
//               is such a pair in decimal numbers (4.8045 or 4.7461). Eq. (10) and (14) take the
//               plain mean of the angles wherever they differ by no more than 180, and so do we: it
//               is 4.8045, as printed. In binary the angles come out within 1e-13 of it on either
//               side, so a difference of up to kTieDegrees over 180 counts as 180.
// Differs:      a pixel with equal light on both sides is 0 without computing it.
#include "compare/metrics/ciede2000.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "compare/metrics/metric.hpp"
#include "compare/metrics/percentile.hpp"
#include "compare/metrics/pixel_differences.hpp"

namespace lobelia {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
/// A hue difference of so little over 180 is a tie that rounding has decided: the angles are sums of
/// a few roundings of numbers up to 360.
constexpr double kTieDegrees = 1e-10;

constexpr MetricOutput kOutputs[] = {
    {"ciede2000.mean", Better::kLower, true, "CIEDE2000 colour difference, mean"},
    {"ciede2000.p50", Better::kLower, true, "half of the pixels do not exceed this"},
    {"ciede2000.p95", Better::kLower, true, "95 % of the pixels do not exceed this"},
    {"ciede2000.p99", Better::kLower, true, "99 % of the pixels do not exceed this"},
    {"ciede2000.max", Better::kLower, true, "the largest of all pixels"}};

double squared(double x) { return x * x; }

/// C^7 / (C^7 + 25^7), in eq. (4) and (15).
double chroma_saturation(double chroma) {
  const double c7 = std::pow(chroma, 7);
  constexpr double k25To7 = 6103515625.0;
  return c7 / (c7 + k25To7);
}

/// Hue angle in degrees, [0, 360); 0 for a neutral colour, eq. (7).
double hue(double a, double b) {
  if (a == 0 && b == 0) return 0;
  const double h = std::atan2(b, a) / kDegree;
  return h < 0 ? h + 360 : h;
}

void measure(const MetricInput& input, std::span<double> values) {
  std::vector<double> differences = pixel_differences(
      input, [](Rgb a, Rgb b) { return ciede2000(lab_from_display(a), lab_from_display(b)); });
  if (differences.empty()) {
    std::fill(values.begin(), values.end(), 0.0);
    return;
  }
  values[0] = mean(differences);
  values[1] = percentile(differences, 0.50);
  values[2] = percentile(differences, 0.95);
  values[3] = percentile(differences, 0.99);
  values[4] = maximum(differences);
}

}  // namespace

Lab lab_from_display(Rgb shown) {
  const double x = 0.4124 * shown.r + 0.3576 * shown.g + 0.1805 * shown.b;
  const double y = 0.2126 * shown.r + 0.7152 * shown.g + 0.0722 * shown.b;
  const double z = 0.0193 * shown.r + 0.1192 * shown.g + 0.9505 * shown.b;
  return lab_from_relative_xyz(x / 0.9505, y, z / 1.0890);
}

double ciede2000(Lab a, Lab b) {
  // (2)-(7): chroma and hue with the a axis stretched for colours near neutral.
  const double mean_chroma_ab = (std::hypot(a.a, a.b) + std::hypot(b.a, b.b)) / 2;
  const double stretch = 1.5 - 0.5 * std::sqrt(chroma_saturation(mean_chroma_ab));
  const double a1 = stretch * a.a, a2 = stretch * b.a;
  const double c1 = std::hypot(a1, a.b), c2 = std::hypot(a2, b.b);
  const double h1 = hue(a1, a.b), h2 = hue(a2, b.b);
  const bool neutral = c1 * c2 == 0;

  // (8)-(11): the hue difference the short way round.
  double hue_step = neutral ? 0 : h2 - h1;
  if (hue_step > 180 + kTieDegrees) hue_step -= 360;
  if (hue_step < -180 - kTieDegrees) hue_step += 360;
  const double dl = b.l - a.l, dc = c2 - c1;
  const double dh = 2 * std::sqrt(c1 * c2) * std::sin(hue_step / 2 * kDegree);

  // (12)-(14): the mean hue likewise.
  const double mean_l = (a.l + b.l) / 2, mean_c = (c1 + c2) / 2;
  double mean_h = h1 + h2;
  if (!neutral) {
    if (std::abs(h1 - h2) > 180 + kTieDegrees) mean_h += mean_h < 360 ? 360 : -360;
    mean_h /= 2;
  }

  // (15)-(21): the weights.
  const double t =
      1 - 0.17 * std::cos((mean_h - 30) * kDegree) + 0.24 * std::cos(2 * mean_h * kDegree) +
      0.32 * std::cos((3 * mean_h + 6) * kDegree) - 0.20 * std::cos((4 * mean_h - 63) * kDegree);
  const double rotation = 30 * std::exp(-squared((mean_h - 275) / 25));
  const double rc = 2 * std::sqrt(chroma_saturation(mean_c));
  const double lightness = squared(mean_l - 50);
  const double sl = 1 + 0.015 * lightness / std::sqrt(20 + lightness);
  const double sc = 1 + 0.045 * mean_c;
  const double sh = 1 + 0.015 * mean_c * t;
  const double rt = -std::sin(2 * rotation * kDegree) * rc;

  // (22). The rotation term can make the sum negative by rounding alone.
  const double sum =
      squared(dl / sl) + squared(dc / sc) + squared(dh / sh) + rt * (dc / sc) * (dh / sh);
  return std::sqrt(std::max(sum, 0.0));
}

extern const Metric ciede2000_metric;
constinit const Metric ciede2000_metric{kOutputs, Family::kColour, Needs::kNothing,
                                        "Sharma, Wu, Dalal 2005", measure};

}  // namespace lobelia
