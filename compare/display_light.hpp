// The light that a display shows of a picture: the input of the perceptual metrics.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "base/pictures/colour.hpp"
#include "base/pictures/image.hpp"

namespace lobelia {

/// Maps the range of a scene to [0, 1].
enum class ToneCurve : std::uint8_t {
  kClip,  ///< everything brighter than white is white
  // Those of NVIDIA's FLIP tool, in float32:
  kAces,      ///< K. Narkowicz's fit of the ACES reference curve, 2015, for 0.6 times the light
  kReinhard,  ///< Reinhard et al. 2002: a colour over 1 + its luminance
  kHable,     ///< J. Hable's filmic curve, 2010
};
/// By ToneCurve.
inline constexpr std::string_view kToneCurveNames[] = {"clip", "aces", "reinhard", "hable"};

/// A curve is (c0 x^2 + c1 x + c2) / (c3 x^2 + c4 x + c5), with the constants of the tool and their roundings; Reinhard's
/// of the luminance. Not for kClip.
struct ToneConstants {
  float c[6];
};
constexpr ToneConstants tone_constants(ToneCurve curve) {
  constexpr float k = 0.6f;  // the exposure that the fit has inside
  if (curve == ToneCurve::kReinhard) return {{0, 1, 0, 0, 1, 1}};
  if (curve == ToneCurve::kHable) return {{0.231683f, 0.013791f, 0, 0.18f, 0.3f, 0.018f}};
  return {{k * k * 2.51f, k * 0.03f, 0, k * k * 2.43f, k * 0.59f, 0.14f}};
}

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
  /// The picture it shows. Pixels that are equal there have equal light.
  const Image& image() const { return *image_; }
  /// R, G and B of rgb.size() / 3 pixels of row y, from column `first` on, in float32. kClip computes in double and
  /// rounds. The other curves have the FLIP tool's order of operations; values with an infinite square are white.
  void fill(int y, int first, std::span<float> rgb) const;

 private:
  std::shared_ptr<const Image> shown_;  ///< made by a view; null without one
  const Image* image_;
  ToneCurve curve_;
  double gain_;
};

}  // namespace lobelia
