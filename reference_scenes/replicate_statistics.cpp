#include "reference_scenes/replicate_statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace lobelia {

ReplicateStatistics replicate_statistics(const ReferenceResult& result, const Image& truth,
                                         int points, double rounding) {
  ReplicateStatistics s;
  s.values = truth.values().size();
  const double peak = *std::ranges::max_element(truth.values());
  // Independent estimates of each value, whose differences from the truth have a t-distribution.
  const boost::math::students_t t(kReplicates - 1);
  const double any = boost::math::quantile(
      boost::math::complement(t, (1 - std::pow(1 - 1e-3, 1 / double(s.values))) / 2));
  const double one_in_twenty = boost::math::quantile(t, 0.975);
  double squares = 0;
  for (std::size_t i = 0; i < s.values; ++i) {
    // An edge that one point in a thousand sees may be seen by none, which would be no error.
    const double error = std::max(double(result.standard_error.values()[i]), peak / points / 4);
    const double apart = std::abs(double(result.image.values()[i]) - double(truth.values()[i]));
    squares += apart * apart;
    // Where nothing varies there is rounding alone.
    const double rounded = rounding * double(truth.values()[i]) + 1e-6;
    if (apart <= rounded) continue;
    ++s.random;
    s.of_twenty += apart > one_in_twenty * error;
    s.beyond += apart - rounded > any * error;
  }
  s.rms = std::sqrt(squares / double(s.values));
  return s;
}

}  // namespace lobelia
