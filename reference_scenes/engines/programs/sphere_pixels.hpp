// Where the rays through the pixels' centres meet a sphere, for engines that shade points that they are given.
#pragma once

#include <cmath>

#include "reference_scenes/engines/programs/scene_program.hpp"

namespace lobelia {

/// Calls f(pixel, point, normal) for every pixel, from the lowest row on, whose centre sees the sphere.
template <class F>
void for_each_pixel_of(const CameraScene& scene, const CameraScene::Sphere& sphere, const F& f) {
  const Three& c = sphere.centre;
  const double outside = c[0] * c[0] + c[1] * c[1] + c[2] * c[2] - sphere.radius * sphere.radius;
  for (int j = 0; j < scene.height; ++j)
    for (int i = 0; i < scene.width; ++i) {
      const double x = scene.left + (i + 0.5) * (scene.right - scene.left) / scene.width,
                   y = scene.bottom + (j + 0.5) * (scene.top - scene.bottom) / scene.height;
      // The nearer solution t of |t (x, y, 1) - c| = radius.
      const double a = x * x + y * y + 1, b = x * c[0] + y * c[1] + c[2],
                   discriminant = b * b - a * outside;
      if (discriminant <= 0 || b <= 0) continue;
      const double t = outside / (b + std::sqrt(discriminant));
      const Three point{t * x, t * y, t};
      f(std::size_t(j) * std::size_t(scene.width) + std::size_t(i), point,
        Three{(point[0] - c[0]) / sphere.radius, (point[1] - c[1]) / sphere.radius,
              (point[2] - c[2]) / sphere.radius});
    }
}

}  // namespace lobelia
