// The figures of a highlight in one picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/profile/measure_noise.hpp"
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

/// Of both sides of one axis of the outline.
HalfWidth half_width(const Outline& outline, const Field& squared_angle, FilmPoint along,
                     int axis) {
  HalfWidth width{outline.half_width(axis), 0};
  for (const int k : {2 * axis, 2 * axis + 1}) {
    const FilmPoint outward = outline_direction(along, k), middle = outline.peak.place;
    const double distance = outline.reach[std::size_t(k)];
    const double squared =
        sample(squared_angle, {middle.x + distance * outward.x, middle.y + distance * outward.y});
    width.angle += std::sqrt(std::max(0.0, squared)) / 2;
    if (std::isnan(distance)) width.angle = kNaN;
  }
  return width;
}

/// A highlight and its noise where it is measured.
struct Lit {
  Field highlight;
  std::vector<double> error;        ///< of each pixel
  std::vector<std::size_t> region;  ///< above half of the peak
  Axes rough;
  double noise = 0;  ///< of the peak
};

/// A noisy highlight is looked for in a softened picture. A small one may only look noisy, so unless the noise is given, it
/// is taken as it is.
Lit look_for(Field highlight, const PictureNoise* noise) {
  constexpr int kPasses = 4;
  Lit lit{std::move(highlight), {}, {}, {}, 0};
  if (noise) lit.error = radiance_errors(*noise).values;
  for (const bool first : {true, false}) {
    const Field soft = softened(lit.highlight, first ? kPasses : passes_for(lit.noise));
    const Peak peak = locate_peak(soft);
    if (peak.found == PeakFound::kNone) return lit;
    const double top = soft.values[peak.pixel];
    lit.region = region_above(soft, peak.pixel, top / 2);
    lit.rough = principal_axes(soft, lit.region, 0);
    if (!first) break;
    double scatter = 0;
    if (noise)
      for (const std::size_t i : lit.region) scatter += lit.error[i] / double(lit.region.size());
    else
      scatter = scatter_of(lit.highlight, lit.region);
    lit.noise = scatter / top;
    if (!noise && !is_smoothed(lit.rough, lit.noise)) lit.noise = 0;
  }
  return lit;
}

/// The part of a field around a place.
Field part_around(const Field& field, FilmPoint place, double reach, FilmPoint& corner) {
  const int left = std::clamp(int(place.x - reach), 0, field.width - 1);
  const int top = std::clamp(int(place.y - reach), 0, field.height - 1);
  Field part{std::clamp(int(place.x + reach) + 1, left + 1, field.width) - left,
             std::clamp(int(place.y + reach) + 1, top + 1, field.height) - top,
             {}};
  for (int y = 0; y < part.height; ++y)
    for (int x = 0; x < part.width; ++x) part.values.push_back(field.at(left + x, top + y));
  corner = {double(left), double(top)};
  return part;
}

/// Peak, place and half-widths by noise that is added; energy and centroid are sums, of which the errors are known.
HighlightErrors errors_of(const ProfileGeometry& geometry, const Lit& lit, const Outline& outline,
                          FilmPoint centroid, FilmPoint along, const PictureNoise* noise) {
  HighlightErrors errors;
  errors.noise_is_given = noise != nullptr;
  std::vector<double> error = lit.error;
  if (!noise) error.assign(lit.highlight.values.size(), lit.noise * outline.peak.value);

  double energy = 0, energy_together = 0, power = 0;
  FilmPoint moment, together;
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (std::isnan(geometry.angle[i])) continue;
    const double one = error[i] * geometry.solid_angle[i];
    energy += one * one;
    energy_together += one;
    if (!(geometry.angle[i] < geometry.ends.back())) continue;
    power += lit.highlight.values[i] * geometry.solid_angle[i];
    const FilmPoint place = pixel_centre(lit.highlight, i);
    const double dx = one * (place.x - centroid.x), dy = one * (place.y - centroid.y);
    moment.x += dx * dx;
    moment.y += dy * dy;
    together.x += dx;
    together.y += dy;
  }
  const bool shared = noise && noise->shared;
  const auto worse = [&](double squares, double sum) {
    return std::max(std::sqrt(squares), shared ? std::abs(sum) : 0);
  };
  errors.energy = worse(energy, energy_together);
  errors.centroid = {worse(moment.x, together.x) / power, worse(moment.y, together.y) / power};

  FilmPoint corner;
  constexpr double kReach = 3;  // of the long semi-axis: more than any half-width
  const double reach = kReach * 2 * lit.rough.major_sigma + 3;
  const Field part = part_around(lit.highlight, lit.rough.centre, reach, corner);
  PixelNoise pixels;
  pixels.shared = shared;
  pixels.error = part_around({lit.highlight.width, lit.highlight.height, error}, lit.rough.centre,
                             reach, corner)
                     .values;
  Axes rough = lit.rough;
  rough.centre = {rough.centre.x - corner.x, rough.centre.y - corner.y};
  const std::vector<double> spread =
      bootstrap_errors(part, pixels, 5, 0, [&](const Field& noisy, std::span<double> values) {
        const Outline one = trace_outline(noisy, rough, along, lit.noise, locate_peak(noisy).pixel);
        const double all[] = {one.peak.value, one.peak.place.x, one.peak.place.y, one.half_width(0),
                              one.half_width(1)};
        std::ranges::copy(all, values.begin());
      });
  errors.peak = spread[0];
  errors.place = {spread[1], spread[2]};
  errors.along = spread[3];
  errors.across = spread[4];
  return errors;
}

