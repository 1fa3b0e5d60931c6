// How errors of light transport are measured, and how they fall with samples or time.
#pragma once

#include <cstdint>
#include <vector>

#include "base/pictures/image.hpp"
#include "renderer/render.hpp"

namespace lobelia::cost {

/// Root mean square over all values.
double rms(const Image& image);
double rms_of_difference(const Image& a, const Image& b);
double mean(const Image& image);
/// The average of two pictures of one size.
Image mean_of(const Image& a, const Image& b);

/// Throws Error(kInternal) unless all values are finite and some are not black.
void require_picture(const Image& image, const char* what);

struct Timed {
  double seconds = 0;  ///< of plan and picture
  RenderResult result;
};
/// Checks the picture with require_picture().
Timed render_timed(Scene scene, int samples, std::uint64_t seed, RenderOptions options = {});

/// Slope of log y over log x.
struct Slope {
  double value = 0;           ///< NaN for less than two points
  double standard_error = 0;  ///< NaN for less than three
};
/// By least squares; x and y > 0, of one length.
Slope fit_slope(const std::vector<double>& x, const std::vector<double>& y);

struct TimeTo {
  enum class Reach {
    kAtOnce,  ///< the first point is better than wanted: its time
    kWithin,  ///< interpolated between two points
    /// Extrapolated beyond the last: samples by the slope of the last three errors, each sample at the mean time from
    /// the first point to the last, without the start.
    kBeyond,
  };
  double seconds = 0;  ///< infinite if the error does not fall, or the time does not grow
  Reach reach = Reach::kWithin;
};
/// Seconds and errors by growing number of samples, all > 0, two or more; `wanted` > 0.
TimeTo time_to(const std::vector<double>& samples, const std::vector<double>& seconds,
               const std::vector<double>& errors, double wanted);

}  // namespace lobelia::cost
