#include "profile/blob_measurement.hpp"

#include <algorithm>
#include <cmath>

#include "base/words/constants.hpp"
#include "profile/contour.hpp"
#include "profile/find_blobs.hpp"
#include "profile/least_squares.hpp"

namespace lobelia {
namespace {

/// The centroid within the ellipse of the half-widths. Within the pixels above half it would move with their noise.
FilmPoint centroid(const Field& above, const BlobMeasurement::Result& result, const Axes& rough) {
  const FilmPoint middle = result.outline.peak.place, major = rough.major;
  const double a = result.outline.half_width(0), b = result.outline.half_width(1);
  double sum = 0;
  FilmPoint centre;
  for (std::size_t i = 0; i < above.values.size(); ++i) {
    const FilmPoint place = pixel_centre(above, i);
    const double dx = place.x - middle.x, dy = place.y - middle.y;
    const double u = (major.x * dx + major.y * dy) / a, v = (-major.y * dx + major.x * dy) / b;
    // The share of a pixel on the ellipse, by its distance from there towards the middle.
    const double out = std::hypot(u, v);
    const double share =
        out > 0 ? std::clamp(std::hypot(dx, dy) * (1 / out - 1) + 0.5, 0.0, 1.0) : 1;
    if (!(share > 0) || std::isnan(above.values[i])) continue;
    sum += share * above.values[i];
    centre.x += share * above.values[i] * place.x;
    centre.y += share * above.values[i] * place.y;
  }
  return sum > 0 ? FilmPoint{centre.x / sum, centre.y / sum} : rough.centre;
}

/// The rest beneath a blob after its background: a level, and a slope where the ring around it is whole.
struct Plane {
  double value;  ///< at the middle
  FilmPoint slope;
  double at(FilmPoint place, FilmPoint middle) const {
    return value + slope.x * (place.x - middle.x) + slope.y * (place.y - middle.y);
  }
};

/// The median of the ring, and one step of Tukey's biweight for the slope: the slope of the background is known before, but
/// for its noise.
Plane plane_of(const Field& above, const std::vector<std::size_t>& ring, const Axes& rough) {
  std::vector<double> values, deviations;
  FilmPoint mean;
  for (const std::size_t i : ring) {
    const FilmPoint place = pixel_centre(above, i);
    values.push_back(above.values[i]);
    mean.x += place.x / double(ring.size());
    mean.y += place.y / double(ring.size());
  }
  Plane plane{median(values), {0, 0}};
  const double size = 2 * rough.major_sigma;
  if (distance(mean, rough.centre) > size / 2) return plane;
  for (const double value : values) deviations.push_back(std::abs(value - plane.value));
  constexpr double kTukey = 4.685, kDeviationOfNormal = 1.4826;
  const double end = kTukey * kDeviationOfNormal * median(std::move(deviations));
  if (!(end > 0)) return plane;
  NormalEquations<3> normal(3);
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const FilmPoint place = pixel_centre(above, ring[k]);
    const double share = (values[k] - plane.value) / end;
    if (std::abs(share) >= 1) continue;
    normal.add({1, (place.x - rough.centre.x) / size, (place.y - rough.centre.y) / size},
               (1 - share * share) * (1 - share * share), values[k]);
  }
  if (!normal.factorise()) return plane;
  const auto solution = normal.solution();
  plane.slope = {solution[1] / size, solution[2] / size};
  return plane;
}

/// The energy of a curve in the disc of its own long half-width.
double energy_of(const FalloffFit& curve, const Field& field) {
  // In a small highlight, a pixel's mean differs from the value at its centre.
  constexpr double kSmall = 15;
  const int parts = curve.major_half_width.value < kSmall ? 3 : 1;
  const double reach = kEnergyReach * std::max(1.0, kSemiAxis * curve.major_half_width.value);
  double sum = 0;
  for (int y = 0; y < parts * field.height; ++y)
    for (int x = 0; x < parts * field.width; ++x) {
      const FilmPoint place{(x + 0.5) / parts, (y + 0.5) / parts};
      if (distance(place, curve.place) < reach) sum += value_at(curve, place);
    }
  return sum / (parts * parts);
}

}  // namespace

