// The light that a display shows of a picture: the input of the perceptual metrics.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/colour.hpp"
#include "core/image.hpp"

namespace lobelia {

/// Maps the range of a scene to [0, 1].
enum class ToneCurve : std::uint8_t {
  kClip,  ///< everything brighter than white is white
  kAces,  ///< K. Narkowicz's fit of the ACES reference curve, 2015, for 0.6 times the light, in float32
};

/// ToneCurve::kAces is (c0 x^2 + c1 x + c2) / (c3 x^2 + c4 x + c5), with the constants of NVIDIA's FLIP tool and
/// their roundings.
inline constexpr float kAces[6] = {0.6f * 0.6f * 2.51f, 0.6f * 0.03f, 0.0f,
                                   0.6f * 0.6f * 2.43f, 0.6f * 0.59f, 0.14f};

/// Display-referred linear light of a scene-linear picture: value * 2^exposure_stops through a tone curve to [0, 1].
/// Linear, not sRGB-encoded. A type of its own, so that metrics of shown light cannot be fed scene values or encoded
/// values. Made from a picture it is a view, which the picture must outlive.
class DisplayLight {
 public:
  DisplayLight(const Image& image, double exposure_stops, ToneCurve curve = ToneCurve::kClip);
  /// The picture through `view`; null is a plain sRGB display that clips. Finite values only.
  static DisplayLight of(const Image& image, double exposure_stops, const DisplayView* view);

  int width() const { return image_->width(); }
  int height() const { return image_->height(); }
  std::size_t pixel_count() const { return image_->pixel_count(); }
  /// R, G and B of rgb.size() / 3 pixels of row y, from column `first` on, in float32. kClip computes in double and
  /// rounds. kAces has the FLIP tool's order of operations; values with an infinite square are white.
  void fill(int y, int first, std::span<float> rgb) const;

 private:
  std::shared_ptr<const Image> shown_;  ///< made by a view; null without one
  const Image* image_;
  ToneCurve curve_;
  double gain_;
};

}  // namespace lobelia
