// What a display shows of a picture: the input space of the perceptual metrics.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/colour.hpp"
#include "core/image.hpp"
#include "core/vec.hpp"

namespace lobelia {

/// How the range of a scene comes to fit into [0, 1].
enum class ToneCurve : std::uint8_t {
  kClip,  ///< what is brighter than white is white
  kAces,  ///< K. Narkowicz's fit of the ACES reference curve, 2015, for 0.6 times the light, in float32
};

/// Display-referred linear light of a scene-linear picture: value * 2^exposure_stops through a tone
/// curve to [0, 1]. Linear, not sRGB-encoded: a type of its own, so that a metric for shown light cannot be
/// fed scene values, nor encoded ones. Of a picture it is a view, which the picture must outlive.
class DisplayLight {
 public:
  DisplayLight(const Image& image, double exposure_stops, ToneCurve curve = ToneCurve::kClip);
  /// The picture as `view` shows it; null is a plain sRGB display that clips. Finite values only.
  static DisplayLight of(const Image& image, double exposure_stops, const DisplayView* view);

  int width() const { return image_->width(); }
  int height() const { return image_->height(); }
  std::size_t pixel_count() const { return image_->pixel_count(); }
  /// Pixel `index` in reading order.
  Rgb at(std::size_t index) const;
  /// The same in float32: R, G and B of the rgb.size() / 3 pixels of row y from column `first` on.
  void fill(int y, int first, std::span<float> rgb) const;

 private:
  std::shared_ptr<const Image> shown_;  ///< what a view made; null without one
  const Image* image_;
  ToneCurve curve_;
  double gain_;
};

}  // namespace lobelia