std::array<double, BlobMeasurement::Result::kFigures> BlobMeasurement::Result::figures() const {
  return {shift,         outline.peak.value, outline.peak.place.x,  outline.peak.place.y,
          axes.centre.x, axes.centre.y,      outline.half_width(0), outline.half_width(1),
          energy};
}

BlobMeasurement::Result BlobMeasurement::measure(Field above) const {
  Result result;
  if (!ring.empty()) {
    const Plane beneath = plane_of(above, ring, rough);
    result.shift = beneath.value;
    for (std::size_t i = 0; i < above.values.size(); ++i)
      above.values[i] -= beneath.at(pixel_centre(above, i), rough.centre);
  }
  const std::size_t brightest =
      *std::ranges::max_element(region, {}, [&](std::size_t i) { return above.values[i]; });
  result.axes = rough;
  result.pixels = region.size();
  if (!is_smoothed(rough, noise) && above.values[brightest] > 0) {
    const auto half = region_above(above, brightest, above.values[brightest] / 2);
    result.axes = principal_axes(parts_above(above, half, above.values[brightest] / 2));
    result.pixels = half.size();
  }
  result.outline = trace_outline(above, result.axes, result.axes.major, noise, brightest);
  if (is_smoothed(rough, noise)) result.axes.centre = centroid(above, result, rough);
  const double half_width = result.outline.half_width(0);
  const double reach =
      kEnergyReach * std::max(1.0, half_width > 0 ? kSemiAxis * half_width : 2 * rough.major_sigma);
  for (std::size_t i = 0; i < above.values.size(); ++i)
    if (!std::isnan(above.values[i]))
      result.energy +=
          share_within(pixel_centre(above, i), result.axes.centre, reach) * above.values[i];
  return result;
}

std::array<double, BlobMeasurement::Result::kFigures> BlobMeasurement::method_errors(
    const FalloffFit& curve, const Field& field, double semi_axis) const {
  constexpr std::array<FilmPoint, 5> kShifts = {
      {{0, 0}, {0.31, 0.17}, {-0.23, 0.38}, {-0.42, -0.29}, {0.14, -0.47}}};
  std::array<double, Result::kFigures> errors{};
  for (const FilmPoint by : kShifts) {
    FalloffFit moved = curve;
    moved.place = {curve.place.x + by.x, curve.place.y + by.y};
    BlobMeasurement how = *this;
    how.rough.centre = {rough.centre.x + by.x, rough.centre.y + by.y};
    Field above = field;
    for (std::size_t i = 0; i < above.values.size(); ++i)
      if (!std::isnan(field.values[i])) above.values[i] = value_at(moved, pixel_centre(field, i));
    double background = 0;
    if (auto around = background_around(above, how.rough.centre, semi_axis)) {
      for (std::size_t i = 0; i < above.values.size(); ++i)
        above.values[i] -= around->at(pixel_centre(field, i));
      background = around->at(moved.place);
      how.ring = std::move(around->ring);
    }
    const auto found = how.measure(std::move(above)).figures();
    const double truth[] = {-background,
                            curve.peak.value,
                            moved.place.x,
                            moved.place.y,
                            moved.place.x,
                            moved.place.y,
                            curve.major_half_width.value,
                            curve.minor_half_width.value,
                            energy_of(moved, field)};
    for (std::size_t k = 0; k < errors.size(); ++k)
      errors[k] += (found[k] - truth[k]) * (found[k] - truth[k]) / double(kShifts.size());
  }
  for (double& error : errors) error = std::sqrt(error);
  return errors;
}

}  // namespace lobelia
