// LDR-FLIP as the formulas stand: in double, each pixel's windows one after the other, without separation.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "compare/metrics/flip_error.hpp"
#include "tests/compare/pictures.hpp"

namespace lobelia::fixtures {

class PlainFlip {
 public:
  PlainFlip(const DisplayLight& shown, const FlipFilters& filters)
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
  static Rgb relative_xyz(Rgb c) {
    return {(10135552 * c.r + 8788810 * c.g + 4435075 * c.b) / 24577794 * 1.052156925,
            (2613072 * c.r + 8788810 * c.g + 887015 * c.b) / 12288897,
            (1425312 * c.r + 8788810 * c.g + 70074185 * c.b) / 73733382 * 0.918357670};
  }
  static Rgb clamped_rgb(Rgb relative) {
    const double x = relative.r * 0.950428545, y = relative.g, z = relative.b * 1.088900371;
    const auto clamped = [](double v) { return std::clamp(v, 0.0, 1.0); };
    return {clamped(3.241003275 * x - 1.537398934 * y - 0.498615861 * z),
            clamped(-0.969224334 * x + 1.875930071 * y + 0.041554224 * z),
            clamped(0.055639423 * x - 0.204011202 * y + 1.057148933 * z)};
  }
  double feature(const std::vector<float>& along, int x, int y) const {
    const auto grey = [this](const auto& across, const auto& down, int u, int v) {
      return window(y_, across, down, u, v) / 116;  // the 16 cancels in a derivative
    };
    return std::hypot(grey(along, filters_.gaussian, x, y), grey(filters_.gaussian, along, x, y));
  }
  double window(const std::vector<double>& in, const std::vector<float>& across,
                const std::vector<float>& down, int x, int y) const {
    const int rx = int(across.size() / 2), ry = int(down.size() / 2);
    double sum = 0;
    for (int j = -ry; j <= ry; ++j)
      for (int i = -rx; i <= rx; ++i) {
        const int u = std::clamp(x + i, 0, width_ - 1), v = std::clamp(y + j, 0, height_ - 1);
        sum += double(across[std::size_t(i + rx)]) * double(down[std::size_t(j + ry)]) *
               in[std::size_t(v * width_ + u)];
      }
    return sum;
  }

  int width_, height_;
  const FlipFilters& filters_;
  std::vector<double> y_, cx_, cz_;
};

/// The error of each pixel.
inline std::vector<double> plain_flip(const DisplayLight& shown_a, const DisplayLight& shown_b,
                                      const FlipFilters& filters) {
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
