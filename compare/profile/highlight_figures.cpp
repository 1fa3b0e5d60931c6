// The figures of a highlight in one picture.
#include <fmt/format.h>

#include <cmath>

#include "compare/profile/profile.hpp"
#include "core/constants.hpp"

namespace lobelia {
namespace {

Field empty_field(const ProfileGeometry& geometry) {
  return {geometry.width, int(geometry.angle.size() / std::size_t(geometry.width)),
          std::vector(geometry.angle.size(), kNaN)};
}

/// The square of the angle is smooth in the middle, unlike the angle.
Field squared_angles(const ProfileGeometry& geometry) {
  Field squared = empty_field(geometry);
  for (std::size_t i = 0; i < geometry.angle.size(); ++i)
    squared.values[i] = geometry.angle[i] * geometry.angle[i];
  return squared;
}

HalfWidth half_width(const Field& highlight, const Field& squared_angle, const Peak& peak,
                     FilmPoint direction) {
  HalfWidth width;
  for (const int side : {-1, 1}) {
    const FilmPoint outward{side * direction.x, side * direction.y};
    const double distance = distance_to_level(highlight, peak.place, outward, peak.value / 2);
    const double squared = sample(
        squared_angle, {peak.place.x + distance * outward.x, peak.place.y + distance * outward.y});
    width.pixels += distance / 2;
    width.angle += std::sqrt(std::max(0.0, squared)) / 2;
    if (std::isnan(distance)) width.angle = kNaN;
  }
  return width;
}

HighlightFigures nothing(std::string why) {
  const HalfWidth none{kNaN, kNaN};
  const CosineFit no_fit{kNaN, kNaN, kNaN, kNaN, 0, why};
  return {{{kNaN, kNaN}, kNaN}, {kNaN, kNaN}, kNaN, none, none, no_fit, std::move(why)};
}

}  // namespace

HighlightFigures measure_highlight(const ProfileGeometry& geometry, const Image& image) {
  Field highlight = empty_field(geometry);
  std::vector<LobeSample> samples;
  HighlightFigures figures;
  double sum = 0;
  std::size_t lit = 0, odd = 0;
  for (std::size_t i = 0; i < geometry.angle.size(); ++i) {
    if (std::isnan(geometry.angle[i])) continue;
    ++lit;
    const double radiance = radiance_at(image, i) - geometry.base[i];
    if (!std::isfinite(radiance)) ++odd;
    highlight.values[i] = radiance;
    const double power = radiance * geometry.solid_angle[i];
    figures.energy += power;
    if (!(geometry.angle[i] < geometry.ends.back())) continue;
    samples.push_back({geometry.angle[i], geometry.scale[i], radiance});
    sum += power;
    const FilmPoint place = pixel_centre(highlight, i);
    figures.centroid.x += power * place.x;
    figures.centroid.y += power * place.y;
  }
  if (lit == 0) return nothing("no pixel sees a part of the sphere that the light reaches");
  if (odd > 0) return nothing(fmt::format("{} of its pixels are not finite", odd));
  if (samples.empty())
    return nothing(
        "no pixel's centre lies in the lobe: the highlight is hidden, outside of the picture or "
        "smaller than a pixel");

  figures.centroid = sum > 0 ? FilmPoint{figures.centroid.x / sum, figures.centroid.y / sum}
                             : FilmPoint{kNaN, kNaN};
  figures.peak = locate_peak(highlight);
  figures.along = figures.across = {kNaN, kNaN};
  figures.cosine = fit_cosine_lobe(samples);
  if (figures.peak.found == PeakFound::kNone) {
    figures.why_not = "it is black";
    return figures;
  }
  const std::size_t above =
      region_above(highlight, figures.peak.pixel, highlight.values[figures.peak.pixel] / 2).size();
  if (above < kFewestPixelsOfALobe) {
    figures.why_not =
        fmt::format("not resolved: {} pixels are above half of its peak, {} are needed", above,
                    kFewestPixelsOfALobe);
    return figures;
  }
  const Field squared_angle = squared_angles(geometry);
  const FilmPoint along = geometry.incidence.value_or(FilmPoint{1, 0});
  figures.along = half_width(highlight, squared_angle, figures.peak, along);
  figures.across = half_width(highlight, squared_angle, figures.peak, {-along.y, along.x});
  return figures;
}

}  // namespace lobelia
