// The peak of a highlight, to a fraction of a pixel.
//
// It is the maximum of a polynomial fitted to the logarithm of the values. Weights are the squares of the values, so
// that equal errors of the values count equally. The logarithm of a Gaussian is a quadratic, and that of a power of a
// cosine on a sphere nearly so: its terms of third degree move the maximum of a quadratic fitted over many pixels. So the
// polynomial is
//   of degree 4 over the cap, the pixels above 4/5 of the peak, if the cap reaches 3 pixels from its middle along its
//     short axis. So many pixels reduce noise. From 10 pixels on, the cap is above 9/10;
//   of degree 2 over 3 x 3 pixels, if the cap is smaller: third-order terms are small there too.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "base/pictures/image.hpp"
#include "base/records/profile.hpp"

namespace lobelia {

/// One number per pixel, row by row from the top; NaN is a hole. Places are on the film, in pixels from its upper left
/// corner: the centre of pixel (i, j) is (i + 1/2, j + 1/2) (docs/conventions.md).
struct Field {
  int width = 0, height = 0;
  std::vector<double> values;  ///< width * height

  /// In `values`, of a pixel on the film.
  std::size_t index(int i, int j) const {
    return std::size_t(j) * std::size_t(width) + std::size_t(i);
  }
  /// The value of pixel (i, j); NaN outside the film.
  double at(int i, int j) const;
};

/// The mean of R, G and B of a pixel, by its index in reading order.
inline double radiance_at(const Image& image, std::size_t index) {
  const float* value = image.values().data() + 3 * index;
  return (double(value[0]) + double(value[1]) + double(value[2])) / 3;
}
/// Pixels that are not finite are holes.
Field radiance_field(const Image& image);

using FilmPoint = records::Point;
inline double distance(FilmPoint a, FilmPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// The centre of a pixel, by its index in reading order.
FilmPoint pixel_centre(const Field& field, std::size_t index);

/// The value between pixels, by cubic convolution with a = -1/2 (Keys 1981, "Cubic convolution interpolation for digital
/// image processing", eq. 15). Exact for a quadratic; NaN if one of the 16 pixels around is a hole.
double sample(const Field& field, FilmPoint place);

/// The same of the logarithms, where all of them are above 0: exact for a Gaussian. Otherwise sample().
double sample_of_highlight(const Field& field, FilmPoint place);

/// Indices of the pixels of at least `level` that connect to `start` by sides and corners. `start` is the first.
std::vector<std::size_t> region_above(const Field& field, std::size_t start, double level);

/// The axes of the second moments of pixels.
struct Axes {
  FilmPoint centre;  ///< the weighted mean of the pixels' centres
  FilmPoint major;   ///< unit vector, x >= 0
  double major_sigma =
      0;  ///< standard deviation, pixels; the variance of a pixel, 1/12, is included
  double minor_sigma = 0;  ///< likewise
};
/// The axes of second moments about a centre, to which no variance of a pixel is added.
Axes axes_of_moments(FilmPoint centre, double xx, double xy, double yy);
/// Weights each pixel by value - base. `pixels` is not empty, and the sum of the weights is positive.
Axes principal_axes(const Field& field, const std::vector<std::size_t>& pixels, double base);

/// The distance from `peak` along a unit vector at which the field, as sample_of_highlight() has it, first falls to `level`,
/// pixels. NaN if a hole or the
/// border comes first.
double distance_to_level(const Field& field, FilmPoint peak, FilmPoint direction, double level);

/// Named by records::kPeakFound.
enum class PeakFound {
  kFitted,   ///< by the polynomial
  kPixel,    ///< the brightest pixel: no polynomial has a maximum near it
  kPlateau,  ///< the middle of many pixels of exactly the same value: a clipped or flat picture
  kEdge,     ///< the brightest pixel, beside a hole or the border: the true peak may lie beyond
  kNone,     ///< no value is above 0
};

struct Peak {
  FilmPoint place;   ///< NaN if there is none
  double value = 0;  ///< of the polynomial there, or of the pixel; NaN if there is none
  PeakFound found = PeakFound::kNone;
  std::size_t pixel = 0;  ///< the brightest, in reading order
};

/// Infinite values are holes too. O(pixels).
Peak locate_peak(const Field& field);
/// The same from a pixel of finite value above 0 that none of its neighbours exceeds.
Peak locate_peak(const Field& field, std::size_t brightest);

}  // namespace lobelia
