#include "compare/uncertainty/noise_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/pictures/contained_reader.hpp"
#include "base/pictures/picture_colour.hpp"
#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "profile/require_same_size.hpp"

namespace lobelia {
namespace {

namespace fs = std::filesystem;

/// "ViewLayer" of "ViewLayer.Combined"; "" if there is no dot.
std::string before_last_dot(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == name.npos ? "" : name.substr(0, dot);
}

std::string within(const std::string& prefix, const std::string& name) {
  return prefix.empty() ? name : prefix + "." + name;
}

/// The layer of that name, in any case; "" if there is none.
std::string layer_named(const PictureSource& source, const std::string& name) {
  const auto found = std::ranges::find_if(source.layers, [&](const std::string& layer) {
    return lower_case(layer) == lower_case(name);
  });
  return found == source.layers.end() ? "" : *found;
}

bool is_vector(const PictureSource& source) {
  return source.channels.size() == 3 && lower_case(source.channels[0]).ends_with("x");
}

/// Half an ulp of a number of 1 as it is stored.
double rounding_of_type(const PictureSource& source) {
  return source.value_type == "half" ? 0x1p-11 : 0x1p-24;
}

/// The variance of a sample, without the factor n / (n - 1), from the moments of them.
double variance_of_moments(double mean, double squares, double rounding) {
  const double square = mean * mean;
  return std::max(0.0, squares - square) + rounding * (std::abs(squares) + 2 * square);
}

/// Upper bounds of the errors of R, G and B for errors of X, Y and Z.
void bound_by_xyz(Image& error) {
  RgbMatrix matrix = inverse(*to_xyz(kRec709Chromaticities));
  for (auto& row : matrix)
    for (double& value : row) value = std::abs(value);
  lobelia::apply(matrix, error);  // not std::apply
}

double samples_of(const fs::path& file, const Picture& picture, const NoiseLayerOptions& options) {
  const double samples = options.samples > 0 ? options.samples : picture.source.samples;
  if (samples == 0)
    throw Error(
        ExitCode::kUsage,

        "{} does not say how many samples a pixel has; give them with --a-samples or --b-samples",
        file.string());
  if (!(samples >= 2))
    throw Error(ExitCode::kUsage,
                "{} has {:g} samples a pixel; noise cannot be told from fewer than 2",
                file.string(), samples);
  return samples;
}

[[noreturn]] void no_noise(const fs::path& file, const std::string& why) {
  throw Error(ExitCode::kInput, "{}: {}", file.string(), why);
}

[[noreturn]] void no_noise_layer(const fs::path& file, const PictureSource& source,
                                 const std::string& parent) {
  if (!layer_named(source, within(parent, "Denoising Variance")).empty())
    no_noise(file,
             "its layer 'Denoising Variance' is filtered for Cycles' denoiser (2.81 to 2.93) and "
             "says nothing of the picture's noise; render another seed for --a-replicate");
  for (const std::string& layer : source.layers)
    if (layer.starts_with("m2_"))
      no_noise(file, fmt::format("Mitsuba's moments are those of X, Y and Z; compare them with "
                                 "--layer '{}'",
                                 printable(layer.substr(3))));
  no_noise(file,
           "it has no layer with the noise of this one: no StandardError, no m2_NAME beside NAME "
           "(Mitsuba), no Variance (pbrt), no Denoising Image Variance (Cycles 2.79 and 2.80); "
           "Cycles 3 and later write none: render another seed for --a-replicate");
}

}  // namespace

PictureNoise noise_of_layers(const fs::path& file, const Picture& picture,
                             const NoiseLayerOptions& options) {
  const PictureSource& source = picture.source;
  const std::string prefix = before_last_dot(source.channels[0]), parent = before_last_dot(prefix);
  const auto read = [&](const std::string& layer) {
    Picture noise = read_picture(file, layer);
    require_same_size(picture.image, noise.image, "the picture", "its layer " + printable(layer));
    return noise;
  };
  const auto noise_of = [&](const Image& error, double freedom, const std::string& layer) {
    PictureNoise noise = noise_of_standard_errors(error, freedom, options.shared);
    noise.layer = layer;
    return noise;
  };
  /// Standard errors by the values of a layer and of the picture.
  const auto errors = [&](const Picture& layer,
                          const std::function<double(double, double)>& error) {
    Image result(picture.image.width(), picture.image.height());
    for (std::size_t i = 0; i < result.values().size(); ++i) {
      const double value = double(layer.image.values()[i]);
      if (!std::isfinite(value))
        no_noise(file, fmt::format("its layer '{}' has the value {}", printable(layer.source.layer),
                                   value));
      result.values()[i] = float(error(value, double(picture.image.values()[i])));
    }
    return result;
  };

  for (const char* name : {"StandardError", "standard_error"})
    if (const auto layer = layer_named(source, within(prefix, name)); !layer.empty())
      return noise_of(read(layer).image, options.freedom, layer);

  if (const auto layer = layer_named(source, "m2_" + prefix);
      !prefix.empty() && !layer.empty() && is_vector(source)) {
    const double n = samples_of(file, picture, options);
    const Picture squares = read(layer);
    const double rounding = std::max(rounding_of_type(source), rounding_of_type(squares.source));
    return noise_of(
        errors(squares,
               [&](double square, double mean) {
                 return std::sqrt(variance_of_moments(mean, square, rounding) / (n - 1));
               }),
        n - 1, layer);
  }

  if (const auto layer = layer_named(source, "Variance"); prefix.empty() && !layer.empty()) {
    if (!source.chromaticities.empty())
      no_noise(file, "pbrt's variance is of X, Y and Z, and is read for Rec. 709 primaries alone");
    const double n = samples_of(file, picture, options);
    Image error = errors(read(layer), [&](double variance, double) {
      return std::sqrt(std::max(0.0, variance) / n);
    });
    bound_by_xyz(error);
    return noise_of(error, n - 1, layer);
  }

  const std::string pass = lower_case(prefix.substr(parent.empty() ? 0 : parent.size() + 1));
  if (const auto layer = layer_named(source, within(parent, "Denoising Image Variance"));
      !layer.empty() && (pass == "combined" || pass == "denoising image")) {
    const double n = samples_of(file, picture, options);
    return noise_of(
        errors(read(layer), [&](double variance,
                                double) { return std::sqrt(std::max(0.0, variance) / (n - 1)); }),
        n - 1, layer);
  }
  no_noise_layer(file, source, parent);
}

}  // namespace lobelia
