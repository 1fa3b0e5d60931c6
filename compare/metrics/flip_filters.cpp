// Source, agreement and why float: see flip_ldr.cpp. Section numbers are those of Andersson et al.;
// the separation into rows and columns is that of the tool's note "separatedConvolutions".
#include "compare/metrics/flip_filters.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "compare/metrics/weighted_sum.hpp"

namespace lobelia {
namespace {

constexpr float kPi = 3.14159265358979f;
constexpr float kPiSquared = kPi * kPi;

// Section 4.1.1, Table 1: the contrast sensitivity functions as Gaussians a sqrt(pi/b) exp(-pi^2
// x^2 / b), x in degrees. Blue-yellow is the sum of two; the others are normalised, their a
// cancels.
constexpr float kLuminanceB = 0.0047f;
constexpr float kRedGreenB = 0.0053f;
constexpr float kBlueYellowA1 = 34.1f, kBlueYellowB1 = 0.04f;
constexpr float kBlueYellowA2 = 13.5f, kBlueYellowB2 = 0.025f;
constexpr float kWidestB = kBlueYellowB1;

// Section 4.2.1: width in degrees of the features that the eye is drawn to.
constexpr float kFeatureWidth = 0.082f;

// Both kinds of filter end three standard deviations out.
constexpr float kFilterSigmas = 3.0f;

float contrast_gaussian(float degrees_squared, float a, float b) {
  return a * std::sqrt(kPi / b) * std::exp(-kPiSquared * degrees_squared / b);
}

/// With the root of the amplitude, because a plane is multiplied by it once in each direction.
float contrast_gaussian_root(float degrees_squared, float a, float b) {
  return std::sqrt(a * std::sqrt(kPi / b)) * std::exp(-kPiSquared * degrees_squared / b);
}

float sum_of(std::span<const float> taps) {
  float sum = 0;
  for (const float tap : taps) sum += tap;
  return sum;
}

void scale(std::vector<float>& taps, float factor) {
  for (float& tap : taps) tap *= factor;
}

/// Positive taps sum to 1 and negative ones to -1: a flat picture has no features.
void balance(std::vector<float>& taps) {
  float positive = 0, negative = 0;
  for (const float tap : taps) (tap > 0 ? positive : negative) += std::abs(tap);
  for (float& tap : taps) tap /= tap > 0 ? positive : negative;
}

/// Where each tap finds its row.
using TapRows = std::vector<const float*>;

/// out[i] = sum over k of taps[k] * in[i + k].
void filter_row(const float* in, const std::vector<float>& taps, std::span<float> out) {
  TapRows rows(taps.size());
  for (std::size_t k = 0; k < rows.size(); ++k) rows[k] = in + k;
  weighted_sum(taps, rows.data(), out);
}

/// Rows of a picture, filtered along them, from the picture's row `first` on.
class Plane {
 public:
  Plane(int width, int first, std::span<float> values)
      : width_(std::size_t(width)), first_(first), values_(values) {}
  std::span<float> row(int y) {
    return {values_.data() + width_ * std::size_t(y - first_), width_};
  }
  /// The same down the columns, for row y of a picture of that height.
  void filter_columns(const std::vector<float>& taps, int y, int height, std::span<float> out) {
    const int radius = int(taps.size() / 2);
    TapRows rows(taps.size());
    for (std::size_t k = 0; k < rows.size(); ++k)
      rows[k] = row(std::clamp(y + int(k) - radius, 0, height - 1)).data();
    weighted_sum(taps, rows.data(), out);
  }

