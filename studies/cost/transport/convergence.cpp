#include "studies/cost/transport/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace lobelia::cost {

Slope fit_slope(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (n < 2) return {kNan, kNan};
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
  Slope slope{xy / xx, kNan};
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
    // Of the time itself no power can be fitted where most of it is the start.
    const double of_a_sample =
        (seconds.back() - seconds.front()) / (samples.back() - samples.front());
    if (!(slope < 0 && of_a_sample > 0))
      return {std::numeric_limits<double>::infinity(), TimeTo::Reach::kBeyond};
    const double more = samples.back() * (std::pow(wanted / errors.back(), 1 / slope) - 1);
    return {seconds.back() + more * of_a_sample, TimeTo::Reach::kBeyond};
  }
  const double part = std::log(wanted / errors[i - 1]) / std::log(errors[i] / errors[i - 1]);
  return {seconds[i - 1] * std::pow(seconds[i] / seconds[i - 1], part), TimeTo::Reach::kWithin};
}

}  // namespace lobelia::cost
