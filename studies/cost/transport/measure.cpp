#include "studies/cost/transport/measure.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/image_values.hpp"

namespace lobelia::cost {

double rms(const Image& image) {
  double sum = 0;
  for (const float v : image.values()) sum += double(v) * v;
  return std::sqrt(sum / double(image.values().size()));
}

double rms_of_difference(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    sum += std::pow(double(a.values()[i]) - b.values()[i], 2);
  return std::sqrt(sum / double(a.values().size()));
}

double mean(const Image& image) {
  double sum = 0;
  for (const float v : image.values()) sum += v;
  return sum / double(image.values().size());
}

void require_picture(const Image& image, const char* what) {
  const bool finite = is_finite(image);
  if (!finite || !(rms(image) > 0))
    throw Error(ExitCode::kInternal, std::string(what) + (finite ? ": a black picture"
                                                                 : ": values that are not finite"));
}

Image mean_of(const Image& a, const Image& b) {
  Image result = a;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    result.values()[i] = (a.values()[i] + b.values()[i]) / 2;
  return result;
}

Timed render_timed(Scene scene, int samples, std::uint64_t seed, RenderOptions options) {
  scene.sampler = {samples, seed};
  Timed timed;
  timed.result = render(scene, options);
  timed.seconds = timed.result.plan_seconds + timed.result.render_seconds;
  require_picture(timed.result.image, "ours");
  return timed;
}

}  // namespace lobelia::cost
