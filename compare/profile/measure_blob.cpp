#include "compare/profile/measure_blob.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "compare/profile/clipping.hpp"
#include "compare/profile/measure_noise.hpp"
#include "compare/profile/outline.hpp"
#include "core/constants.hpp"

namespace lobelia {
namespace {

constexpr double kEnergyReach = 3, kFalloffReach = 3, kFlankReach = 2.5;  // half-widths
// 2 sigma of the pixels above half of a Gaussian, weighted by their height, over its half-width.
constexpr double kSemiAxis = 0.941;

/// A part of a picture around a blob, in its own coordinates.
class Patch {
 public:
  Patch(const Field& field, FilmPoint centre, double reach)
      : picture_width_(field.width),
        left_(std::clamp(int(centre.x - reach), 0, field.width - 1)),
        top_(std::clamp(int(centre.y - reach), 0, field.height - 1)),
        width_(std::clamp(int(centre.x + reach) + 1, left_ + 1, field.width) - left_),
        height_(std::clamp(int(centre.y + reach) + 1, top_ + 1, field.height) - top_) {}

  std::size_t picture_index(std::size_t index) const {
    return (index / std::size_t(width_) + std::size_t(top_)) * std::size_t(picture_width_) +
           index % std::size_t(width_) + std::size_t(left_);
  }
  /// Those of the pixels that are in the patch.
  std::vector<std::size_t> indices(const std::vector<std::size_t>& picture) const {
    std::vector<std::size_t> result;
    for (const std::size_t i : picture) {
      const int x = int(i % std::size_t(picture_width_)) - left_;
      const int y = int(i / std::size_t(picture_width_)) - top_;
      if (x >= 0 && y >= 0 && x < width_ && y < height_)
        result.push_back(std::size_t(y) * std::size_t(width_) + std::size_t(x));
    }
    return result;
  }
  FilmPoint to_picture(FilmPoint place) const { return {place.x + left_, place.y + top_}; }
  FilmPoint from_picture(FilmPoint place) const { return {place.x - left_, place.y - top_}; }
  /// A field of value(index in the picture).
  template <class Value>
  Field field(Value value) const {
    Field result{width_, height_, std::vector<double>(std::size_t(width_) * std::size_t(height_))};
    for (std::size_t i = 0; i < result.values.size(); ++i)
      result.values[i] = value(picture_index(i));
    return result;
  }

 private:
  int picture_width_, left_, top_, width_, height_;
};

/// How a blob is measured in its patch, again and again with other noise.
struct Measurement {
  std::vector<std::size_t> region, ring;  ///< of the patch
  Axes rough;
  double noise = 0;  ///< of the peak

  struct Result {
    double shift = 0;  ///< of the background
    Outline outline;
    Axes axes;
    std::size_t pixels = 0;
    double energy = 0;
  };
  Result measure(Field above) const {
    Result result;
    if (!ring.empty()) {
      std::vector<double> values;
      for (const std::size_t i : ring) values.push_back(above.values[i]);
      result.shift = median(std::move(values));
      for (double& value : above.values) value -= result.shift;
    }
    const std::size_t brightest =
        *std::ranges::max_element(region, {}, [&](std::size_t i) { return above.values[i]; });
    result.axes = rough;
    result.pixels = region.size();
    if (!is_smoothed(rough, noise) && above.values[brightest] > 0) {
      const auto half = region_above(above, brightest, above.values[brightest] / 2);
      result.axes = principal_axes(above, half, 0);
      result.pixels = half.size();
    }
    result.outline = trace_outline(above, result.axes, result.axes.major, noise, brightest);
    if (is_smoothed(rough, noise)) result.axes.centre = centroid(above, result);
    const double half_width = result.outline.half_width(0);
    const double reach = kEnergyReach * std::max(1.0, half_width > 0 ? kSemiAxis * half_width
                                                                     : 2 * rough.major_sigma);
    for (std::size_t i = 0; i < above.values.size(); ++i)
      if (distance(pixel_centre(above, i), result.axes.centre) < reach &&
          !std::isnan(above.values[i]))
        result.energy += above.values[i];
    return result;
  }

