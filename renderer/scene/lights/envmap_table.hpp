// Draws directions to a picture of the sky with a density proportional to its brightness.
#pragma once

#include <vector>

#include "renderer/scene/lights/light.hpp"

namespace lobelia {

/// Made once for a rendered picture. Takes 8 bytes for each pixel of the sky.
class EnvmapTable {
 public:
  /// `scale` multiplies every pixel.
  EnvmapTable(std::shared_ptr<const Image> image, Rgb scale);

  EnvironmentLook look(Vec3 direction) const;
  DirectionSample sample(double u, double v) const;

 private:
  struct Place {
    double column, row;  ///< in pixels; centres are at halves
  };
  Place place(Vec3 direction) const;
  Rgb at(Place place) const;
  double pdf(std::size_t column, std::size_t row) const;
  double row_solid_angle(int row) const;

  std::shared_ptr<const Image> image_;
  Rgb scale_;
  int width_, height_;
  std::vector<double> rows_;     ///< cumulative, 0 to 1
  std::vector<double> columns_;  ///< of each row, cumulative, 0 to 1; width + 1 each
  std::vector<double> cosines_;  ///< of the angles from +y of the rows' edges, height + 1
};

}  // namespace lobelia
