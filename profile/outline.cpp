#include "profile/outline.hpp"

#include <algorithm>
#include <cmath>

#include "base/words/constants.hpp"
#include "profile/least_squares.hpp"

namespace lobelia {
namespace {

constexpr double kQuiet = 2e-3;  // of the peak; half floats and 8 bits have less
constexpr int kTerms = 15;       // of degree 4
// Highlights of fewer pixels differ from a polynomial by more than noise, and scatter_of() takes their shape for noise.
constexpr double kFewestPixels = 40, kFewestInWindow = 25;
// In half-widths. The error by the shape grows with the sixth power of the window, as kShapeError for a Gaussian.
constexpr double kLargestWindow = 1.2, kShapeError = 0.0028, kUndersmoothing = 0.85;
// A wide highlight is first averaged over squares, so that a half-width has at most twice so many of them.
constexpr double kFinest = 12;

/// A polynomial over an elliptical window around any place.
class LocalSurface {
 public:
  LocalSurface(const Field& field, const Axes& rough, double window)
      : field_(field),
        major_(rough.major),
        a_(window * 2 * rough.major_sigma),
        b_(window * 2 * rough.minor_sigma) {}

  struct Value {
    double f;
    FilmPoint newton;  ///< the step to the maximum, pixels; NaN if there is none
  };
  /// Nothing if there are too few pixels.
  std::optional<Value> at(FilmPoint place) const {
    const double reach = std::max(a_, b_);
    const int left = int(std::floor(place.x - reach)), top = int(std::floor(place.y - reach));
    const int right = int(std::ceil(place.x + reach)), bottom = int(std::ceil(place.y + reach));
    NormalEquations<kTerms> normal(kTerms);
    int count = 0;
    for (int j = std::max(0, top); j < std::min(field_.height, bottom); ++j)
      for (int i = std::max(0, left); i < std::min(field_.width, right); ++i) {
        const double dx = i + 0.5 - place.x, dy = j + 0.5 - place.y;
        const double u = (major_.x * dx + major_.y * dy) / a_;
        const double v = (-major_.y * dx + major_.x * dy) / b_;
        const double value = field_.at(i, j);
        if (u * u + v * v > 1 || std::isnan(value)) continue;
        const std::array<double, 5> us = {1, u, u * u, u * u * u, u * u * u * u},
                                    vs = {1, v, v * v, v * v * v, v * v * v * v};
        std::array<double, kTerms> row;
        std::size_t k = 0;
        for (std::size_t p = 0; p < 5; ++p)
          for (std::size_t q = 0; p + q < 5; ++q) row[k++] = us[p] * vs[q];
        normal.add(row, 1, value);
        ++count;
      }
    if (count < kTerms + 3 || !normal.factorise()) return std::nullopt;
    const auto c = normal.solution();
    // Terms u^p v^q in the order of the loops above.
    const double fv = c[1], fvv = 2 * c[2], fu = c[5], fuv = c[6], fuu = 2 * c[9];
    const double determinant = fuu * fvv - fuv * fuv;
    Value value{c[0], {kNaN, kNaN}};
    if (fuu < 0 && determinant > 0) {
      const double du = a_ * (fuv * fv - fvv * fu) / determinant;
      const double dv = b_ * (fuv * fu - fuu * fv) / determinant;
      value.newton = {major_.x * du - major_.y * dv, major_.y * du + major_.x * dv};
    }
    return value;
  }

 private:
  const Field& field_;
  FilmPoint major_;
  double a_, b_;
};

/// Where the surface falls to `level` along a ray, near `guess`; NaN if it does not.
double fall(const LocalSurface& surface, const Field& field, FilmPoint from, FilmPoint direction,
            double level, double guess) {
  const auto at = [&](double distance) {
    const FilmPoint place{from.x + distance * direction.x, from.y + distance * direction.y};
    if (!(place.x > 0 && place.y > 0 && place.x < field.width && place.y < field.height))
      return kNaN;
    const auto value = surface.at(place);
    return value ? value->f - level : kNaN;
  };
  constexpr double kStep = 0.3;  // of the guess
  double near = 0, above = level, far = (1 - kStep / 2) * guess, below = at(far);
  while (below > 0) {
    near = far;
    above = below;
    far += kStep * guess;
    below = at(far);
  }
  if (std::isnan(below)) return kNaN;
  // The false position, with halving where one end stays (the Illinois rule).
  constexpr double kClose = 1e-4;
  int kept = 0;
  double place = far;
  for (int round = 0; round < 12; ++round) {
    place = near + (far - near) * above / (above - below);
    const double value = at(place);
    if (std::isnan(value)) return kNaN;
    if (std::abs(value) < kClose * level) break;
    if (value > 0) {
      near = place;
      above = value;
      if (kept == 1) below /= 2;
      kept = 1;
    } else {
      far = place;
      below = value;
      if (kept == -1) above /= 2;
      kept = -1;
    }
  }
  return place;
}

/// The means of squares of `side` pixels; what is left over at the right and the bottom is dropped.
Field coarser(const Field& field, int side) {
  Field result{field.width / side, field.height / side, {}};
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      double sum = 0;
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) sum += field.at(side * x + i, side * y + j);
      result.values.push_back(sum / (side * side));
    }
  return result;
}

