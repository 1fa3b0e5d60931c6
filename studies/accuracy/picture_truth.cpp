#include "studies/accuracy/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pictures/colour.hpp"
#include "base/pictures/image_values.hpp"
#include "base/system/interrupt.hpp"
#include "base/system/timing.hpp"
#include "base/words/constants.hpp"
#include "compare/metrics/catalogue.hpp"
#include "reference_scenes/engines/analytic/formulas/evaluation.hpp"
#include "renderer/small_highlights.hpp"

namespace lobelia::accuracy {
namespace {

Image evaluated(const Scene& scene) {
  const std::vector<Rgb> values =
      truth::evaluate(scene, truth::Digits::kDouble, [] { return interrupted(); });
  throw_if_interrupted();
  return truth::as_picture(values, scene.film);
}

}  // namespace

RenderOptions with_samples(int samples) {
  RenderOptions options;
  // In rounds, towards an error that is never reached.
  options.target_error = std::numeric_limits<double>::min();
  options.max_samples = samples;
  return options;
}

PictureTruth picture_truth(const Scene& scene, int samples) {
  PictureTruth result;
  // The formulas are those of a pixel's centre.
  const bool averages =
      scene.sampler.averages_small_highlights && !find_small_highlights(scene).empty();
  const bool formulas = !averages && truth::why_not_evaluated(scene).empty();
  result.how =
      formulas ? "the formulas of every pixel, in double"
      : samples > 1
          ? fmt::format("our picture in float64, {} samples a pixel, another seed", samples)
          : "our picture in float64";
  result.seconds = seconds_of([&] {
    if (formulas) {
      result.image = evaluated(scene);
      return;
    }
    Scene other = scene;
    ++other.sampler.seed;
    RenderOptions options = samples > 1 ? with_samples(samples) : RenderOptions();
    options.precision = Precision::kFloat64;
    result.image = render(other, options).image;
  });
  return result;
}

double measure_at_peak(std::string_view id, const Image& picture, const Image& truth) {
  const double stops =
      std::clamp(exposure_for_peak(peak_value(truth)), -kMaxExposureStops, kMaxExposureStops);
  const Metric& metric = *find_metric(id);
  std::vector<double> values(metric.outputs.size());
  metric.measure({picture, truth, DisplayLight(picture, stops), DisplayLight(truth, stops),
                  kDefaultPixelsPerDegree},
                 values);
  return values[std::size_t(find_metric_output(id) - metric.outputs.data())];
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

Scene pixel_subset(const Scene& scene, int side) {
  const Film& film = scene.film;
  // An odd number, so that the middle is a pixel's centre too; no more than there are rows.
  int every = (std::max(film.width, film.height) + side - 1) / side;
  every = std::min({every | 1, film.width, film.height});
  if (every % 2 == 0) --every;
  if (every <= 1) return scene;
  Scene subset = scene;
  subset.film.width = film.width / every;
  subset.film.height = film.height / every;
  const CameraFrame frame = camera_frame(scene.camera, film);
  const double half_width = frame.half_width * every * subset.film.width / film.width;
  const double half_height = frame.half_height * every * subset.film.height / film.height;
  subset.camera.fov_degrees = 2 * std::atan(half_width) * 180 / kPi;
  // The upper left corner stays where it is.
  subset.camera.principal_point_offset_x =
      -(frame.shift_u + half_width - frame.half_width) / (2 * half_width);
  subset.camera.principal_point_offset_y =
      -(frame.shift_v + frame.half_height - half_height) / (2 * half_height);
  return subset;
}

}  // namespace lobelia::accuracy
