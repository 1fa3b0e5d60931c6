#include "profile/measure_blob.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words/constants.hpp"
#include "profile/blob_measurement.hpp"
#include "profile/clipping.hpp"
#include "profile/measure_noise.hpp"

namespace lobelia {
namespace {

constexpr double kFalloffReach = 3, kFlankReach = 2.5;  // half-widths

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

double root_mean_square(const std::vector<double>& values, const std::vector<std::size_t>& at) {
  double sum = 0;
  for (const std::size_t i : at) sum += values[i] * values[i];
  return at.empty() ? 0 : std::sqrt(sum / double(at.size()));
}

/// Errors of the pixels by their own scatter, in the ring, on the flank and in the blob. Between them the variance is linear
/// in the height: that of light from few samples grows with it, or with its square.
std::vector<double> errors_by_scatter(const Field& above, const BlobMeasurement& how,
                                      double height) {
  constexpr int kPasses = 2;
  constexpr double kFlankFrom = 0.08, kFlankTo = 0.4;
  const Field soft = softened(above, kPasses);
  const auto share = [&](std::size_t i) { return std::clamp(soft.values[i] / height, 0.0, 1.0); };
  std::vector<std::size_t> flank;
  for (std::size_t i = 0; i < above.values.size(); ++i)
    if (share(i) > kFlankFrom && share(i) < kFlankTo &&
        distance(pixel_centre(above, i), how.rough.centre) < kRingFrom * 2 * how.rough.major_sigma)
      flank.push_back(i);
  struct Level {
    double share, variance;
  };
  std::vector<Level> levels;
  for (const std::vector<std::size_t>* part : {&how.ring, &std::as_const(flank), &how.region}) {
    const double scatter = scatter_of(above, *part);
    if (std::isnan(scatter)) continue;
    double mean = 0;
    for (const std::size_t i : *part) mean += share(i) / double(part->size());
    // The scatter of so many pixels is uncertain itself, and seven of them share each difference.
    const double upper = scatter * (1 + 1 / std::sqrt(double(part->size())));
    levels.push_back({part == &how.ring ? 0 : mean, upper * upper});
  }
  const auto variance = [&](double at) {
    if (levels.empty()) return 0.0;
    if (levels.size() == 1) return levels.front().variance;
    const std::size_t last = levels.size() - 1;
    const std::size_t k = last > 1 && at > levels[1].share ? 1 : 0;
    const Level &base = levels.front(), &low = levels[k], &high = levels[k + 1];
    // Beyond the mean of the brightest part as it does where noise is a share of the value.
    if (at > levels[last].share)
      return base.variance + std::max(0.0, levels[last].variance - base.variance) *
                                 std::pow(at / levels[last].share, 2);
    const double slope =
        high.share > low.share ? (high.variance - low.variance) / (high.share - low.share) : 0;
    return std::max(low.variance + slope * (at - low.share), std::min(low.variance, high.variance));
  };
  std::vector<double> errors;
  for (std::size_t i = 0; i < above.values.size(); ++i)
    errors.push_back(std::sqrt(variance(std::isnan(soft.values[i]) ? 0 : share(i))));
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

/// How far the mean of a ring, without what is far off, is from its median: noise of few samples has a long tail.
double skewness(const Field& above, const std::vector<std::size_t>& ring) {
  if (ring.empty()) return 0;
  std::vector<double> values, deviations;
  for (const std::size_t i : ring) values.push_back(above.values[i]);
  const double middle = median(values);
  for (const double value : values) deviations.push_back(std::abs(value - middle));
  constexpr double kFar = 7;
  const double end = kFar * median(std::move(deviations));
  double sum = 0;
  std::size_t count = 0;
  for (const double value : values) {
    if (std::abs(value - middle) > end) continue;
    sum += value - middle;
    ++count;
  }
  return count > 0 ? std::abs(sum / double(count)) : 0;
}

/// Sets what the ring has beyond the noise of its pixels.
void add_texture(PixelNoise& noise, const Field& above, const BlobMeasurement& how,
                 double semi_axis, double spread) {
  const double of_pixels = root_mean_square(noise.error, how.ring);
  noise.ring = how.ring;
  noise.level = std::hypot(unevenness(above, how.ring, how.rough.centre, semi_axis, of_pixels),
                           skewness(above, how.ring));
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

/// Adds the rounding of the file's numbers. Noise of more than half a step spreads it over the pixels of the ring; with less
/// they are all rounded to the same side.
void add_rounding(PixelNoise& noise, const BlobSource& source, const Patch& patch,
                  double background) {
  const double step = source.steps.at(background);
  const double of_pixels = root_mean_square(noise.error, noise.ring);
  if (of_pixels < step / 2) noise.level = std::hypot(noise.level, step / std::sqrt(12.0));
  for (std::size_t i = 0; i < noise.error.size(); ++i)
    noise.error[i] =
        std::hypot(noise.error[i], source.steps.rounding(*source.image, patch.picture_index(i)));
}

std::array<double, 3> colour_of(const BlobSource& source, const Patch& patch, const Field& above,
                                const BlobMeasurement& how, const std::vector<bool>& clipped,
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
  BlobMeasurement how;
  how.rough = blob.axes;
  BlobBackground background;
  BlobMeasurement::Result result;
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
  add_rounding(noise, source, *patch, background.value);

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

  const ClippedChannels channels =
      find_clipping(*source.image, source.largest, source.steps, blob.region);
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
    figures.clipped = std::move(clipping);
  } else if (resolved) {
    figures.falloff = fit_falloff(above, result.axes, kFalloffReach, clipped, noise.error);
  }
  std::vector<double> errors =
      bootstrap_errors(above, noise, BlobMeasurement::Result::kFigures, seed,
                       [&](const Field& noisy, std::span<double> values) {
                         std::ranges::copy(how.measure(noisy).figures(), values.begin());
                       });
  if (!figures.falloff.empty() && figures.falloff.front().why_not.empty()) {
    const auto of_method = how.method_errors(figures.falloff.front(), above, semi_axis);
    for (std::size_t k = 0; k < errors.size(); ++k)
      if (!std::isnan(of_method[k])) errors[k] = std::hypot(errors[k], of_method[k]);
  }
  figures.errors = {how.ring.empty() ? kNaN : errors[0],
                    errors[1],
                    errors[8],
                    {errors[2], errors[3]},
                    {errors[4], errors[5]},
                    {resolved ? errors[6] : kNaN, resolved ? errors[7] : kNaN}};
  if (figures.clipped) {
    const FalloffFit& flank = figures.clipped->flank;
    figures.errors.half_width_pixels = {flank.major_half_width.standard_error,
                                        flank.minor_half_width.standard_error};
  }
  figures.colour = colour_of(source, *patch, above, how, clipped, 1.5 * semi_axis_of(how.rough));
  figures.remark = remark_on(figures, blob.region, field.width, source.film);
  return figures;
}

}  // namespace lobelia
