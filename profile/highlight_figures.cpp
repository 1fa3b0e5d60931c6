// The figures of a highlight in one picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words/constants.hpp"
#include "profile/measure_noise.hpp"
#include "profile/profile.hpp"

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

/// The mean over both sides of one axis of the outline.
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
records::HighlightErrors errors_of(const ProfileGeometry& geometry, const Lit& lit,
                                   const Outline& outline, FilmPoint centroid, FilmPoint along,
                                   const PictureFacts& facts) {
  const PictureNoise* const noise = facts.noise;
  records::HighlightErrors errors;
  errors.source = noise_source(noise != nullptr);
  std::vector<double> error = lit.error;
  if (!noise) error.assign(lit.highlight.values.size(), lit.noise * outline.peak.value);
  for (std::size_t i = 0; i < facts.rounding.size(); ++i)
    error[i] = std::hypot(error[i], facts.rounding[i]);

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
  errors.half_width_along_pixels = spread[3];
  errors.half_width_across_pixels = spread[4];
  return errors;
}

/// The angle that clipped pixels of the highlight reach to, or -1. Near it noise decides which pixels are clipped, and to
/// fit the others would favour dark ones; so none up to it is fitted.
double clipped_to(const ProfileGeometry& geometry, const Lit& lit,
                  const std::vector<bool>& clipped) {
  double angle = -1;
  for (const std::size_t i : lit.region)
    if (!clipped.empty() && clipped[i]) angle = std::max(angle, geometry.angle[i]);
  return angle;
}

/// Every how many lines and columns are enough for a fit of so many pixels. Means take longer, one for each of their places.
std::size_t step_for(double pixels, const ProfileGeometry& geometry) {
  constexpr double kMostPixels = 250'000, kMostNodes = 600'000;
  const double most = geometry.pixels == PixelsShow::kCentres
                          ? kMostPixels
                          : kMostNodes / double(geometry.nodes_per_pixel);
  return std::max<std::size_t>(1, std::size_t(std::ceil(std::sqrt(pixels / most))));
}

/// Pixels of a highlight, with the places of those that are means.
struct SeenPixels {
  std::vector<SeenLobe> pixels;
  std::vector<PixelMean> means;
};

/// The pixels within three half-widths, so that those count that the picture shows and not those of the scene's lobe.
SeenPixels seen_lobes(const ProfileGeometry& geometry, const Lit& lit,
                      const HighlightFigures& figures, const PictureFacts& facts) {
  constexpr double kReach = 3;
  const double half_width = (figures.along.angle + figures.across.angle) / 2;
  const double end = half_width > 0 ? kReach * half_width : geometry.ends.back();
  const double cap = clipped_to(geometry, lit, facts.clipped);
  const auto within = std::ranges::count_if(geometry.angle, [&](double x) { return x < end; });
  const std::size_t step = step_for(double(within), geometry);
  const auto width = std::size_t(geometry.width);
  SeenPixels seen;
  for (std::size_t i = 0; i < geometry.angle.size(); ++i) {
    const std::size_t x = i % width / step, y = i / width / step;
    if (!(geometry.angle[i] < end) || i % width != x * step || i / width != y * step) continue;
    const bool is_clipped = !facts.clipped.empty() && facts.clipped[i];
    seen.pixels.push_back({geometry.lobes->reflection[i],
                           geometry.lobes->half_vector[i],
                           geometry.lobes->n_dot_l[i],
                           geometry.lobes->n_dot_v[i],
                           geometry.lobes->irradiance[i],
                           lit.highlight.values[i],
                           facts.noise ? lit.error[i] : kNaN,
                           facts.rounding.empty() ? 0 : facts.rounding[i],
                           int(x),
                           int(y),
                           !is_clipped && geometry.angle[i] > cap,
                           {},
                           0});
    if (geometry.pixels != PixelsShow::kCentres) seen.means.push_back(geometry.mean(i));
  }
  for (std::size_t k = 0; k < seen.means.size(); ++k) {
    seen.pixels[k].nodes = seen.means[k].nodes;
    seen.pixels[k].more_beneath = seen.means[k].more_beneath;
  }
  return seen;
}

/// The scene's lobe down to the end of its blooming zone.
LobeFit fit_cosine(const ProfileGeometry& geometry, const Field& highlight,
                   const PictureFacts& facts, bool means) {
  const auto within =
      std::ranges::count_if(geometry.angle, [&](double x) { return x < geometry.ends.back(); });
  const std::size_t step = means ? step_for(double(within), geometry) : 1;
  const auto width = std::size_t(geometry.width);
  std::vector<LobeSample> samples;
  std::vector<PixelMean> places;
  for (std::size_t i = 0; i < geometry.angle.size(); ++i) {
    if (!(geometry.angle[i] < geometry.ends.back()) || i % width % step != 0 ||
        i / width % step != 0)
      continue;
    LobeSample& sample =
        samples.emplace_back(LobeSample{geometry.angle[i], geometry.scale[i], highlight.values[i],
                                        facts.clipped.empty() || !facts.clipped[i]});
    if (!means) continue;
    const PixelMean& place = places.emplace_back(geometry.mean(i));
    sample.is_known = sample.is_known && !place.nodes.empty();
    sample.radiance -= place.more_beneath;
  }
  for (std::size_t k = 0; k < places.size(); ++k) samples[k].nodes = places[k].of_lobe;
  return fit_cosine_lobe(samples);
}

