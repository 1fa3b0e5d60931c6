#include "studies/cost/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/pictures/image_values.hpp"
#include "base/system/error.hpp"
#include "base/words/constants.hpp"

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

Slope fit_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  if (n < 2) return {kNaN, kNaN};
  double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    mean_x += std::log(x[i]) / double(n);
    mean_y += std::log(y[i]) / double(n);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double from_mean = std::log(x[i]) - mean_x;
    xx += from_mean * from_mean;
    xy += from_mean * (std::log(y[i]) - mean_y);
  }
  Slope slope{xy / xx, kNaN};
  if (n < 3) return slope;
  double left = 0;
  for (std::size_t i = 0; i < n; ++i)
    left += std::pow(std::log(y[i]) - mean_y - slope.value * (std::log(x[i]) - mean_x), 2);
  slope.standard_error = std::sqrt(left / double(n - 2) / xx);
  return slope;
}

TimeTo time_to(const std::vector<double>& samples, const std::vector<double>& seconds,
               const std::vector<double>& errors, double wanted) {
  if (wanted >= errors.front()) return {seconds.front(), TimeTo::Reach::kAtOnce};
  std::size_t i = 1;
  while (i < errors.size() && errors[i] > wanted) ++i;
  if (i == errors.size()) {
    const std::ptrdiff_t last = std::min<std::ptrdiff_t>(3, std::ssize(samples));
    const double slope =
        fit_slope({samples.end() - last, samples.end()}, {errors.end() - last, errors.end()}).value;
    // No power fits the time itself if most of it is the start.
    const double per_sample =
        (seconds.back() - seconds.front()) / (samples.back() - samples.front());
    if (!(slope < 0 && per_sample > 0)) return {kInfinity, TimeTo::Reach::kBeyond};
    const double more = samples.back() * (std::pow(wanted / errors.back(), 1 / slope) - 1);
    return {seconds.back() + more * per_sample, TimeTo::Reach::kBeyond};
  }
  const double part = std::log(wanted / errors[i - 1]) / std::log(errors[i] / errors[i - 1]);
  return {seconds[i - 1] * std::pow(seconds[i] / seconds[i - 1], part), TimeTo::Reach::kWithin};
}

}  // namespace lobelia::cost
