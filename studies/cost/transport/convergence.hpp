// How an error falls with samples or with time.
#pragma once

#include <cstddef>
#include <vector>

namespace lobelia::cost {

/// Of log y over log x, by least squares.
struct Slope {
  double value = 0;           ///< NaN of less than two points
  double standard_error = 0;  ///< NaN of less than three
};
/// x and y > 0, of one length.
Slope fit_slope(const std::vector<double>& x, const std::vector<double>& y);

struct TimeTo {
  enum class Reach {
    kAtOnce,  ///< the first is better than was wanted: its time
    kWithin,  ///< between two that were measured
    kBeyond,  ///< beyond the last: the samples as the error of the last three goes on falling with their
              ///< number, each at what one took from the first point to the last, without the start
  };
  double seconds =
      0;  ///< infinite where the error does not fall, or no time is to be seen for a sample
  Reach reach = Reach::kWithin;
};
/// Seconds and errors by growing number of samples, all > 0, two or more; `wanted` > 0.
TimeTo time_to(const std::vector<double>& samples, const std::vector<double>& seconds,
               const std::vector<double>& errors, double wanted);

}  // namespace lobelia::cost
