// Draws directions to a picture of the sky with a density proportional to its brightness, between the pixels' centres too.
#pragma once

#include <span>
#include <vector>

#include "renderer/scene/lights/light.hpp"

namespace lobelia {

/// Luminance of a pixel of a sky, not scaled.
inline double sky_luminance(std::span<const float, 3> p) {
  return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
}

/// The luminance up to which a sky varies so little that a surface samples it well: at most 4 times the mean of what is
/// below it. What is above is drawn by the sky itself. Karlik et al. 2019, "MIS compensation", take the mean away.
double smooth_luminance(const Image& sky);

/// Made once for a rendered picture. Takes 8 bytes for each pixel of the sky.
class EnvmapTable {
 public:
  /// `scale` multiplies every pixel. Directions are drawn to what is above a luminance of `floor`.
  EnvmapTable(std::shared_ptr<const Image> image, Rgb scale, double floor);

  /// Nothing is above the floor.
  bool is_black() const { return !(total_ > 0); }

  /// In pixels, from the top left corner.
  struct Place {
    double column, row;
  };
  Place place(Vec3 direction) const;
  double turn(Place place) const { return 2 * kPi * (place.column / width_ - 0.5); }
  double polar_angle(Place place) const { return kPi * place.row / height_; }
  int width() const { return width_; }
  int height() const { return height_; }

  /// `squared_sine` is that of the angle from +y.
  EnvironmentLook look(Place place, double squared_sine) const;
  EnvironmentLook look(Vec3 d) const { return look(place(d), d.x * d.x + d.z * d.z); }
  /// Brings the pixels there nearer, before look().
  void prefetch(Place place) const;

  struct Draw {
    Place place;
    double
        density;  ///< times the sine of the angle from +y, per steradian; 0 if there is nothing to draw
    Rgb radiance;  ///< of the part above the floor
  };
  Draw draw(double u, double v) const;
  DirectionSample sample(double u, double v) const;

 private:
  /// Four centres of pixels, and a place between them. Rows 0 and height are half as high: they end at a pole.
  struct Patch {
    double across = 0, down = 0;  ///< from 0 to 1
    std::array<std::span<const float, 3>, 4> pixels;
    double top_sine, bottom_sine;
  };
  Patch patch(int column, int row) const;
  double height_of(int row) const { return row == 0 || row == height_ ? 0.5 : 1; }
  /// Proportional to the density in pixels, at the four corners.
  std::array<double, 4> weights(const Patch& patch) const;
  double density(const Patch& patch) const;
  EnvironmentLook look(const Patch& patch, double squared_sine) const;

  /// Cumulative from 0 to 1, and the steps outside of which it does not grow.
  struct Steps {
    int first = 0, last = 0;
  };
  static Steps growing(std::span<const double> cumulative);

  std::shared_ptr<const Image> image_;
  Rgb scale_;
  double floor_;
  int width_, height_;
  double total_ = 0;             ///< sum of the patches' weights
  std::vector<double> sines_;    ///< of the angles from +y at the edges of the rows of patches
  std::vector<double> rows_;     ///< cumulative, height + 2; empty if nothing is drawn
  std::vector<double> columns_;  ///< of each row of patches, cumulative, width + 1 each
  Steps row_steps_;
  std::vector<Steps> column_steps_;  ///< of each row
};

}  // namespace lobelia
