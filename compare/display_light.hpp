// What a display shows of a picture: the input space of the perceptual metrics.
#pragma once

#include <cstddef>

#include "core/image.hpp"
#include "core/vec.hpp"

namespace lobelia {

/// Display-referred linear light of a scene-linear picture: value * 2^exposure_stops, clipped to
/// [0, 1]. Linear, not sRGB-encoded: a type of its own, so that a metric for shown light cannot be
/// fed scene values, nor encoded ones. A view: the picture must outlive it.
class DisplayLight {
 public:
  DisplayLight(const Image& image, double exposure_stops);

  int width() const { return image_->width(); }
  int height() const { return image_->height(); }
  std::size_t pixel_count() const { return image_->pixel_count(); }
  /// Pixel `index` in reading order.
  Rgb at(std::size_t index) const;

 private:
  const Image* image_;
  double gain_;
};

}  // namespace lobelia
