#include <algorithm>
#include <array>
#include <cmath>

#include "base/words/constants.hpp"
#include "profile/peak.hpp"

namespace lobelia {
namespace {

/// Weights of four neighbouring pixels at a distance t past the second.
std::array<double, 4> cubic_weights(double t) {
  return {((-0.5 * t + 1) * t - 0.5) * t, (1.5 * t - 2.5) * t * t + 1,
          ((-1.5 * t + 2) * t + 0.5) * t, (0.5 * t - 0.5) * t * t};
}

/// See sample() and sample_of_highlight().
double interpolated(const Field& field, FilmPoint place, bool of_logarithms) {
  const double x = place.x - 0.5, y = place.y - 0.5;
  if (!(x > -1 && y > -1 && x < field.width && y < field.height)) return kNaN;
  const int i = int(std::floor(x)), j = int(std::floor(y));
  const auto wx = cubic_weights(x - i), wy = cubic_weights(y - j);
  double sum = 0;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const double weight = wx[std::size_t(column)] * wy[std::size_t(row)];
      // On a line through pixel centres, pixels beside it have no weight and may be holes.
      if (weight == 0) continue;
      const double value = field.at(i - 1 + column, j - 1 + row);
      if (of_logarithms && !(value > 0)) return interpolated(field, place, false);
      sum += weight * (of_logarithms ? std::log(value) : value);
    }
  return of_logarithms ? std::exp(sum) : sum;
}

}  // namespace

double Field::at(int i, int j) const {
  if (i < 0 || j < 0 || i >= width || j >= height) return kNaN;
  return values[std::size_t(j) * width + i];
}

Field radiance_field(const Image& image) {
  Field field{image.width(), image.height(), std::vector<double>(image.pixel_count())};
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const double radiance = radiance_at(image, i);
    field.values[i] = std::isfinite(radiance) ? radiance : kNaN;
  }
  return field;
}

FilmPoint pixel_centre(const Field& field, std::size_t index) {
  const std::size_t width = std::size_t(field.width);
  return {double(index % width) + 0.5, double(index / width) + 0.5};
}

double sample(const Field& field, FilmPoint place) { return interpolated(field, place, false); }

double sample_of_highlight(const Field& field, FilmPoint place) {
  return interpolated(field, place, true);
}

std::vector<std::size_t> region_above(const Field& field, std::size_t start, double level) {
  std::vector<std::size_t> region{start};
  std::vector<bool> seen(field.values.size(), false);
  seen[start] = true;
  for (std::size_t next = 0; next < region.size(); ++next) {
    const int x = int(region[next] % field.width), y = int(region[next] / field.width);
    for (int j = y - 1; j <= y + 1; ++j)
      for (int i = x - 1; i <= x + 1; ++i) {
        if (!(field.at(i, j) >= level)) continue;
        const std::size_t index = std::size_t(j) * field.width + i;
        if (seen[index]) continue;
        seen[index] = true;
        region.push_back(index);
      }
  }
  return region;
}

Axes axes_of_moments(FilmPoint centre, double xx, double xy, double yy) {
  const double half_turn = std::atan2(2 * xy, xx - yy) / 2;
  const double mean = (xx + yy) / 2, spread = std::hypot((xx - yy) / 2, xy);
  return {centre,
          {std::cos(half_turn), std::sin(half_turn)},
          std::sqrt(mean + spread),
          std::sqrt(std::max(0.0, mean - spread))};
}

Axes principal_axes(const Field& field, const std::vector<std::size_t>& pixels, double base) {
  double sum = 0;
  FilmPoint centre;
  for (const std::size_t i : pixels) {
    const double weight = field.values[i] - base;
    sum += weight;
    const FilmPoint place = pixel_centre(field, i);
    centre.x += weight * place.x;
    centre.y += weight * place.y;
  }
  centre.x /= sum;
  centre.y /= sum;
  constexpr double kOfPixel = 1.0 / 12;
  double xx = kOfPixel, xy = 0, yy = kOfPixel;
  for (const std::size_t i : pixels) {
    const double weight = (field.values[i] - base) / sum;
    const FilmPoint place = pixel_centre(field, i);
    const double dx = place.x - centre.x, dy = place.y - centre.y;
    xx += weight * dx * dx;
    xy += weight * dx * dy;
    yy += weight * dy * dy;
  }
  return axes_of_moments(centre, xx, xy, yy);
}

double distance_to_level(const Field& field, FilmPoint peak, FilmPoint direction, double level) {
  const auto at = [&](double distance) {
    return sample_of_highlight(field,
                               {peak.x + distance * direction.x, peak.y + distance * direction.y});
  };
  constexpr double kStep = 0.25;
  // Every value outside the film is NaN, which ends the walk.
  for (double inner = 0;; inner += kStep) {
    const double value = at(inner + kStep);
    if (std::isnan(value)) return kNaN;
    if (value > level) continue;
    double above = inner, below = inner + kStep;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = (above + below) / 2;
      (at(middle) > level ? above : below) = middle;
    }
    return below;
  }
}

}  // namespace lobelia
