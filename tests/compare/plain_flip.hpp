// LDR-FLIP as the formulas stand: in double, each pixel's windows one after the other, without separation.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "compare/display_light.hpp"
#include "tests/compare/pictures.hpp"

namespace lobelia::fixtures {

/// The filters of the paper, of 2 * radius + 1 taps.
struct PlainFilters {
  using Taps = std::vector<double>;

  explicit PlainFilters(double pixels_per_degree) {
    const double pi = std::acos(-1.0);
    const int contrast = int(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixels_per_degree));
    for (int i = -contrast; i <= contrast; ++i) {
      const double x = i / pixels_per_degree;
      const auto csf = [&](double a, double b) {
        return std::sqrt(a * std::sqrt(pi / b)) * std::exp(-pi * pi * x * x / b);
      };
      luminance.push_back(csf(1, 0.0047));
      red_green.push_back(csf(1, 0.0053));
      blue_yellow_1.push_back(csf(34.1, 0.04));
      blue_yellow_2.push_back(csf(13.5, 0.025));
    }
    const auto sum = [](const Taps& taps) {
      return std::accumulate(taps.begin(), taps.end(), 0.0);
    };
    const auto divide = [](Taps& taps, double by) {
      for (double& tap : taps) tap /= by;
    };
    divide(luminance, sum(luminance));
    divide(red_green, sum(red_green));
    const double both = std::hypot(sum(blue_yellow_1), sum(blue_yellow_2));
    divide(blue_yellow_1, both);
    divide(blue_yellow_2, both);
    const double sigma = 0.5 * 0.082 * pixels_per_degree;
    const int feature = int(std::ceil(3 * sigma));
    for (int i = -feature; i <= feature; ++i) {
      const double x = i, g = std::exp(-x * x / (2 * sigma * sigma));
      gaussian.push_back(g);
      edge.push_back(-x * g);
      point.push_back((x * x / (sigma * sigma) - 1) * g);
    }
    divide(gaussian, sum(gaussian));
    for (Taps* taps : {&edge, &point}) {
      double above = 0, below = 0;
      for (const double tap : *taps) (tap > 0 ? above : below) += std::abs(tap);
      for (double& tap : *taps) tap /= tap > 0 ? above : below;
    }
  }

  Taps luminance, red_green, blue_yellow_1, blue_yellow_2, gaussian, edge, point;
};

class PlainFlip {
 public:
  PlainFlip(const DisplayLight& shown, const PlainFilters& filters)
      : width_(shown.width()), height_(shown.height()), filters_(filters) {
    for (std::size_t i = 0; i < shown.pixel_count(); ++i) {
      const Rgb xyz = relative_xyz(shown_at(shown, i));
      y_.push_back(116 * xyz.g - 16);
      cx_.push_back(500 * (xyz.r - xyz.g));
      cz_.push_back(200 * (xyz.g - xyz.b));
    }
  }

  /// Of the filtered colour: L, a, b with the Hunt effect.
  Rgb colour(int x, int y) const {
    const double l = window(y_, filters_.luminance, filters_.luminance, x, y);
    const double cx = window(cx_, filters_.red_green, filters_.red_green, x, y);
    const double cz = window(cz_, filters_.blue_yellow_1, filters_.blue_yellow_1, x, y) +
                      window(cz_, filters_.blue_yellow_2, filters_.blue_yellow_2, x, y);
    const double fy = (l + 16) / 116;
    return hunt_lab(clamped_rgb({fy + cx / 500, fy, fy - cz / 200}));
  }
  double edge(int x, int y) const { return feature(filters_.edge, x, y); }
  double point(int x, int y) const { return feature(filters_.point, x, y); }

  static double distance(Rgb a, Rgb b) {
    return std::pow(std::abs(a.r - b.r) + std::hypot(a.g - b.g, a.b - b.b), 0.7);
  }
  static Rgb hunt_lab(Rgb rgb) {
    const auto f = [](double t) {
      return t > 216.0 / 24389 ? std::cbrt(t) : 841.0 / 108 * t + 4.0 / 29;
    };
    const Rgb xyz = relative_xyz(rgb);
    const double fx = f(xyz.r), fy = f(xyz.g), fz = f(xyz.b), l = 116 * fy - 16;
    return {l, 0.01 * l * 500 * (fx - fy), 0.01 * l * 200 * (fy - fz)};
  }

