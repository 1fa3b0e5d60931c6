#include "compare/display_light.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lobelia {

namespace {

/// In the tool's order of operations.
double aces(float gain, float value) {
  const float x = std::max(gain * value, 0.0f), square = x * x;
  if (std::isinf(square)) return 1;
  const float shown =
      (square * kAces[0] + x * kAces[1] + kAces[2]) / (square * kAces[3] + x * kAces[4] + kAces[5]);
  return double(std::clamp(shown, 0.0f, 1.0f));
}

}  // namespace

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
    const auto gain = float(gain_);
    return {aces(gain, value[0]), aces(gain, value[1]), aces(gain, value[2])};
  }
  const auto shown = [this](float v) { return std::clamp(gain_ * double(v), 0.0, 1.0); };
  return {shown(value[0]), shown(value[1]), shown(value[2])};
}

}  // namespace lobelia
