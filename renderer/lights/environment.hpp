// Light from everywhere: directions drawn as its image is bright, per solid angle.
#pragma once

#include <vector>

#include "renderer/lights/light_sample.hpp"
#include "renderer/scene/scene.hpp"

namespace lobelia {

/// Made once for a picture: a table of the image's brightness, 8 bytes a pixel.
class Environment {
 public:
  explicit Environment(const EnvironmentLight& light);

  Rgb radiance(Vec3 direction) const;
  double pdf(Vec3 direction) const;
  /// Both, for the price of one.
  struct Look {
    Rgb radiance;
    double pdf;
  };
  Look look(Vec3 direction) const;
  LightSample sample(double u, double v) const;

 private:
  struct Place {
    double column, row;  ///< in pixels; centres are at halves
  };
  Place place(Vec3 direction) const;
  Rgb at(Place place) const;
  double pdf(std::size_t column, std::size_t row) const;
  double row_solid_angle(int row) const;

  EnvironmentLight light_;
  int width_ = 0, height_ = 0;
  std::vector<double> rows_;     ///< cumulative, 0 to 1
  std::vector<double> columns_;  ///< of each row, cumulative, 0 to 1; width + 1 each
  std::vector<double>
      cosines_;  ///< of the angle from +y at which each row begins, and the last ends
};

}  // namespace lobelia