/// Nothing where no maximum is found near the middle of the rough outline.
std::optional<Outline> smoothed(const Field& above, Axes rough, FilmPoint along, double window) {
  const LocalSurface surface(above, rough, window);
  const double minor = 2 * rough.minor_sigma, major = 2 * rough.major_sigma;
  FilmPoint place = rough.centre;
  Outline outline;
  for (int round = 0; round < 20; ++round) {
    const auto value = surface.at(place);
    if (!value || std::isnan(value->newton.x)) return std::nullopt;
    outline.peak = {place, value->f, PeakFound::kFitted};
    const double step = std::hypot(value->newton.x, value->newton.y);
    const double share = std::min(1.0, minor / 4 / step);
    place = {place.x + share * value->newton.x, place.y + share * value->newton.y};
    if (distance(place, rough.centre) > major) return std::nullopt;
    // The next step would be about the square of this one.
    if (step < 0.01 * minor) {
      outline.peak.place = place;
      break;
    }
  }
  if (!(outline.peak.value > 0)) return std::nullopt;
  for (int k = 0; k < 4; ++k) {
    const FilmPoint to = outline_direction(along, k);
    const double u = (rough.major.x * to.x + rough.major.y * to.y) / major;
    const double v = (-rough.major.y * to.x + rough.major.x * to.y) / minor;
    outline.reach[std::size_t(k)] =
        fall(surface, above, outline.peak.place, to, outline.peak.value / 2, 1 / std::hypot(u, v));
  }
  return outline;
}

}  // namespace

FilmPoint outline_direction(FilmPoint along, int k) {
  const double sign = k % 2 == 0 ? 1 : -1;
  return k < 2 ? FilmPoint{sign * along.x, sign * along.y}
               : FilmPoint{-sign * along.y, sign * along.x};
}

bool is_smoothed(const Axes& rough, double noise) {
  return noise > kQuiet && 4 * kPi * rough.major_sigma * rough.minor_sigma >= kFewestPixels;
}

Outline trace_outline(const Field& above, const Axes& rough, FilmPoint along, double noise,
                      std::size_t brightest) {
  if (is_smoothed(rough, noise)) {
    const double area = 4 * kPi * rough.major_sigma * rough.minor_sigma;
    // Where the squares of both errors together are least, and then less.
    const double window = std::clamp(
        kUndersmoothing *
            std::pow(9 * noise * noise / (6 * area * kShapeError * kShapeError), 1.0 / 14),
        std::sqrt(kFewestInWindow / area), kLargestWindow);
    const int side = std::max(1, int(2 * rough.minor_sigma / kFinest));
    Axes coarse = rough;
    coarse.centre = {rough.centre.x / side, rough.centre.y / side};
    coarse.major_sigma /= side;
    coarse.minor_sigma /= side;
    auto outline = side == 1 ? smoothed(above, rough, along, window)
                             : smoothed(coarser(above, side), coarse, along, window);
    if (outline) {
      Peak& peak = outline->peak;
      peak.place = {peak.place.x * side, peak.place.y * side};
      for (double& reach : outline->reach) reach *= side;
      const int x = std::clamp(int(peak.place.x), 0, above.width - 1);
      const int y = std::clamp(int(peak.place.y), 0, above.height - 1);
      peak.pixel = above.index(x, y);
      return *outline;
    }
  }
  Outline outline{locate_peak(above, brightest)};
  for (int k = 0; k < 4; ++k)
    outline.reach[std::size_t(k)] = distance_to_level(
        above, outline.peak.place, outline_direction(along, k), outline.peak.value / 2);
  return outline;
}

Field softened(Field field, int passes) {
  const int width = field.width, height = field.height;
  for (int pass = 0; pass < passes; ++pass)
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}}) {
      const Field before = field;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          double sum = 0, weights = 0;
          for (int k = -1; k <= 1; ++k) {
            const double value = before.at(x + k * dx, y + k * dy);
            if (std::isnan(value)) continue;
            sum += (2 - std::abs(k)) * value;
            weights += 2 - std::abs(k);
          }
          double& here = field.values[field.index(x, y)];
          if (!std::isnan(here)) here = sum / weights;
        }
    }
  return field;
}

int passes_for(double noise) {
  // After m passes 1 / (2 pi m) of the noise's square is left, and a fiftieth of the peak is little.
  constexpr double kHarmless = 0.02, kNone = 0.005;
  constexpr int kMost = 16;
  if (!(noise > kNone)) return 0;
  return std::clamp(int(std::ceil(noise * noise / (2 * kPi * kHarmless * kHarmless))), 1, kMost);
}

double scatter_of(const Field& field, const std::vector<std::size_t>& pixels) {
  constexpr std::array<double, 7> kSixth = {1, -6, 15, -20, 15, -6, 1};
  constexpr double kSumOfSquares = 924;
  constexpr std::size_t kFewest = 4;
  double sum = 0;
  std::size_t count = 0;
  for (const std::size_t i : pixels) {
    const int x = int(i % std::size_t(field.width)), y = int(i / std::size_t(field.width));
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}}) {
      double difference = 0;
      for (int k = 0; k < 7; ++k)
        difference += kSixth[std::size_t(k)] * field.at(x + (k - 3) * dx, y + (k - 3) * dy);
      if (std::isnan(difference)) continue;
      sum += difference * difference / kSumOfSquares;
      ++count;
    }
  }
  return count < kFewest ? kNaN : std::sqrt(sum / double(count));
}

}  // namespace lobelia
