// Scenes for the tests of the reference engines, and how far two pictures are apart.
#pragma once

#include <algorithm>
#include <cmath>
#include <string_view>
#include <variant>

#include "base/pictures/image.hpp"
#include "studies/agreement/example_scenes.hpp"

namespace lobelia {

/// The lobes with the normalisations that the paper and the software compare.
struct Normalised {
  std::string_view lobe, normalisation;
};
inline constexpr Normalised kNormalisations[] = {
    {"cosine", "exact"}, {"cosine", "paper"}, {"cs16", "paper"}, {"cs16", "exact"}};

struct Difference {
  double worst = 0;  ///< greatest |a - b| over the peak of `truth`
  int outliers = 0;  ///< pixels over the tolerance
  bool finite = true;
};

/// The scene in other units and in another place. Its picture stays the same.
inline Scene moved(Scene scene, double scale, Vec3 away) {
  const auto move = [&](Vec3& place) { place = scale * (place + away); };
  move(scene.camera.origin);
  move(scene.camera.target);
  for (Sphere& sphere : scene.spheres) move(sphere.center), sphere.radius *= scale;
  for (Plane& plane : scene.planes) move(plane.point), plane.checker_size *= scale;
  for (Light& light : scene.lights)
    if (auto* lamp = std::get_if<PointLight>(&light)) {
      move(lamp->position);
      lamp->intensity = scale * scale * lamp->intensity;
    }
  return scene;
}

/// A pixel is over the tolerance if a channel is: |a - truth| > relative * truth + of_peak * peak.
inline Difference difference(const Image& a, const Image& truth, double relative, double of_peak) {
  Difference d;
  if (a.width() != truth.width() || a.height() != truth.height()) {
    d.finite = false;
    return d;
  }
  const double peak = *std::max_element(truth.values().begin(), truth.values().end());
  for (int y = 0; y < truth.height(); ++y)
    for (int x = 0; x < truth.width(); ++x) {
      bool outlier = false;
      for (int c = 0; c < 3; ++c) {
        const double value = truth.pixel(x, y)[c], apart = std::abs(a.pixel(x, y)[c] - value);
        if (!std::isfinite(apart)) d.finite = false;
        d.worst = std::max(d.worst, apart / peak);
        if (!(apart <= relative * value + of_peak * peak)) outlier = true;
      }
      d.outliers += outlier;
    }
  return d;
}

}  // namespace lobelia
