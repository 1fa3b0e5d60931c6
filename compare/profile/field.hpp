// One number per pixel, with holes, and its values between the pixels.
#pragma once

#include <cstddef>
#include <vector>

namespace lobelia {

/// Row by row from the top; NaN is a hole. Places are on the film, in pixels from its upper left corner: the
/// centre of pixel (i, j) is (i + 1/2, j + 1/2) (docs/conventions.md).
struct Field {
  int width = 0, height = 0;
  std::vector<double> values;  ///< width * height

  /// The value of pixel (i, j); NaN outside of the film.
  double at(int i, int j) const;
};

struct FilmPoint {
  double x = 0, y = 0;
};

/// The centre of a pixel, by its index in reading order.
FilmPoint pixel_centre(const Field& field, std::size_t index);

/// Between the pixels' centres by cubic convolution with a = -1/2 (Keys 1981, "Cubic convolution
/// interpolation for digital image processing", eq. 15), exact for a quadratic; NaN where one of the 16
/// pixels around is a hole.
double sample(const Field& field, FilmPoint place);

/// The pixels that hang together with `start` by sides and corners and hold at least `level`, as indices in
/// reading order of their finding, `start` first.
std::vector<std::size_t> region_above(const Field& field, std::size_t start, double level);

/// Where the pixels' second moments have their axes.
struct Axes {
  FilmPoint centre;        ///< the weighted mean of the pixels' centres
  FilmPoint major;         ///< unit vector, x >= 0
  double major_sigma = 0;  ///< standard deviations along the two axes, pixels, the square of a
  double minor_sigma = 0;  ///< pixel itself (1/12) included
};
/// Weights each pixel by value - base. `pixels` is not empty and the weights' sum is positive.
Axes principal_axes(const Field& field, const std::vector<std::size_t>& pixels, double base);

/// How far from `peak` along a unit vector the field first falls to `level`, pixels; NaN where it meets a hole
/// or the border before.
double distance_to_level(const Field& field, FilmPoint peak, FilmPoint direction, double level);

}  // namespace lobelia