/// A sentence if the highlight is not where the scene has it. A lobe about the scene's middle fits its tail, or what is
/// between both places, but not this highlight.
std::string why_elsewhere(const ProfileGeometry& geometry, const HighlightFigures& figures,
                          const Field& squared_angle, double noise) {
  if (figures.explanations.empty() || !figures.explanations.front().fit.why_not.empty()) return "";
  const double pixels = (figures.along.pixels + figures.across.pixels) / 2;
  const double angle = (figures.along.angle + figures.across.angle) / 2;
  const double away = distance(figures.peak.place, geometry.middle);
  // The cosine of the light moves a peak by less, and so does a texture.
  constexpr double kAway = 0.75, kMisfit = 0.03, kOfNoise = 1.2;
  const double misfit = figures.explanations.front().fit.residual;
  if (!(away > kAway * pixels) || !(misfit > std::max(kMisfit, kOfNoise * noise))) return "";
  // The lobe's own angle there, unless the scene's peak is not at the angle 0.
  const double at_middle = std::sqrt(std::max(0.0, sample(squared_angle, geometry.middle)));
  const double there = std::sqrt(std::max(0.0, sample(squared_angle, figures.peak.place)));
  const double off = there > 10 * at_middle ? there : away * angle / pixels;
  return fmt::format(
      "the highlight is not where the scene has it: its peak is {:.2g} degrees off, at ({:.1f}, "
      "{:.1f}) and not at ({:.1f}, {:.1f})",
      off * 180 / kPi, figures.peak.place.x, figures.peak.place.y, geometry.middle.x,
      geometry.middle.y);
}

HighlightFigures nothing(std::string why) {
  const HalfWidth none{kNaN, kNaN};
  const LobeFit no_fit{kNaN, kNaN, kNaN, kNaN, 0, why};
  return {{{kNaN, kNaN}, kNaN},
          {kNaN, kNaN},
          kNaN,
          none,
          none,
          no_fit,
          std::move(why),
          {},
          PixelsShow::kCentres,
          {}};
}

}  // namespace

HighlightFigures measure_highlight(const ProfileGeometry& geometry, const Image& image,
                                   const PictureFacts& facts) {
  Field highlight = empty_field(geometry);
  HighlightFigures figures;
  double sum = 0;
  std::size_t lit = 0, odd = 0, in_lobe = 0;
  for (std::size_t i = 0; i < geometry.angle.size(); ++i) {
    if (std::isnan(geometry.angle[i])) continue;
    ++lit;
    const double radiance = radiance_at(image, i) - geometry.base[i];
    if (!std::isfinite(radiance)) ++odd;
    highlight.values[i] = radiance;
    const double power = radiance * geometry.solid_angle[i];
    figures.energy += power;
    if (!(geometry.angle[i] < geometry.ends.back())) continue;
    ++in_lobe;
    sum += power;
    const FilmPoint place = pixel_centre(highlight, i);
    figures.centroid.x += power * place.x;
    figures.centroid.y += power * place.y;
  }
  if (lit == 0) return nothing("no pixel sees a part of the sphere that the light reaches");
  if (odd > 0) return nothing(fmt::format("{} of its pixels are not finite", odd));
  if (in_lobe == 0)
    return nothing(
        "no pixel's centre lies in the lobe: the highlight is hidden, outside of the picture or "
        "smaller than a pixel");

  figures.centroid = sum > 0 ? FilmPoint{figures.centroid.x / sum, figures.centroid.y / sum}
                             : FilmPoint{kNaN, kNaN};
  figures.along = figures.across = {kNaN, kNaN};
  figures.cosine = fit_cosine(geometry, highlight, facts, geometry.pixels == PixelsShow::kMeans);
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
    figures.errors = errors_of(geometry, found, outline, figures.centroid, along, facts);
    const SeenPixels seen = seen_lobes(geometry, found, figures, facts);
    Explanation explanation =
        explain_highlight(seen.pixels, facts.noise && facts.noise->shared, geometry.pixels);
    figures.explanations = std::move(explanation.families);
    figures.pixels = explanation.pixels;
    if (std::string why = why_elsewhere(geometry, figures, squared_angle, found.noise);
        !why.empty()) {
      for (FamilyFit& one : figures.explanations)
        one = {one.family, false, {kNaN, kNaN, kNaN, kNaN, one.fit.pixels, why}, kNaN, kNaN};
      figures.cosine = {kNaN, kNaN, kNaN, kNaN, figures.cosine.pixels, std::move(why)};
    } else if (geometry.pixels == PixelsShow::kUnknown && figures.pixels == PixelsShow::kMeans) {
      figures.cosine = fit_cosine(geometry, found.highlight, facts, true);
    }
  }
  return figures;
}

}  // namespace lobelia
