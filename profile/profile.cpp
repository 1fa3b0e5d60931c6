#include "profile/profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/system/error.hpp"
#include "base/words/constants.hpp"

namespace lobelia {
namespace {

// The curve reaches a little past the blooming zone, to show its end. A bin is as wide as the distance between pixels,
// within these bounds: finer bins would hold one pixel or none, coarser ones would flatten the peak.
constexpr double kCurveReach = 1.25;
constexpr double kFewestBins = 64, kMostBins = 128;

struct LitPixel {
  std::size_t index;
  double angle;
};

std::vector<LitPixel> lit_pixels(const ProfileGeometry& geometry) {
  std::vector<LitPixel> lit;
  for (std::size_t i = 0; i < geometry.angle.size(); ++i)
    if (!std::isnan(geometry.angle[i])) lit.push_back({i, geometry.angle[i]});
  return lit;
}

/// Bins for angles up to `reach`. Their width follows the density of the pixels.
struct Binning {
  double reach = 0, width = 1;
  std::size_t bins = 0;

  Binning(const std::vector<LitPixel>& lit, double end) {
    double largest = 0;
    for (const LitPixel& pixel : lit) largest = std::max(largest, pixel.angle);
    reach = std::min(kCurveReach * end, largest);
    if (!(reach > 0)) return;
    const auto within = std::ranges::count_if(
        lit, [&](double angle) { return angle <= reach; }, &LitPixel::angle);
    // The side of a square with a pixel's share of the disc of radius `reach`.
    const double spacing = reach * std::sqrt(kPi / double(std::max<std::ptrdiff_t>(within, 1)));
    width = std::clamp(spacing, reach / kMostBins, reach / kFewestBins);
    bins = std::size_t(std::ceil(reach / width));
  }
  std::size_t bin(double angle) const { return std::min(std::size_t(angle / width), bins - 1); }
};

void add_curves(Profile& profile, const std::vector<LitPixel>& lit, const NamedImages& images) {
  const Binning binning(lit, profile.ends.back());
  std::vector<std::size_t> count(binning.bins, 0);
  std::vector<double> angle_sum(binning.bins, 0.0);
  std::vector<std::vector<double>> sums(images.size(), angle_sum);
  for (const LitPixel& pixel : lit) {
    if (binning.bins == 0 || pixel.angle > binning.reach) continue;
    const std::size_t bin = binning.bin(pixel.angle);
    ++count[bin];
    angle_sum[bin] += pixel.angle;
    for (std::size_t k = 0; k < images.size(); ++k)
      sums[k][bin] += radiance_at(*images[k].second, pixel.index);
  }
  profile.radiance.resize(images.size());
  for (std::size_t bin = 0; bin < binning.bins; ++bin) {
    if (count[bin] == 0) continue;
    profile.pixels.push_back(count[bin]);
    profile.angle.push_back(angle_sum[bin] / double(count[bin]));
    for (std::size_t k = 0; k < images.size(); ++k)
      profile.radiance[k].push_back(sums[k][bin] / double(count[bin]));
  }
}

/// The angle at which the curve, from the peak outward, first falls to half the peak. Linear between bins.
double half_width(const std::vector<double>& angle, const std::vector<double>& radiance,
                  const HighlightShape& shape) {
  if (!(shape.peak > 0)) return kNaN;
  const double half = shape.peak / 2;
  double inner_angle = shape.peak_angle, inner = shape.peak;
  for (std::size_t bin = 0; bin < angle.size(); ++bin) {
    if (angle[bin] <= shape.peak_angle) continue;
    if (radiance[bin] <= half)
      return inner_angle + (angle[bin] - inner_angle) * (inner - half) / (inner - radiance[bin]);
    inner_angle = angle[bin];
    inner = radiance[bin];
  }
  return kNaN;
}

HighlightShape measure_shape(const std::vector<LitPixel>& lit, const ProfileGeometry& geometry,
                             const Image& image) {
  HighlightShape shape{lit.empty() ? kNaN : -kInfinity, kNaN, kNaN, 0};
  bool finite = true;
  for (const LitPixel& pixel : lit) {
    const double radiance = radiance_at(image, pixel.index);
    finite = finite && std::isfinite(radiance);
    shape.energy += radiance * geometry.solid_angle[pixel.index];
    if (radiance > shape.peak) {
      shape.peak = radiance;
      shape.peak_angle = pixel.angle;
    }
  }
  // The true peak may be hidden by a NaN.
  if (!finite) shape.peak = shape.peak_angle = kNaN;
  return shape;
}

ZoneErrors zone_errors(const std::vector<LitPixel>& lit, const ZoneEnds& ends, const Image& a,
                       const Image& b, double peak) {
  ZoneErrorSums sums;
  for (const LitPixel& pixel : lit) {
    const auto zone = std::size_t(std::ranges::upper_bound(ends, pixel.angle) - ends.begin());
    if (zone < kZoneCount)
      sums.add(zone, radiance_at(a, pixel.index) - radiance_at(b, pixel.index));
  }
  return sums.errors(peak);
}

void require_pixel_count(const ProfileGeometry& geometry, const NamedImages& images) {
  const std::size_t expected = geometry.angle.size();
  const bool figures = geometry.width > 0;
  if (geometry.solid_angle.size() != expected ||
      (figures && (geometry.scale.size() != expected || geometry.base.size() != expected ||
                   expected % std::size_t(geometry.width) != 0)))
    throw Error(ExitCode::kInternal, "the geometry of a profile's pixels differs in number");
  for (const auto& [name, image] : images)
    if (image->pixel_count() != expected)
      throw Error(ExitCode::kInput, "{} has {} x {} pixels, the scene's film has {}", name,
                  image->width(), image->height(), expected);
}

}  // namespace

void ZoneErrorSums::add(std::size_t zone, double difference) {
  Sum& sum = sums_[zone];
  sum.finite = sum.finite && std::isfinite(difference);
  sum.max_abs = std::max(sum.max_abs, std::abs(difference));
  sum.squares += difference * difference;
  ++sum.pixels;
}

ZoneErrors ZoneErrorSums::errors(double peak) const {
  ZoneErrors errors;
  std::ranges::transform(sums_, errors.begin(), [&](const Sum& sum) -> records::ZoneError {
    if (sum.pixels == 0 || !sum.finite) return {sum.pixels, kNaN, kNaN, kNaN};
    return {sum.pixels, sum.max_abs, std::sqrt(sum.squares / double(sum.pixels)),
            sum.max_abs == 0 ? 0 : sum.max_abs / peak};
  });
  return errors;
}

Profile measure_profile(const ProfileGeometry& geometry, const NamedImages& images,
                        const std::vector<std::pair<std::size_t, std::size_t>>& pairs,
                        const std::vector<PictureFacts>& facts) {
  require_pixel_count(geometry, images);
  const std::vector<LitPixel> lit = lit_pixels(geometry);
  Profile profile;
  profile.ends = geometry.ends;
  profile.incidence = geometry.incidence;
  add_curves(profile, lit, images);
  for (std::size_t k = 0; k < images.size(); ++k) {
    profile.names.push_back(images[k].first);
    HighlightShape shape = measure_shape(lit, geometry, *images[k].second);
    shape.half_width = half_width(profile.angle, profile.radiance[k], shape);
    profile.shapes.push_back(shape);
    if (geometry.width > 0)
      profile.figures.push_back(measure_highlight(geometry, *images[k].second,
                                                  facts.empty() ? PictureFacts{} : facts.at(k)));
  }
  for (const auto& [a, b] : pairs)
    profile.differences.push_back({images.at(a).first, images.at(b).first,
                                   zone_errors(lit, geometry.ends, *images.at(a).second,
                                               *images.at(b).second, profile.shapes[b].peak)});
  return profile;
}

}  // namespace lobelia
