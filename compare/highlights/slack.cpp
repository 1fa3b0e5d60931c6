#include "compare/highlights/slack.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "compare/uncertainty/z_test.hpp"
#include "profile/peak.hpp"

namespace lobelia {
namespace {

/// Roughness is looked at in so many pixels at the most, and not in fewer.
constexpr std::size_t kMostSamples = 2000, kFewestSamples = 16;
constexpr std::size_t kLargeCore = 64;

/// The value that a share of them does not exceed; 0 for too few.
double quantile_of(std::vector<double>& values, double share) {
  if (values.size() < kFewestSamples) return 0;
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// The size of the fourth difference at a pixel, of those that are `step` apart in the picture.
double fourth_difference(const Image& image, std::size_t pixel, std::size_t step) {
  const auto at = [&](std::size_t i) { return radiance_at(image, i); };
  return std::abs(at(pixel - 2 * step) - 4 * at(pixel - step) + 6 * at(pixel) -
                  4 * at(pixel + step) + at(pixel + 2 * step));
}
const double kOfNoise = std::sqrt(70.0);  ///< its deviation, of noise of deviation 1

/// The deviation of a pixel around the highlight.
double roughness_around(const Image& image, const LocalHighlight& highlight) {
  constexpr double kUpper = 0.75, kNormal = 1.1503;  // quantile, of a normal number's size
  std::vector<double> differences;
  const auto width = std::size_t(image.width());
  for_pixels_around(image, highlight, [&](std::size_t pixel, int x, int y) {
    if (x >= 2 && x + 2 < image.width()) differences.push_back(fourth_difference(image, pixel, 1));
    if (y >= 2 && y + 2 < image.height())
      differences.push_back(fourth_difference(image, pixel, width));
  });
  return quantile_of(differences, kUpper) / (kNormal * kOfNoise);
}

/// The same within a core, if it has pixels enough.
double roughness_within(const Image& image, const LocalHighlight& highlight) {
  constexpr double kNormal = 0.6745;
  std::vector<double> differences;
  for (const PixelRun& run : highlight.core) {
    const std::size_t row = std::size_t(run.y) * std::size_t(image.width());
    for (int x = run.x + 2; x < run.end - 2; ++x)
      differences.push_back(fourth_difference(image, row + std::size_t(x), 1));
    if (differences.size() > kMostSamples) break;
  }
  if (differences.size() < kLargeCore) return 0;
  return quantile_of(differences, 0.5) / (kNormal * kOfNoise);
}

/// The larger known error of a pixel's channels.
double known_error(const PictureNoise* noise, std::size_t pixel) {
  if (!noise) return 0;
  const float* error = noise->standard_error.values().data() + 3 * pixel;
  return double(std::max({error[0], error[1], error[2]}));
}

/// Standard error of a weighted sum over pixels.
class ErrorOfSum {
 public:
  void add(double weight, double independent, double shared) {
    squares_ += weight * weight * independent;
    shared_ += std::abs(weight) * shared;
  }
  double value() const { return std::sqrt(squares_) + shared_; }

 private:
  double squares_ = 0, shared_ = 0;
};

}  // namespace

bool add_slack(const Image& reference, const HighlightNoise& noise, double peak,
               LocalHighlight& highlight) {
  const double rough =
      std::max(roughness_around(reference, highlight), roughness_within(reference, highlight));
  // The step of an encoding such as sRGB grows with the value, faster than its root.
  const double rounding =
      noise.rounding > 0 ? noise.rounding * std::sqrt(std::min(1.0, highlight.peak / peak)) : 0;
  const auto errors_at = [&](std::size_t pixel) {
    double independent = 2 * rough * rough, shared = 0;
    if (noise.known)
      for (const PictureNoise* one : {noise.known->a, noise.known->b}) {
        const double error = known_error(one, pixel);
        if (one && one->shared)
          shared += error;
        else
          independent += error * error;
      }
    return std::pair(independent, shared);
  };
  // Every pixel is off by the error of the ring's median.
  double level = 0;
  for (const std::size_t pixel : highlight.ring) level += errors_at(pixel).first;
  constexpr double kOfMedian = 1.2533;
  if (level > 0) level = kOfMedian * std::sqrt(level) / double(highlight.ring.size());
  constexpr double kLeastHeight = 6, kMostSlack = 0.15;
  ErrorOfSum energy, x_sum, y_sum, width;
  double squares = 0, fourths = 0, core = 0;
  for_pixels(highlight.core, reference.width(), [&](std::size_t pixel, int, int) {
    const auto [independent, shared] = errors_at(pixel);
    energy.add(1, independent, shared);
    ++core;
  });
  for_pixels(highlight.pixels, reference.width(), [&](std::size_t pixel, int x, int y) {
    const auto [independent, shared] = errors_at(pixel);
    const double away = squared_distance(highlight, x, y);
    x_sum.add(x - highlight.centre_x, independent, shared);
    y_sum.add(y - highlight.centre_y, independent, shared);
    width.add(away, independent, shared);
    squares += away;
    fourths += away * away;
  });
  highlight.energy_slack =
      (kSlack * (energy.value() + level * core) + rounding * core) / highlight.energy;
  highlight.shift_slack =
      kSlack * (std::hypot(x_sum.value(), y_sum.value()) + rounding * std::sqrt(squares)) /
      highlight.light;
  highlight.width_slack =
      highlight.spread > 0
          ? kSlack * (width.value() + level * squares + rounding * std::sqrt(fourths)) /
                (2 * highlight.spread)
          : 0;
  const double of_pixel = core > 0 ? std::max(rough, energy.value() / std::sqrt(2 * core)) : 0;
  return highlight.energy_slack <= kMostSlack && highlight.height() >= kLeastHeight * of_pixel;
}

}  // namespace lobelia
