#include "compare/display_light.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/tone_curve.hpp"

namespace lobelia {

DisplayLight::DisplayLight(const Image& image, double exposure_stops, ToneCurve curve)
    : image_(&image),
      curve_(curve),
      gain_(curve == ToneCurve::kAces ? double(std::pow(2.0f, float(exposure_stops)))
                                      : std::exp2(exposure_stops)) {}

DisplayLight DisplayLight::of(const Image& image, double exposure_stops, const DisplayView* view) {
  if (!view) return {image, exposure_stops};
  auto shown = std::make_shared<const Image>(view->shown(image, exposure_stops));
  DisplayLight light(*shown, 0);
  light.shown_ = std::move(shown);
  return light;
}

Rgb DisplayLight::at(std::size_t index) const {
  const float* value = image_->values().data() + 3 * index;
  if (curve_ == ToneCurve::kAces) {
    float rgb[3];
    aces_values(float(gain_), value, rgb, 3);
    return {rgb[0], rgb[1], rgb[2]};
  }
  const auto shown = [this](float v) { return std::clamp(gain_ * double(v), 0.0, 1.0); };
  return {shown(value[0]), shown(value[1]), shown(value[2])};
}

void DisplayLight::fill(int y, int first, std::span<float> rgb) const {
  const std::size_t start = std::size_t(y) * std::size_t(width()) + std::size_t(first);
  const float* values = image_->values().data() + 3 * start;
  if (curve_ == ToneCurve::kAces)
    aces_values(float(gain_), values, rgb.data(), rgb.size());
  else
    clip_values(gain_, values, rgb.data(), rgb.size());
}

}  // namespace lobelia
