// FLIP, and whether the highlight of a picture is right, for two pictures as float arrays. Copy this file; it needs C++17 and nothing
// else.
//
//   using namespace lobelia::flip_highlight;
//   const Image mine(width, height, rgb), reference(width, height, other);   // linear R, G, B by row from the top; finite
//   const std::vector<float> errors = flip(mine, reference);                 // 0 to 1 in each pixel
//   const Verdict verdict = compare(mine, reference);
//   for (const Judged& one : verdict.limits) printf("%s: %g, limit %g\n", one.metric, one.value, one.limit);
//   return verdict.pass ? 0 : 1;
//
// Promised, and tested against the library: each pixel's FLIP to 2e-6; the figures of compare() to 1e-9, so that its limits give the
// verdict that `lobelia compare` gives by the same limits, for pictures without noise. The lobelia program has more limits: it also
// judges each highlight by itself, colours, and FLIP at exposures that suit the pair. A highlight beside a brighter one needs that.
//
// One thread, some 150 bytes a pixel. FLIP is P. Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images".
// Made by `make headers` from Lobelia's metrics: edit those. Copyright (c) The Lobelia authors. SPDX-License-Identifier: MIT
// clang-format off
#ifndef LOBELIA_FLIP_HIGHLIGHT_HPP
#define LOBELIA_FLIP_HIGHLIGHT_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace lobelia {
namespace flip_highlight {

/// Refers to values that must outlive it: 3 floats a pixel.
class Image {
 public:
  Image(int width, int height, const float* rgb) : width_(width), height_(height), rgb_(rgb) {}
  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t pixel_count() const { return std::size_t(width_) * std::size_t(height_); }
  const float* pixel(int x, int y) const { return rgb_ + 3 * (std::size_t(y) * std::size_t(width_) + std::size_t(x)); }
  const float* values() const { return rgb_; }

 private:
  int width_, height_;
  const float* rgb_;
};

inline void require_same_size(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height() || a.width() < 1 || a.height() < 1)
    throw std::invalid_argument("the pictures must have one size, and a pixel");
}

// ---- FLIP

/// FLIP's standard viewer: a display 0.7 m wide with 3840 pixels, seen from 0.7 m.
inline constexpr double kDefaultPixelsPerDegree = 3840 * 3.14159265358979323846 / 180;

/// The middle tap of a filter, then those on one side of it. The other side mirrors them; of `edge` it has the other sign.
using FlipTaps = std::vector<double>;

/// Separable filters for one viewing distance.
struct FlipFilters {
  explicit FlipFilters(double pixels_per_degree);

  int contrast_radius, feature_radius;  ///< as defined; taps that are almost 0 are left out, or 0
  /// Contrast sensitivity: achromatic, red-green, and blue-yellow as a sum of two Gaussians, each applied in both
  /// directions.
  FlipTaps luminance, red_green, blue_yellow_1, blue_yellow_2;
  /// Feature detection: a Gaussian across and its first (edge) or second (point) derivative along.
  FlipTaps gaussian, edge, point;

  int radius() const { return std::max(contrast_radius, feature_radius); }
};

inline constexpr double kPi = 3.14159265358979323846, kPiSquared = kPi * kPi;
// Section 4.1.1, Table 1: the contrast sensitivity functions as Gaussians a sqrt(pi/b) exp(-pi^2 x^2 / b), x in
// degrees. Blue-yellow is the sum of two. The others are normalised, which cancels their a.
inline constexpr double kLuminanceB = 0.0047;

inline constexpr double kRedGreenB = 0.0053;
inline constexpr double kBlueYellowA1 = 34.1, kBlueYellowB1 = 0.04;
inline constexpr double kBlueYellowA2 = 13.5, kBlueYellowB2 = 0.025;
inline constexpr double kWidestB = kBlueYellowB1;
// Section 4.2.1: width in degrees of features that attract the eye.
inline constexpr double kFeatureWidth = 0.082;

// Both kinds of filter end three standard deviations out.
inline constexpr double kFilterSigmas = 3;

