#include "cost/picture_truth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/metrics/peak.hpp"
#include "core/colour.hpp"
#include "core/interrupt.hpp"
#include "core/timing.hpp"
#include "renderer/render.hpp"
#include "verify/truth/evaluation.hpp"

namespace lobelia::cost {
namespace {

Image evaluated(const Scene& scene) {
  const std::vector<Rgb> values =
      truth::evaluate(scene, truth::Digits::kDouble, [] { return interrupted(); });
  throw_if_interrupted();
  Image image(scene.film.width, scene.film.height);
  for (std::size_t i = 0; i < values.size(); ++i) {
    float* pixel = image.values().data() + 3 * i;
    pixel[0] = float(values[i].r), pixel[1] = float(values[i].g), pixel[2] = float(values[i].b);
  }
  return image;
}

}  // namespace

Image float64_picture(const Scene& scene, int samples) {
  Scene converged = scene;
  // A pixel of one sample is its centre, of more its area: that is the scene's to say. More samples of what is
  // random are then taken in rounds.
  RenderOptions options;
  options.precision = Precision::kFloat64;
  ++converged.sampler.seed;
  if (samples > 1) {
    options.target_error = std::numeric_limits<double>::min();
    options.max_samples = samples;
  }
  return render(converged, options).image;
}

PictureTruth picture_truth(const Scene& scene, int samples) {
  PictureTruth result;
  const bool formulas = truth::why_not_evaluated(scene).empty();
  result.how =
      formulas ? "the formulas of every pixel, in double"
               : fmt::format("our picture in float64, {} samples a pixel, another seed", samples);
  result.seconds = seconds_of(
      [&] { result.image = formulas ? evaluated(scene) : float64_picture(scene, samples); });
  return result;
}

Comparison compare_at_peak(const Image& picture, const Image& truth) {
  ComparisonOptions options;
  options.viewing.exposure_stops =
      std::clamp(exposure_for_peak(peak_value(truth)), -kMaxExposureStops, kMaxExposureStops);
  return compare(picture, truth, options);
}

double rms_of_peak(const Image& picture, const Image& truth) {
  double sum = 0;
  const auto a = picture.values(), b = truth.values();
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = double(a[i]) - double(b[i]);
    sum += difference * difference;
  }
  return sum == 0 ? 0 : std::sqrt(sum / double(a.size())) / peak_value(truth);
}

}  // namespace lobelia::cost
