// Which angle each pixel's lobe sees: the geometry that a highlight profile is drawn over.
#pragma once

#include <vector>

#include "renderer/scene/scene.hpp"

namespace lobelia {

/// For one light and one sphere, per pixel in reading order, at the pixel's centre.
struct HighlightMap {
  int width = 0, height = 0;
  std::vector<double> angle;    ///< the lobe's angle in radians; NaN where the pixel does not
                                ///< see the sphere, or the light does not reach it: it is below the
                                ///< horizon (N.L <= 0), or another sphere stands before it
  std::vector<double> n_dot_l;  ///< cosine at the light's side; NaN as above
  /// Radiance over coefficient * lobe, as the mean of R, G and B: irradiance, reflectance with its Fresnel factor, and
  /// foreshortening. NaN as above.
  std::vector<double> scale;
  std::vector<double> solid_angle;  ///< of the pixel as seen from the camera, steradian; never NaN
};

/// Throws Error(kInput) for a scene in which a single ray a pixel does not tell.
HighlightMap highlight_map(const Scene& scene, int light, int sphere);

}  // namespace lobelia