// The narrow Gaussians reach to seven and more of theirs. Taps below this share of the largest are left out: they
// move an error by less than 1e-7, also where it is the power of almost nothing.
inline constexpr double kLeastTap = 1e-12;

/// The sum of a whole filter.
inline double sum_of(const FlipTaps& taps) {
  double sum = -taps[0];
  for (const double tap : taps) sum += 2 * tap;
  return sum;
}

inline void scale(FlipTaps& taps, double factor) {
  for (double& tap : taps) tap *= factor;
}

/// Positive taps sum to 1 and negative ones to -1: a flat picture has no features. `middle` counts the middle tap,
/// the others stand for two of the filter.
inline void balance_even(FlipTaps& taps) {
  double positive = 0, negative = 0;
  for (std::size_t k = 0; k < taps.size(); ++k)
    (taps[k] > 0 ? positive : negative) += (k == 0 ? 1 : 2) * std::abs(taps[k]);
  for (double& tap : taps) tap /= tap > 0 ? positive : negative;
}

inline void drop_small(FlipTaps& taps) {
  while (taps.size() > 1 && taps.back() < kLeastTap * taps.front()) taps.pop_back();
}

inline FlipFilters::FlipFilters(double pixels_per_degree) {
  contrast_radius =
      int(std::ceil(kFilterSigmas * std::sqrt(kWidestB / (2 * kPiSquared)) * pixels_per_degree));
  for (int i = 0; i <= contrast_radius; ++i) {
    const double x = i / pixels_per_degree;
    const auto gaussian_of = [x](double b) { return std::exp(-kPiSquared * x * x / b); };
    // With the root of the amplitude: a plane is multiplied by it once in each direction.
    const auto root = [](double a, double b) { return std::sqrt(a * std::sqrt(kPi / b)); };
    luminance.push_back(gaussian_of(kLuminanceB));
    red_green.push_back(gaussian_of(kRedGreenB));
    blue_yellow_1.push_back(root(kBlueYellowA1, kBlueYellowB1) * gaussian_of(kBlueYellowB1));
    blue_yellow_2.push_back(root(kBlueYellowA2, kBlueYellowB2) * gaussian_of(kBlueYellowB2));
  }
  scale(luminance, 1 / sum_of(luminance));
  scale(red_green, 1 / sum_of(red_green));
  // The two planes are added after both directions; all their taps together must sum to 1.
  const double sum_1 = sum_of(blue_yellow_1), sum_2 = sum_of(blue_yellow_2);
  const double norm = 1 / std::sqrt(sum_1 * sum_1 + sum_2 * sum_2);
  scale(blue_yellow_1, norm);
  scale(blue_yellow_2, norm);
  drop_small(luminance);
  drop_small(red_green);

  const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
  feature_radius = int(std::ceil(kFilterSigmas * sigma));
  for (int i = 0; i <= feature_radius; ++i) {
    const double x = i, g = std::exp(-(x * x) / (2 * sigma * sigma));
    gaussian.push_back(g);
    edge.push_back(x * g);
    point.push_back((x * x / (sigma * sigma) - 1) * g);
  }
  scale(gaussian, 1 / sum_of(gaussian));
  // Its taps on one side are the positive ones.
  scale(edge, 2 / sum_of(edge));
  balance_even(point);
  // As many as those of features, which are never fewer: one loop along a row adds all that filters y.
  luminance.resize(edge.size());
}

// The tool's matrix to XYZ, relative to white, which is the sum of each row. x - y and y - z of a pixel are sums of
// products with r - g and b - g, so that they are 0 for a grey.
inline constexpr double kRedY = 2613072.0 / 12288897, kBlueY = 887015.0 / 12288897;

