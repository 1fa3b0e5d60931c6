// The mean of a scene's formula over the area of a pixel, in place of its value at the centre.
#pragma once

#include "compare/profile/profile.hpp"
#include "core/image.hpp"
#include "renderer/filter_nodes.hpp"
#include "renderer/pixel_ray.hpp"
#include "renderer/reflector.hpp"

namespace lobelia {

/// One sphere of a scene under its lights, each pixel seen through the film's filter. Scenes as require_single_rays() takes
/// them; the scene has to outlive this object.
class PixelMeans {
 public:
  /// `of_means`: with the film's filter, otherwise at the pixels' centres alone.
  PixelMeans(const Scene& scene, int sphere, bool of_means);

  std::size_t nodes_per_pixel() const { return nodes_.size(); }
  /// Whether all of what the filter sees of a pixel is the sphere, lit by `light`.
  bool is_whole(std::size_t pixel, int light) const;
  /// The geometry of the highlight of `light`; no nodes if the pixel is not whole.
  PixelMean highlight(std::size_t pixel, int light) const;
  /// The diffuse radiance under a light, the mean of R, G and B.
  double diffuse(std::size_t pixel, int light) const;
  /// The radiance under one light, or all if none is named. Where the sphere is not seen it is 0.
  Rgb radiance(std::size_t pixel, std::optional<int> light) const;

 private:
  struct Seen {
    Hit hit;
    Vec3 to_eye;
  };
  /// The sphere at a place from a pixel's centre.
  std::optional<Seen> at(std::size_t pixel, double x, double y) const;

  const Scene& scene_;
  int sphere_;
  CameraFrame frame_;
  Reflector reflector_;
  std::vector<FilterNode> nodes_;
  double reach_ = 0;  ///< of the filter, pixels
};

}  // namespace lobelia
