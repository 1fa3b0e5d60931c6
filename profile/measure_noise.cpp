#include "profile/measure_noise.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "base/words/constants.hpp"
#include "profile/gaussian.hpp"

namespace lobelia {
namespace {

// An error from 32 fields is itself uncertain by an eighth. Very large fields get fewer.
constexpr int kFields = 32, kFewestFields = 12;
constexpr double kMostValues = 4e7;

Field with_noise(const Field& field, const PixelNoise& noise, std::uint64_t stream, bool together) {
  Field result = field;
  const double one = gaussian(stream, ~std::uint64_t{0});
  const std::uint64_t texture = mix(stream) ^ 1;
  // Squares that do not always begin at the field's corner.
  const auto grain = std::uint64_t(noise.grain);
  const std::uint64_t shift_x = mix(texture) % grain, shift_y = mix(texture + 1) % grain;
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    double more = noise.error[i] * (together ? one : gaussian(stream, i));
    if (noise.texture > 0) {
      const std::uint64_t x = (i % std::size_t(field.width) + shift_x) / grain;
      const std::uint64_t y = (i / std::size_t(field.width) + shift_y) / grain;
      more += noise.texture * gaussian(texture, (y << 32) + x);
    }
    result.values[i] += more;
  }
  if (noise.level > 0)
    for (const std::size_t i : noise.ring)
      result.values[i] += noise.level * gaussian(texture, ~std::uint64_t{0});
  return result;
}

/// Root mean square of the distances from `middle`; NaN where too many are not finite.
double spread_about(double middle, std::vector<double> values) {
  const auto all = values.size();
  std::erase_if(values, [](double x) { return !std::isfinite(x); });
  if (5 * values.size() < 4 * all || values.size() < 2) return kNaN;
  double squares = 0;
  for (const double x : values) squares += (x - middle) * (x - middle);
  return std::sqrt(squares / double(values.size()));
}

}  // namespace

PictureNoise noise_of_replicates(Image& image, std::vector<Image> others) {
  others.push_back(std::move(image));
  // The error of the mean of the channels: whether these share their noise shows in the pictures.
  std::vector<Image> grey;
  for (const Image& picture : others) {
    Image& one = grey.emplace_back(picture.width(), picture.height());
    for (std::size_t i = 0; i < picture.pixel_count(); ++i)
      std::ranges::fill(one.values().subspan(3 * i, 3), float(radiance_at(picture, i)));
  }
  image = mean_of_replicates(others, false).image;
  return mean_of_replicates(grey, false).noise;
}

Field radiance_errors(const PictureNoise& noise) {
  const Image& error = noise.standard_error;
  Field field{error.width(), error.height(), std::vector<double>(error.pixel_count())};
  const auto values = error.values();
  for (std::size_t i = 0; i < field.values.size(); ++i)
    field.values[i] =
        (double(values[3 * i]) + double(values[3 * i + 1]) + double(values[3 * i + 2])) / 3;
  return field;
}

std::vector<double> bootstrap_errors(
    const Field& field, const PixelNoise& noise, std::size_t figures, std::uint64_t seed,
    const std::function<void(const Field&, std::span<double>)>& measure) {
  const int count =
      std::clamp(int(kMostValues / double(std::max<std::size_t>(1, field.values.size()))),
                 kFewestFields, kFields);
  std::vector<double> errors(figures, 0), without(figures, kNaN);
  measure(field, without);
  for (const bool together : {false, true}) {
    if (together && !noise.shared) continue;
    std::vector<double> measured(figures * std::size_t(count), kNaN);
    oneapi::tbb::parallel_for(0, count, [&](int k) {
      measure(
          with_noise(field, noise, mix(seed) + 2 * std::uint64_t(k) + (together ? 1 : 0), together),
          std::span(measured).subspan(figures * std::size_t(k), figures));
    });
    for (std::size_t figure = 0; figure < figures; ++figure) {
      std::vector<double> values;
      for (std::size_t k = figure; k < measured.size(); k += figures) values.push_back(measured[k]);
      const double error = spread_about(without[figure], std::move(values));
      errors[figure] = std::isnan(error) ? error : std::max(errors[figure], error);
    }
  }
  return errors;
}

}  // namespace lobelia