inline constexpr double kRedCx = 10135552.0 / 23359437 - kRedY, kBlueCx = 4435075.0 / 23359437 - kBlueY;
inline constexpr double kRedCz = kRedY - 1425312.0 / 80288307, kBlueCz = kBlueY - 70074185.0 / 80288307;
inline constexpr double kDeterminant = kRedCx * kBlueCz - kBlueCx * kRedCz;
// No two colours of a display are farther apart than its green and its blue: their HyAB distance. Distances to the power
// of 0.7 above 0.4 of the largest are compressed into errors above 0.95 (section 4.1.4). kKnee = kLargest * 0.4^(1/0.7).
inline constexpr double kLargest = 203.301654610878, kKnee = kLargest * 0.270093587460062;

inline constexpr float kPower = 0.7f, kKneeShare = 0.4f, kKneeError = 0.95f, kLogKneeError = -0.074000581f;

/// One number a pixel.
struct Plane {
  int width, height;
  std::vector<double> values;

  Plane(int w, int h) : width(w), height(h), values(std::size_t(w) * std::size_t(h)) {}
  double& at(int x, int y) { return values[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  double at(int x, int y) const { return values[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

/// Filters along rows, or down columns. Pixels of the border repeat beyond it. `sign` is -1 for an odd filter.
inline Plane filtered(const Plane& in, const FlipTaps& taps, bool down, double sign = 1) {
  Plane out(in.width, in.height);
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) {
      double sum = sign > 0 ? taps[0] * in.at(x, y) : 0;
      for (int k = 1; k < int(taps.size()); ++k) {
        const double after = down ? in.at(x, std::min(y + k, in.height - 1)) : in.at(std::min(x + k, in.width - 1), y),
                     before = down ? in.at(x, std::max(y - k, 0)) : in.at(std::max(x - k, 0), y);
        sum += taps[std::size_t(k)] * (after + sign * before);
      }
      out.at(x, y) = sum;
    }
  return out;
}

/// Colours after the eye's contrast filter as YCxCz, unscaled, and first and second derivatives of Y.
struct Seen {
  Plane y, cx, cz, dx, dy, ddx, ddy;

  Seen(const Image& image, double exposure_stops, const FlipFilters& filters)
      : Seen(Plane(image.width(), image.height()), image, std::exp2(exposure_stops), filters) {}

 private:
  Seen(const Plane& black, const Image& image, double gain, const FlipFilters& filters)
      : y(black), cx(black), cz(black), dx(black), dy(black), ddx(black), ddy(black) {
    for (std::size_t i = 0; i < image.pixel_count(); ++i) {
      const auto shown = [&](std::size_t c) {
        return double(float(std::min(std::max(gain * double(image.values()[3 * i + c]), 0.0), 1.0)));
      };
      const double green = shown(1), red = shown(0) - green, blue = shown(2) - green;
      y.values[i] = green + kRedY * red + kBlueY * blue;
      cx.values[i] = kRedCx * red + kBlueCx * blue;
      cz.values[i] = kRedCz * red + kBlueCz * blue;
    }
    const Plane smooth = filtered(y, filters.gaussian, false);
    dx = filtered(filtered(y, filters.edge, false, -1), filters.gaussian, true);
    dy = filtered(smooth, filters.edge, true, -1);
    ddx = filtered(filtered(y, filters.point, false), filters.gaussian, true);
    ddy = filtered(smooth, filters.point, true);
    const auto both = [](const Plane& in, const FlipTaps& taps) { return filtered(filtered(in, taps, false), taps, true); };
    y = both(y, filters.luminance);
    cx = both(cx, filters.red_green);
    const Plane narrow = both(cz, filters.blue_yellow_2);
    cz = both(cz, filters.blue_yellow_1);
    for (std::size_t i = 0; i < cz.values.size(); ++i) cz.values[i] += narrow.values[i];
  }
};

/// L, a and b with less chroma in the dark, the Hunt effect, of what a display can show.
inline std::array<double, 3> hunt_lab(double y, double cx, double cz) {
  const double red = (kBlueCz * cx - kBlueCx * cz) / kDeterminant, blue = (kRedCx * cz - kRedCz * cx) / kDeterminant,
               green = y - kRedY * red - kBlueY * blue;
  const auto clipped = [](double v) { return std::min(std::max(v, 0.0), 1.0); };
  const double g = clipped(green), r = clipped(green + red) - g, b = clipped(green + blue) - g;
  const auto curve = [](double t) {
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
  };
  const double light = g + kRedY * r + kBlueY * b, fy = curve(light), fx = curve(light + kRedCx * r + kBlueCx * b),
               fz = curve(light - kRedCz * r - kBlueCz * b), l = 116 * fy - 16;
  return {l, 0.01 * l * 500 * (fx - fy), 0.01 * l * 200 * (fy - fz)};
}

/// LDR-FLIP's error of each pixel, in [0, 1], of pictures that a display shows at this exposure and clips.
inline std::vector<float> flip(const Image& a, const Image& b, double exposure_stops = 0,
                               double pixels_per_degree = kDefaultPixelsPerDegree) {
  require_same_size(a, b);
  const FlipFilters filters(pixels_per_degree);
  const Seen in_a(a, exposure_stops, filters), in_b(b, exposure_stops, filters);
  std::vector<float> errors(a.pixel_count());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const auto lab = [i](const Seen& seen) { return hunt_lab(seen.y.values[i], seen.cx.values[i], seen.cz.values[i]); };
    const std::array<double, 3> lab_a = lab(in_a), lab_b = lab(in_b);
    const double distance = std::abs(lab_a[0] - lab_b[0]) + std::hypot(lab_a[1] - lab_b[1], lab_a[2] - lab_b[2]);
    // Distances up to the knee are the errors up to kKneeError, and the rest is compressed.
    const double power = std::pow(distance / kKnee, double(kPower));
    const double colour = power < 1 ? double(kKneeError) * power
                                    : double(kKneeError) + (1 - double(kKneeError)) * double(kKneeShare) *
                                                               (power - 1) / (1 - double(kKneeShare));
    const auto rise = [i](const Plane& ax, const Plane& ay, const Plane& bx, const Plane& by) {
      return std::abs(std::hypot(ax.values[i], ay.values[i]) - std::hypot(bx.values[i], by.values[i]));
    };
    const double feature = std::sqrt(std::sqrt(0.5) * std::max(rise(in_a.dx, in_a.dy, in_b.dx, in_b.dy),
                                                               rise(in_a.ddx, in_a.ddy, in_b.ddx, in_b.ddy)));
    errors[i] = float(std::min(std::pow(colour, std::max(1 - feature, 1e-6)), 1.0));
  }
  return errors;
}

// ---- the highlight: the pixels with 5 % of the brightest value of either picture

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A pixel is in the highlight if a value of it is at least this share of its picture's brightest value.
inline constexpr double kHighlightShare = 0.05;

struct Sums {
  double peak = 0, light = 0, squares = 0, x = 0, y = 0;

  double area() const { return squares > 0 ? light * light / squares : 0; }
  double brightness() const { return light > 0 ? squares / light : 0; }
};

inline double mean_of(const float* rgb) {
  return (double(rgb[0]) + double(rgb[1]) + double(rgb[2])) / 3;
}

/// The median of the means of the pixels around, those in the picture.
inline double median_around(const Image& image, int x, int y) {
  std::array<double, 9> values{};
  std::size_t count = 0;
  for (int j = std::max(0, y - 1); j <= std::min(image.height() - 1, y + 1); ++j)
    for (int i = std::max(0, x - 1); i <= std::min(image.width() - 1, x + 1); ++i)
      values[count++] = mean_of(image.pixel(i, j));
  const auto middle = values.begin() + std::ptrdiff_t(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + std::ptrdiff_t(count));
  return *middle;
}

/// for_each_pixel(visit) visits the pixels of the highlight.
template <class ForEachPixel>
Sums sums_of(const Image& image, const ForEachPixel& for_each_pixel) {
  Sums sums;
  for_each_pixel([&](int x, int y) {
    const double own = mean_of(image.pixel(x, y));
    if (own > sums.peak) sums.peak = std::max(sums.peak, std::min(own, median_around(image, x, y)));
  });
  for_each_pixel([&](int x, int y) {
    const double light = mean_of(image.pixel(x, y)) - kHighlightShare * sums.peak;
    if (!(light > 0)) return;
    sums.light += light;
    sums.squares += light * light;
    sums.x += light * x;
    sums.y += light * y;
  });
  return sums;
}

inline double excess(double a, double b) { return a == b ? 0 : b > 0 ? a / b - 1 : kInfinity; }
/// By kOutputs.
inline std::array<double, 6> highlight_figures(const Sums& a, const Sums& b) {
  std::array<double, 6> values{};
  values[0] = excess(a.light, b.light);
  values[1] = excess(a.brightness(), b.brightness());
  values[2] = excess(std::sqrt(a.area()), std::sqrt(b.area()));
  if (a.light > 0 && b.light > 0) {
    values[4] = a.x / a.light - b.x / b.light;
    values[5] = a.y / a.light - b.y / b.light;
  } else if (a.light != b.light) {
    values[4] = values[5] = kInfinity;
  }
  values[3] = std::hypot(values[4], values[5]);
  return values;
}

struct Judged {
  const char* metric;  ///< as `lobelia compare` names it, which docs/metrics.md explains
  double value, limit;
  bool pass;  ///< the value's size is within the limit
};

/// A highlight, of what exceeds 5 % of its peak. Without light its place is NaN.
struct Measured {
  double peak;    ///< of the mean of R, G and B, without single bright pixels
  double energy;  ///< sum over pixels
  double width;   ///< pixels: root of the area of a flat disc with the same sums
  double x, y;    ///< pixels; the middle of the first is (0, 0)
};

struct Verdict {
  bool pass;
  std::array<Judged, 4> limits;
  Measured a, b;
};

/// Judges `a` by the reference `b`. A value that is not finite does not pass.
inline Verdict compare(const Image& a, const Image& b) {
  require_same_size(a, b);
  double peak_a = 0, peak_b = 0, largest = 0;
  bool finite = true;
  for (std::size_t i = 0; i < 3 * a.pixel_count(); ++i) {
    const double in_a = double(a.values()[i]), in_b = double(b.values()[i]);
    finite = finite && std::isfinite(in_a) && std::isfinite(in_b);
    peak_a = std::max(peak_a, in_a);
    peak_b = std::max(peak_b, in_b);
    largest = std::max(largest, std::abs(in_a - in_b));
  }
  const auto is_bright = [](const float* rgb, double peak) {
    return peak > 0 && double(std::max({rgb[0], rgb[1], rgb[2]})) >= kHighlightShare * peak;
  };
  const auto for_each_pixel = [&](const auto& visit) {
    for (int y = 0; finite && y < a.height(); ++y)
      for (int x = 0; x < a.width(); ++x)
        if (is_bright(a.pixel(x, y), peak_a) || is_bright(b.pixel(x, y), peak_b)) visit(x, y);
  };
  const Sums in_a = sums_of(a, for_each_pixel), in_b = sums_of(b, for_each_pixel);
  const std::array<double, 6> figures = highlight_figures(in_a, in_b);
  const auto measured = [](const Sums& in) {
    return Measured{in.peak, in.light, std::sqrt(in.area()), in.x / in.light, in.y / in.light};
  };
  Verdict verdict{finite,
                  {{{"energy.highlight", figures[0], 0.01, true},
                    {"width.highlight", figures[2], 0.01, true},
                    {"shift.highlight", figures[3], 0.25, true},
                    {"max_rel_peak", largest == 0 ? 0 : peak_b > 0 ? largest / peak_b : kInfinity, 0.01, true}}},
                  measured(in_a),
                  measured(in_b)};
  for (Judged& one : verdict.limits) {
    one.pass = finite && std::abs(one.value) <= one.limit;
    verdict.pass = verdict.pass && one.pass;
  }
  return verdict;
}

}  // namespace flip_highlight
}  // namespace lobelia

#endif  // LOBELIA_FLIP_HIGHLIGHT_HPP
