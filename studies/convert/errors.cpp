#include "studies/convert/errors.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "compare/metrics/ciede2000.hpp"

namespace lobelia::conversion {
namespace {

/// The largest value of a function that is smooth between `angles`.
Largest largest_of(const std::function<double(double)>& function,
                   const std::vector<double>& angles) {
  std::vector<double> values;
  for (const double angle : angles) values.push_back(function(angle));
  const double sampled = *std::ranges::max_element(values);
  Largest largest{sampled,
                  angles[std::size_t(std::ranges::find(values, sampled) - values.begin())]};
  // A maximum between two samples is above them by less than this.
  constexpr double kNear = 0.99;
  for (std::size_t i = 1; i + 1 < angles.size(); ++i) {
    const bool is_maximum = values[i] >= values[i - 1] && values[i] >= values[i + 1];
    if (!is_maximum || values[i] < kNear * sampled) continue;
    const auto [angle, negative] = boost::math::tools::brent_find_minima(
        [&](double x) { return -function(x); }, angles[i - 1], angles[i + 1], 40);
    if (-negative > largest.value) largest = {-negative, angle};
  }
  return largest;
}

Lab shown_grey(double radiance, double white) {
  const double light = std::min(1.0, radiance / white);
  return lab_from_display({light, light, light});
}

}  // namespace

Largest largest_difference(const Curve& a, const Curve& b) {
  return largest_of([&](double x) { return std::abs(a(x) - b(x)); }, angles_of(a, b));
}

Largest largest_ciede2000(const Curve& a, const Curve& b) {
  const double white = std::max(a.peak(), b.peak());
  return largest_of(
      [&](double x) { return ciede2000(shown_grey(a(x), white), shown_grey(b(x), white)); },
      angles_of(a, b));
}

double misplaced_energy(const Curve& a, const Curve& b) {
  const std::function<double(double)> difference = [&](double x) { return a(x) - b(x); };
  const std::vector<double> angles = angles_of(a, b);
  double sum = 0;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    const double from = angles[i - 1], to = angles[i];
    const bool begins_above = difference(from) > 0;
    // Where the difference changes its sign; `from` if it does not.
    double before = from, behind = to;
    if (begins_above != (difference(to) > 0))
      for (int step = 0; step < 50; ++step) {
        const double middle = (before + behind) / 2;
        ((difference(middle) > 0) == begins_above ? before : behind) = middle;
      }
    sum += std::abs(energy_between(difference, from, before)) +
           std::abs(energy_between(difference, before, to));
  }
  return sum;
}

}  // namespace lobelia::conversion