 private:
  // sRGB to XYZ, each row divided by its sum, which is white.
  static constexpr double kMatrix[3][3] = {
      {10135552.0 / 23359437, 8788810.0 / 23359437, 4435075.0 / 23359437},
      {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
      {1425312.0 / 80288307, 8788810.0 / 80288307, 70074185.0 / 80288307}};

  static Rgb relative_xyz(Rgb c) {
    const auto row = [&c](const double(&m)[3]) { return m[0] * c.r + m[1] * c.g + m[2] * c.b; };
    return {row(kMatrix[0]), row(kMatrix[1]), row(kMatrix[2])};
  }
  /// By Cramer's rule: an inverse in nine digits makes coloured specks of white.
  static Rgb clamped_rgb(Rgb relative) {
    const double v[3] = {relative.r, relative.g, relative.b};
    const auto determinant = [&v](int replaced) {
      const auto at = [&](int row, int column) {
        return column == replaced ? v[row] : kMatrix[row][column];
      };
      double sum = 0;
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        sum += at(0, i) * (at(1, j) * at(2, k) - at(1, k) * at(2, j));
      }
      return sum;
    };
    const double all = determinant(-1);
    const auto clamped = [](double x) { return std::clamp(x, 0.0, 1.0); };
    return {clamped(determinant(0) / all), clamped(determinant(1) / all),
            clamped(determinant(2) / all)};
  }
  double feature(const PlainFilters::Taps& along, int x, int y) const {
    const auto grey = [this](const auto& across, const auto& down, int u, int v) {
      return window(y_, across, down, u, v) / 116;  // the 16 cancels in a derivative
    };
    return std::hypot(grey(along, filters_.gaussian, x, y), grey(filters_.gaussian, along, x, y));
  }
  double window(const std::vector<double>& in, const PlainFilters::Taps& across,
                const PlainFilters::Taps& down, int x, int y) const {
    const int rx = int(across.size() / 2), ry = int(down.size() / 2);
    double sum = 0;
    for (int j = -ry; j <= ry; ++j)
      for (int i = -rx; i <= rx; ++i) {
        const int u = std::clamp(x + i, 0, width_ - 1), v = std::clamp(y + j, 0, height_ - 1);
        sum += across[std::size_t(i + rx)] * down[std::size_t(j + ry)] *
               in[std::size_t(v * width_ + u)];
      }
    return sum;
  }

  int width_, height_;
  const PlainFilters& filters_;
  std::vector<double> y_, cx_, cz_;
};

/// The error of each pixel.
inline std::vector<double> plain_flip(const DisplayLight& shown_a, const DisplayLight& shown_b,
                                      double pixels_per_degree) {
  const PlainFilters filters(pixels_per_degree);
  const PlainFlip a(shown_a, filters), b(shown_b, filters);
  const double largest =
      PlainFlip::distance(PlainFlip::hunt_lab({0, 1, 0}), PlainFlip::hunt_lab({0, 0, 1}));
  std::vector<double> errors;
  for (int y = 0; y < shown_a.height(); ++y)
    for (int x = 0; x < shown_a.width(); ++x) {
      const double share = PlainFlip::distance(a.colour(x, y), b.colour(x, y)) / largest;
      const double colour = share < 0.4 ? share * 0.95 / 0.4 : 0.95 + (share - 0.4) / 0.6 * 0.05;
      const double edge = std::abs(a.edge(x, y) - b.edge(x, y)),
                   point = std::abs(a.point(x, y) - b.point(x, y));
      errors.push_back(std::pow(colour, 1 - std::sqrt(std::max(edge, point) / std::sqrt(2.0))));
    }
  return errors;
}

}  // namespace lobelia::fixtures
