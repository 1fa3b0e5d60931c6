// The figures that describe a highlight: its energy, brightness and width against the reference, and its shift.
//
// Source:       ours.
// Formula:      of each picture L = max(0, M - kHighlightShare * P) over the pixels of the highlight; M is (R + G + B) / 3,
//               P the largest of min(M, median of M over the 3 x 3 pixels around). What is less bright does not count, so
//               that a shift moves nothing out of the sums. The median keeps noise and a firefly from raising P.
//               energy = sum L. area = (sum L)^2 / sum L^2, the area of a flat disc with the same two sums: of
//               cos^n it is in proportion to 1 / n. brightness = sum L^2 / sum L, so energy = area * brightness.
//               Each is given as a / b - 1, width as the root of the ratio of areas. shift is the distance of the
//               centroids (sum L x / sum L).
// Input:        scene-linear values, neither exposed nor clipped.
// Why:          they average over the highlight. So they find a shift of a tenth of a pixel or a change of a part in
//               a thousand, which no single pixel shows, and rounding and noise hardly move them.
// Degenerate:   a highlight that only one picture has: its ratio is -1 or infinite, its shift infinite.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/system/scratch_memory.hpp"
#include "base/words/constants.hpp"
#include "compare/highlight_region.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kOutputs[] = {
    {"energy.highlight", "Energy of the highlight", Unit::kShare, Better::kNearZero, false,
     "sum of what exceeds 5 % of the peak, a / b - 1",
     "How much more light the highlight has in all.", 0, false, kRatioRange},
    {"brightness.highlight", "Brightness of the highlight", Unit::kShare, Better::kNearZero, false,
     "the same: sum of squares over sum, a / b - 1", "How much brighter the highlight is.", 0,
     false, kRatioRange},
    {"width.highlight", "Width of the highlight", Unit::kShare, Better::kNearZero, false,
     "the same: root of squared sum over sum of squares, a / b - 1",
     "How much wider the highlight is.", 0, false, kRatioRange},
    {"shift.highlight", "Shift of the highlight", Unit::kPlain, Better::kLower, true,
     "distance of the centroids of the same, in pixels",
     "How far away the highlight is, in pixels."},
    {"shift.highlight.x", "", Unit::kPlain, Better::kNeither, false, "to the right, in pixels"},
    {"shift.highlight.y", "", Unit::kPlain, Better::kNeither, false, "down, in pixels"}};

struct Sums {
  double peak = 0, light = 0, squares = 0, x = 0, y = 0;

  double area() const { return squares > 0 ? light * light / squares : 0; }
  double brightness() const { return light > 0 ? squares / light : 0; }
};

double mean_of(std::span<const float, 3> rgb) {
  return (double(rgb[0]) + double(rgb[1]) + double(rgb[2])) / 3;
}

/// The median of the means of the pixels around, those in the picture.
double median_around(const Image& image, int x, int y) {
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

double excess(double a, double b) { return a == b ? 0 : b > 0 ? a / b - 1 : kInfinity; }

/// By kOutputs.
std::array<double, 6> highlight_figures(const Sums& a, const Sums& b) {
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

Sums sums_over(const Image& image, std::span<const std::uint8_t> highlight) {
  return sums_of(image, [&](const auto& visit) {
    const auto width = std::size_t(image.width());
    in_parts(highlight.size(), 3 * sizeof(float), [&](std::size_t begin, std::size_t end) {
      for (std::size_t pixel = begin; pixel < end; ++pixel)
        if (highlight[pixel] != 0) visit(int(pixel % width), int(pixel / width));
    });
  });
}

void measure(const MetricInput& input, std::span<double> values) {
  std::ranges::copy(
      highlight_figures(sums_over(input.a, input.highlight), sums_over(input.b, input.highlight)),
      values.begin());
}

}  // namespace

extern constinit const Metric highlight_metric{
    kOutputs, Family::kRadiance, Needs::kHighlight, "ours", measure, {}, false};

}  // namespace lobelia