 private:
  /// Of the ellipse of the half-widths: which pixels of noise are above half would move it.
  FilmPoint centroid(const Field& above, const Result& result) const {
    const FilmPoint middle = result.outline.peak.place, major = rough.major;
    const double a = result.outline.half_width(0), b = result.outline.half_width(1);
    double sum = 0;
    FilmPoint centre;
    for (std::size_t i = 0; i < above.values.size(); ++i) {
      const FilmPoint place = pixel_centre(above, i);
      const double dx = place.x - middle.x, dy = place.y - middle.y;
      const double u = (major.x * dx + major.y * dy) / a, v = (-major.y * dx + major.x * dy) / b;
      if (!(u * u + v * v <= 1) || std::isnan(above.values[i])) continue;
      sum += above.values[i];
      centre.x += above.values[i] * place.x;
      centre.y += above.values[i] * place.y;
    }
    return sum > 0 ? FilmPoint{centre.x / sum, centre.y / sum} : rough.centre;
  }
};

double root_mean_square(const std::vector<double>& values, const std::vector<std::size_t>& at) {
  double sum = 0;
  for (const std::size_t i : at) sum += values[i] * values[i];
  return at.empty() ? 0 : std::sqrt(sum / double(at.size()));
}

/// Errors of the pixels by their own scatter, in the ring and in the blob. Between them the variance grows with the square of
/// the height, as that of light does from few samples.
std::vector<double> errors_by_scatter(const Field& above, const Measurement& how, double height) {
  double base = scatter_of(above, how.ring);
  double inside = scatter_of(above, how.region);
  if (std::isnan(base)) base = std::isnan(inside) ? 0 : inside;
  if (std::isnan(inside)) inside = base;
  constexpr int kPasses = 2;
  const Field soft = softened(above, kPasses);
  const auto square = [&](std::size_t i) {
    const double share = std::clamp(soft.values[i] / height, 0.0, 1.0);
    return share * share;
  };
  double mean = 0;
  for (const std::size_t i : how.region) mean += square(i) / double(how.region.size());
  const double more = mean > 0 ? std::max(0.0, inside * inside - base * base) / mean : 0;
  std::vector<double> errors;
  for (std::size_t i = 0; i < above.values.size(); ++i)
    errors.push_back(std::isnan(soft.values[i]) ? base : std::sqrt(base * base + more * square(i)));
  return errors;
}

/// How far parts of the ring are apart beyond their noise: the tail of a lobe, or shading that is no plane.
double unevenness(const Field& above, const std::vector<std::size_t>& ring, FilmPoint middle,
                  double semi_axis, double of_pixels) {
  constexpr int kRadial = 3, kAngular = 8;
  std::array<std::vector<double>, kRadial * kAngular> parts;
  for (const std::size_t i : ring) {
    const FilmPoint place = pixel_centre(above, i);
    const double out = (distance(place, middle) / semi_axis - kRingFrom) / (kRingTo - kRingFrom);
    const double turn = std::atan2(place.y - middle.y, place.x - middle.x) / (2 * kPi) + 0.5;
    const int radial = std::clamp(int(kRadial * out), 0, kRadial - 1);
    const int angular = std::clamp(int(kAngular * turn), 0, kAngular - 1);
    parts[std::size_t(radial * kAngular + angular)].push_back(above.values[i]);
  }
  // The error of a median, and how much a spread of so few of them is wrong by.
  constexpr double kOfMedian = 1.2533, kBeyondChance = 2;
  double sum = 0, squares = 0, expected = 0;
  int count = 0;
  for (std::vector<double>& part : parts) {
    if (part.size() < 4) continue;
    expected += kOfMedian * kOfMedian * of_pixels * of_pixels / double(part.size());
    const double middle_of_part = median(std::move(part));
    sum += middle_of_part;
    squares += middle_of_part * middle_of_part;
    ++count;
  }
  if (count < 4) return 0;
  const double variance = (squares - sum * sum / count) / (count - 1);
  expected /= count;
  // The median of all parts is nearer to each than they are to each other.
  return variance > kBeyondChance * expected ? std::sqrt(variance - expected) / 2 : 0;
}

/// Sets what the ring has beyond the noise of its pixels.
void add_texture(PixelNoise& noise, const Field& above, const Measurement& how, double semi_axis,
                 double spread) {
  const double of_pixels = root_mean_square(noise.error, how.ring);
  noise.ring = how.ring;
  noise.level = unevenness(above, how.ring, how.rough.centre, semi_axis, of_pixels);
  // Twice the noise's variance is more than the spread of a ring is wrong by.
  if (how.ring.empty() || !(spread * spread > 2 * of_pixels * of_pixels)) return;
  noise.texture = std::sqrt(spread * spread - of_pixels * of_pixels);
  std::vector<bool> inside(above.values.size(), false);
  for (const std::size_t i : how.ring) inside[i] = true;
  const auto residual = [&](std::size_t i) {
    return std::clamp(above.values[i], -3 * spread, 3 * spread);
  };
  int lag = 1;
  for (; 2 * lag < std::min(above.width, above.height); lag *= 2) {
    double sum = 0, squares = 0;
    for (const std::size_t i : how.ring)
      for (const std::size_t other : {i + std::size_t(lag), i + std::size_t(lag * above.width)}) {
        if (other >= inside.size() || !inside[other]) continue;
        sum += residual(i) * residual(other);
        squares += residual(i) * residual(i);
      }
    if (!(sum > squares / 2)) break;
  }
  // Squares of one value hold half together at half of their side.
  noise.grain = 2 * lag;
}

std::array<double, 3> colour_of(const BlobSource& source, const Patch& patch, const Field& above,
                                const Measurement& how, const std::vector<bool>& clipped,
                                double radius) {
  const auto values = source.image->values();
  std::array<double, 3> colour{}, base{};
  for (std::size_t c = 0; c < 3 && !how.ring.empty(); ++c) {
    std::vector<double> around;
    for (const std::size_t i : how.ring)
      around.push_back(double(values[3 * patch.picture_index(i) + c]));
    base[c] = median(std::move(around));
  }
  for (std::size_t i = 0; i < above.values.size(); ++i) {
    const double weight = above.values[i];
    if (clipped[i] || !(weight > 0) || distance(pixel_centre(above, i), how.rough.centre) > radius)
      continue;
    for (std::size_t c = 0; c < 3; ++c)
      colour[c] += weight * (double(values[3 * patch.picture_index(i) + c]) - base[c]);
  }
  const double largest = std::ranges::max(colour);
  for (double& one : colour) one = largest > 0 ? one / largest : kNaN;
  return colour;
}

std::string remark_on(const BlobFigures& blob, const std::vector<std::size_t>& region, int width,
                      const PixelWindow& film) {
  if (blob.pixels < kFewestPixelsOfALobe)
    return fmt::format("not resolved: {} pixels are above half of the peak, {} are needed",
                       blob.pixels, kFewestPixelsOfALobe);
  if (blob.clipped)
    return fmt::format("clipped: {} of its pixels have the picture's largest {}",
                       blob.clipped->pixels, either_of(blob.clipped->channels));
  if (blob.peak.found == PeakFound::kPlateau)
    return "many pixels have exactly the largest value: it is clipped, or flat";
  for (const std::size_t i : region) {
    const int x = int(i % std::size_t(width)) - film.x, y = int(i / std::size_t(width)) - film.y;
    if (x == 0 || y == 0 || x == film.width - 1 || y == film.height - 1)
      return film.width == width ? "it is cut by the border of the picture"
                                 : "it is cut by the border of the picture or of the region";
  }
  return "";
}

}  // namespace

BlobFigures no_blob(std::string why) {
  BlobFigures figures;
  figures.peak = {{kNaN, kNaN}, kNaN};
  figures.axes = {{kNaN, kNaN}, {kNaN, kNaN}, kNaN, kNaN};
  figures.background = figures.energy = kNaN;
  figures.major_half_width = figures.minor_half_width = kNaN;
  figures.why_not = std::move(why);
  return figures;
}

BlobFigures measure_blob(const BlobSource& source, const FoundBlob& blob, std::uint64_t seed) {
  const Field& field = source.found->field;
  const auto semi_axis_of = [](const Axes& axes) { return std::max(1.0, 2 * axes.major_sigma); };
  Measurement how;
  how.rough = blob.axes;
  BlobBackground background;
  Measurement::Result result;
  // A second time from the half-widths: the first axes of a noisy blob are those of a softened picture.
  std::optional<Patch> patch;
  Field above;
  PixelNoise noise;
  noise.shared = source.shared;
  double semi_axis = 0;
  for (int round = 0; round < 2; ++round) {
    semi_axis = semi_axis_of(how.rough);
    if (auto around = background_around(field, how.rough.centre, semi_axis))
      background = std::move(*around);
    else
      background = {how.rough.centre, blob.background, {}, 0, {}};
    patch.emplace(field, how.rough.centre, kRingTo * semi_axis + 2);
    above = patch->field(
        [&](std::size_t i) { return field.values[i] - background.at(pixel_centre(field, i)); });
    how.region = patch->indices(blob.region);
    how.ring = patch->indices(background.ring);
    how.rough.centre = patch->from_picture(how.rough.centre);
    if (how.region.empty()) how.region = patch->indices({blob.region.front()});
    noise.error = source.error
                      ? patch->field([&](std::size_t i) { return source.error->values[i]; }).values
                      : errors_by_scatter(above, how, blob.height);
    how.noise = root_mean_square(noise.error, how.region) / blob.height;
    result = how.measure(above);
    const double major = result.outline.half_width(0), minor = result.outline.half_width(1);
    if (round == 1 || !(major > 0 && minor > 0) || result.outline.peak.found != PeakFound::kFitted)
      break;
    how.rough.centre = patch->to_picture(result.outline.peak.place);
    how.rough.major_sigma = kSemiAxis * major / 2;
    how.rough.minor_sigma = kSemiAxis * minor / 2;
    if (minor > major) {
      std::swap(how.rough.major_sigma, how.rough.minor_sigma);
      how.rough.major = {how.rough.major.y, -how.rough.major.x};
      if (how.rough.major.x < 0) how.rough.major = {-how.rough.major.x, -how.rough.major.y};
    }
  }
  add_texture(noise, above, how, semi_axis, background.spread);

  BlobFigures figures;
  figures.noise = how.noise;
  figures.background = background.at(patch->to_picture(result.outline.peak.place)) + result.shift;
  figures.peak = result.outline.peak;
  figures.peak.place = patch->to_picture(figures.peak.place);
  figures.peak.pixel = patch->picture_index(figures.peak.pixel);
  figures.pixels = result.pixels;
  figures.axes = result.axes;
  figures.axes.centre = patch->to_picture(result.axes.centre);
  const bool resolved = figures.pixels >= kFewestPixelsOfALobe;
  figures.major_half_width = resolved ? result.outline.half_width(0) : kNaN;
  figures.minor_half_width = resolved ? result.outline.half_width(1) : kNaN;
  figures.energy = result.energy;

  const std::vector<double> errors =
      bootstrap_errors(above, noise, 9, seed, [&](const Field& noisy, std::span<double> values) {
        const Measurement::Result one = how.measure(noisy);
        const double all[] = {one.shift,
                              one.outline.peak.value,
                              one.outline.peak.place.x,
                              one.outline.peak.place.y,
                              one.axes.centre.x,
                              one.axes.centre.y,
                              one.outline.half_width(0),
                              one.outline.half_width(1),
                              one.energy};
        std::ranges::copy(all, values.begin());
      });
  figures.errors = {how.ring.empty() ? kNaN : errors[0],
                    errors[1],
                    errors[8],
                    {errors[2], errors[3]},
                    {errors[4], errors[5]},
                    resolved ? errors[6] : kNaN,
                    resolved ? errors[7] : kNaN};

  const ClippedChannels channels = find_clipping(*source.image, source.largest, blob.region);
  std::vector<bool> clipped(above.values.size());
  for (std::size_t i = 0; i < clipped.size(); ++i)
    clipped[i] = channels.holds(*source.image, patch->picture_index(i));
  if (const std::string names = channels.names(); !names.empty()) {
    const auto pixels = std::ranges::count_if(
        blob.region, [&](std::size_t i) { return channels.holds(*source.image, i); });
    Clipping clipping{std::size_t(pixels), names,
                      fit_falloff(above, result.axes, kFlankReach, clipped, noise.error).front()};
    figures.major_half_width = clipping.flank.major_half_width.value;
    figures.minor_half_width = clipping.flank.minor_half_width.value;
    figures.errors.major_half_width = clipping.flank.major_half_width.error;
    figures.errors.minor_half_width = clipping.flank.minor_half_width.error;
    figures.clipped = std::move(clipping);
  } else if (resolved) {
    figures.falloff = fit_falloff(above, result.axes, kFalloffReach, clipped, noise.error);
  }
  figures.colour = colour_of(source, *patch, above, how, clipped, 1.5 * semi_axis_of(how.rough));
  figures.remark = remark_on(figures, blob.region, field.width, source.film);
  return figures;
}

}  // namespace lobelia
