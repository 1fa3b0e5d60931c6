#include "compare/profile/blob.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/error.hpp"

namespace lobelia {
namespace {

// In half-widths. A Gaussian falls to 1/512 at 3 of them, and to 1/1000 at kZoneReach.
constexpr double kBackgroundFrom = 3, kBackgroundTo = 4.5, kEnergyReach = 3;
const double kZoneReach = std::sqrt(-std::log2(kZoneShares.back()));
constexpr std::size_t kFewestBackgroundPixels = 16;
constexpr double kCurveStep = 0.5;
constexpr double kMostOffsets = 500;  // on each side

Field radiance_of(const Image& image) {
  Field field{image.width(), image.height(), std::vector<double>(image.pixel_count())};
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const double radiance = radiance_at(image, i);
    field.values[i] = std::isfinite(radiance) ? radiance : kNaN;
  }
  return field;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double distance(FilmPoint a, FilmPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Finite values of the pixels between two distances from `middle`.
std::vector<double> ring(const Field& field, FilmPoint middle, double from, double to) {
  std::vector<double> values;
  for (std::size_t i = 0; i < field.values.size(); ++i) {
    const double away = distance(pixel_centre(field, i), middle);
    if (away >= from && away < to && !std::isnan(field.values[i]))
      values.push_back(field.values[i]);
  }
  return values;
}

BlobFigures no_blob(BlobFigures figures, std::string why) {
  figures.peak = {{kNaN, kNaN}, kNaN};
  figures.axes = {{kNaN, kNaN}, {kNaN, kNaN}, kNaN, kNaN};
  figures.background = figures.energy = kNaN;
  figures.major_half_width = figures.minor_half_width = kNaN;
  figures.why_not = std::move(why);
  return figures;
}

double half_width(const Field& above, const Peak& peak, FilmPoint direction) {
  return (distance_to_level(above, peak.place, direction, peak.value / 2) +
          distance_to_level(above, peak.place, {-direction.x, -direction.y}, peak.value / 2)) /
         2;
}

std::string remark_on(const Field& field, const BlobFigures& blob,
                      const std::vector<std::size_t>& region) {
  if (blob.pixels < kFewestPixelsOfALobe)
    return blob.pixels == 1
               ? "one pixel alone is above half of the peak: a highlight smaller than a "
                 "pixel, or a fault of the picture"
               : fmt::format(
                     "not resolved: {} pixels are above half of the peak, {} "
                     "are needed",
                     blob.pixels, kFewestPixelsOfALobe);
  if (blob.peak.found == PeakFound::kPlateau)
    return "many pixels have exactly the largest value: it is clipped, or flat";
  for (const std::size_t i : region) {
    const FilmPoint place = pixel_centre(field, i);
    if (place.x < 1 || place.y < 1 || place.x > field.width - 1 || place.y > field.height - 1)
      return "it is cut by the border of the picture";
  }
  return "";
}

BlobFigures measure(const Field& field) {
  BlobFigures blob;
  std::vector<double> finite = ring(field, {}, 0, kInfinity);
  blob.not_finite = field.values.size() - finite.size();
  if (finite.empty()) return no_blob(blob, "no pixel is finite");
  blob.background = median(finite);
  const auto brightest = std::size_t(
      std::max_element(field.values.begin(), field.values.end(),
                       [](double a, double b) { return std::isnan(a) ? !std::isnan(b) : a < b; }) -
      field.values.begin());
  const double largest = field.values[brightest];

  std::vector<std::size_t> region;
  // The blob defines its background, and the background the half of its peak. This settles at once.
  for (int round = 0; round < 4; ++round) {
    if (!(largest > blob.background))
      return no_blob(blob, "nothing stands out: no pixel is brighter than its surroundings");
    region = region_above(field, brightest, (largest + blob.background) / 2);
    blob.axes = principal_axes(field, region, blob.background);
    const double semi_axis = std::max(1.0, 2 * blob.axes.major_sigma);
    const std::vector<double> around =
        ring(field, blob.axes.centre, kBackgroundFrom * semi_axis, kBackgroundTo * semi_axis);
    if (around.size() < kFewestBackgroundPixels || round == 3) break;
    blob.background = median(around);
  }
  blob.pixels = region.size();

  Field above = field;
  for (double& value : above.values) value -= blob.background;
  blob.peak = locate_peak(above);
  blob.major_half_width = blob.minor_half_width = kNaN;
  if (blob.pixels >= kFewestPixelsOfALobe) {
    const FilmPoint major = blob.axes.major;
    blob.major_half_width = half_width(above, blob.peak, major);
    blob.minor_half_width = half_width(above, blob.peak, {-major.y, major.x});
  }
  for (const double value :
       ring(above, blob.axes.centre, 0, kEnergyReach * std::max(1.0, 2 * blob.axes.major_sigma)))
    blob.energy += value;
  blob.remark = remark_on(field, blob, region);
  return blob;
}

/// The reach of the zones from the peak, pixels.
double reach_of(const BlobFigures& blob) {
  return kZoneReach *
         (std::isnan(blob.major_half_width) ? 2 * blob.axes.major_sigma : blob.major_half_width);
}

std::vector<BlobCurve> curves_along(const BlobFigures& blob, const std::vector<Field>& fields) {
  const double reach = reach_of(blob), step = std::max(kCurveStep, reach / kMostOffsets);
  const FilmPoint major = blob.axes.major, minor{-major.y, major.x};
  std::vector<BlobCurve> curves;
  for (const auto& [axis, direction] : {std::pair{"major", major}, std::pair{"minor", minor}}) {
    BlobCurve curve{axis, {}, std::vector<std::vector<double>>(fields.size())};
    const int steps = int(std::ceil(reach / step));
    for (int k = -steps; k <= steps; ++k) {
      curve.offset.push_back(k * step);
      for (std::size_t image = 0; image < fields.size(); ++image)
        curve.radiance[image].push_back(
            sample(fields[image], {blob.peak.place.x + k * step * direction.x,
                                   blob.peak.place.y + k * step * direction.y}));
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// A pixel near the peak belongs to a zone by the reference's share of its peak there.
ZoneErrors difference_of(const Field& a, const Field& b, const BlobFigures& reference) {
  ZoneErrorSums sums;
  const double reach = reach_of(reference);
  for (std::size_t i = 0; i < b.values.size(); ++i) {
    if (distance(pixel_centre(b, i), reference.peak.place) > reach) continue;
    const double share = (b.values[i] - reference.background) / reference.peak.value;
    const auto zone =
        std::ranges::find_if(kZoneShares, [&](double least) { return share >= least; });
    if (zone != kZoneShares.end())
      sums.add(std::size_t(zone - kZoneShares.begin()), a.values[i] - b.values[i]);
  }
  return sums.errors(reference.peak.value);
}

}  // namespace

BlobProfile measure_blob(const NamedImages& images) {
  const Image& first = *images.front().second;
  BlobProfile profile;
  std::vector<Field> fields;
  for (const auto& [name, image] : images) {
    if (image->width() != first.width() || image->height() != first.height())
      throw Error(ExitCode::kInput, fmt::format("{} has {} x {} pixels, {} has {} x {}",
                                                images.front().first, first.width(), first.height(),
                                                name, image->width(), image->height()));
    profile.names.push_back(name);
    fields.push_back(radiance_of(*image));
    profile.blobs.push_back(measure(fields.back()));
  }
  const BlobFigures& reference = profile.blobs.back();
  if (!reference.why_not.empty()) return profile;
  profile.curves = curves_along(reference, fields);
  if (fields.size() > 1) profile.difference = difference_of(fields[0], fields[1], reference);
  return profile;
}

}  // namespace lobelia