 private:
  std::size_t width_;
  int first_;
  std::span<float> values_;
};

}  // namespace

FlipFilters::FlipFilters(float pixels_per_degree) {
  contrast_radius =
      int(std::ceil(kFilterSigmas * std::sqrt(kWidestB / (2.0f * kPiSquared)) * pixels_per_degree));
  const float step = 1.0f / pixels_per_degree;
  for (int i = -contrast_radius; i <= contrast_radius; ++i) {
    const float x = float(i) * step, x2 = x * x;
    luminance.push_back(contrast_gaussian(x2, 1, kLuminanceB));
    red_green.push_back(contrast_gaussian(x2, 1, kRedGreenB));
    blue_yellow_1.push_back(contrast_gaussian_root(x2, kBlueYellowA1, kBlueYellowB1));
    blue_yellow_2.push_back(contrast_gaussian_root(x2, kBlueYellowA2, kBlueYellowB2));
  }
  scale(luminance, 1.0f / sum_of(luminance));
  scale(red_green, 1.0f / sum_of(red_green));
  // The two planes are added after both directions: the sum of all their taps is to be 1.
  const float sum_1 = sum_of(blue_yellow_1), sum_2 = sum_of(blue_yellow_2);
  const float norm = 1.0f / std::sqrt(sum_1 * sum_1 + sum_2 * sum_2);
  scale(blue_yellow_1, norm);
  scale(blue_yellow_2, norm);

  const float sigma = 0.5f * kFeatureWidth * pixels_per_degree;
  feature_radius = int(std::ceil(kFilterSigmas * sigma));
  for (int i = -feature_radius; i <= feature_radius; ++i) {
    const float x = float(i), g = std::exp(-(x * x) / (2.0f * sigma * sigma));
    gaussian.push_back(g);
    edge.push_back(-x * g);
    point.push_back((x * x / (sigma * sigma) - 1.0f) * g);
  }
  const float sum = sum_of(gaussian);
  for (float& tap : gaussian) tap /= sum;
  balance(edge);
  balance(point);
}

FlipRows flip_filter_rows(const DisplayLight& shown, const FlipFilters& filters, int first_row,
                          int last_row) {
  const int width = shown.width(), height = shown.height();
  const int radius = std::max(filters.contrast_radius, filters.feature_radius);
  const int first = std::max(0, first_row - radius), last = std::min(height, last_row + radius);

  // Kept by the thread: megabytes of fresh pages for each task would cost a fifth of the time.
  thread_local std::vector<float> memory;
  constexpr std::size_t kPlanes = 7;
  const std::size_t plane_size = std::size_t(width) * std::size_t(last - first);
  memory.resize(std::max(memory.size(), kPlanes * plane_size));
  std::size_t planes = 0;
  const auto plane = [&] {
    return Plane(width, first, std::span(memory).subspan(plane_size * planes++, plane_size));
  };
  Plane y = plane(), cx = plane(), cz_1 = plane(), cz_2 = plane();
  Plane smooth = plane(), edge_x = plane(), point_x = plane();
  // A row of the picture, extended by its border pixels, so that no tap needs a test.
  const auto extended = std::size_t(width + 2 * radius);
  std::vector<float> in_y(extended), in_cx(extended), in_cz(extended), in_grey(extended);
  const int contrast = radius - filters.contrast_radius, feature = radius - filters.feature_radius;
  for (int row = first; row < last; ++row) {
    const std::size_t start = std::size_t(row) * std::size_t(width);
    for (std::size_t i = 0; i < extended; ++i) {
      const int x = std::clamp(int(i) - radius, 0, width - 1);
      const FlipColour colour = flip_colour(shown.at(start + std::size_t(x)));
      in_y[i] = colour.y;
      in_cx[i] = colour.cx;
      in_cz[i] = colour.cz;
      in_grey[i] = colour.y * (1.0f / 116.0f) + 16.0f / 116.0f;
    }
    filter_row(in_y.data() + contrast, filters.luminance, y.row(row));
    filter_row(in_cx.data() + contrast, filters.red_green, cx.row(row));
    filter_row(in_cz.data() + contrast, filters.blue_yellow_1, cz_1.row(row));
    filter_row(in_cz.data() + contrast, filters.blue_yellow_2, cz_2.row(row));
    filter_row(in_grey.data() + feature, filters.gaussian, smooth.row(row));
    filter_row(in_grey.data() + feature, filters.edge, edge_x.row(row));
    filter_row(in_grey.data() + feature, filters.point, point_x.row(row));
  }

  FlipRows out;
  const std::size_t size = std::size_t(last_row - first_row) * std::size_t(width);
  out.colour.reserve(size);
  out.edge.reserve(size);
  out.point.reserve(size);
  std::vector<float> sum_y(std::size_t(width), 0.0f), sum_cx(sum_y), sum_cz_1(sum_y),
      sum_cz_2(sum_y), dx(sum_y), dy(sum_y), ddx(sum_y), ddy(sum_y);
  for (int row = first_row; row < last_row; ++row) {
    y.filter_columns(filters.luminance, row, height, sum_y);
    cx.filter_columns(filters.red_green, row, height, sum_cx);
    cz_1.filter_columns(filters.blue_yellow_1, row, height, sum_cz_1);
    cz_2.filter_columns(filters.blue_yellow_2, row, height, sum_cz_2);
    edge_x.filter_columns(filters.gaussian, row, height, dx);
    smooth.filter_columns(filters.edge, row, height, dy);
    point_x.filter_columns(filters.gaussian, row, height, ddx);
    smooth.filter_columns(filters.point, row, height, ddy);
    for (std::size_t i = 0; i < std::size_t(width); ++i) {
      out.colour.push_back({sum_y[i], sum_cx[i], sum_cz_1[i] + sum_cz_2[i]});
      out.edge.push_back(std::sqrt(dx[i] * dx[i] + dy[i] * dy[i]));
      out.point.push_back(std::sqrt(ddx[i] * ddx[i] + ddy[i] * ddy[i]));
    }
  }
  return out;
}

}  // namespace lobelia