/// The angle that clipped pixels of the highlight reach to, or -1. Near it noise decides which pixels are clipped, and to fit
/// the others would favour dark ones; so none up to it is fitted.
double clipped_to(const ProfileGeometry& geometry, const Lit& lit,
                  const std::vector<bool>& clipped) {
  double angle = -1;
  for (const std::size_t i : lit.region)
    if (!clipped.empty() && clipped[i]) angle = std::max(angle, geometry.angle[i]);
  return angle;
}

/// The pixels within three half-widths, so that those count that the picture shows and not those of the scene's lobe.
std::vector<SeenLobe> seen_lobes(const ProfileGeometry& geometry, const Lit& lit,
                                 const HighlightFigures& figures, const PictureFacts& facts) {
  constexpr double kReach = 3;
  const double half_width = (figures.along.angle + figures.across.angle) / 2;
  const double end = half_width > 0 ? kReach * half_width : geometry.ends.back();
  const double cap = clipped_to(geometry, lit, facts.clipped);
  // A very large highlight has pixels enough in every second or third line and column.
  constexpr double kMostPixels = 250'000;
  const auto within = std::ranges::count_if(geometry.angle, [&](double x) { return x < end; });
  const auto step = std::max<std::size_t>(1, std::size_t(std::sqrt(double(within) / kMostPixels)));
  const auto width = std::size_t(geometry.width);
  std::vector<SeenLobe> seen;
  for (std::size_t i = 0; i < geometry.angle.size(); ++i) {
    const std::size_t x = i % width / step, y = i / width / step;
    if (!(geometry.angle[i] < end) || i % width != x * step || i / width != y * step) continue;
    const bool is_clipped = !facts.clipped.empty() && facts.clipped[i];
    seen.push_back({geometry.lobes->reflection[i], geometry.lobes->half_vector[i],
                    geometry.lobes->n_dot_l[i], geometry.lobes->n_dot_v[i],
                    geometry.lobes->irradiance[i], lit.highlight.values[i],
                    facts.noise ? lit.error[i] : kNaN, int(x), int(y),
                    !is_clipped && geometry.angle[i] > cap});
  }
  return seen;
}

HighlightFigures nothing(std::string why) {
  const HalfWidth none{kNaN, kNaN};
  const LobeFit no_fit{kNaN, kNaN, kNaN, kNaN, 0, why};
  return {{{kNaN, kNaN}, kNaN}, {kNaN, kNaN}, kNaN, none, none, no_fit, std::move(why), {}, {}};
}

}  // namespace

HighlightFigures measure_highlight(const ProfileGeometry& geometry, const Image& image,
                                   const PictureFacts& facts) {
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
    samples.push_back({geometry.angle[i], geometry.scale[i], radiance,
                       facts.clipped.empty() || !facts.clipped[i]});
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
  figures.along = figures.across = {kNaN, kNaN};
  figures.cosine = fit_cosine_lobe(samples);
  const Lit found = look_for(std::move(highlight), facts.noise);
  if (found.region.empty()) {
    figures.peak = {{kNaN, kNaN}, kNaN};
    figures.why_not = "it is black";
    return figures;
  }
  const FilmPoint along = geometry.incidence.value_or(FilmPoint{1, 0});
  const Outline outline = trace_outline(found.highlight, found.rough, along, found.noise,
                                        locate_peak(found.highlight).pixel);
  figures.peak = outline.peak;
  if (found.region.size() < kFewestPixelsOfALobe) {
    figures.why_not =
        fmt::format("not resolved: {} pixels are above half of its peak, {} are needed",
                    found.region.size(), kFewestPixelsOfALobe);
    return figures;
  }
  const Field squared_angle = squared_angles(geometry);
  figures.along = half_width(outline, squared_angle, along, 0);
  figures.across = half_width(outline, squared_angle, along, 1);
  if (facts.thorough && geometry.lobes) {
    figures.errors = errors_of(geometry, found, outline, figures.centroid, along, facts.noise);
    figures.explanations = explain_highlight(seen_lobes(geometry, found, figures, facts),
                                             facts.noise && facts.noise->shared);
  }
  return figures;
}

}  // namespace lobelia
