#include "compare/display_light.hpp"

#include <algorithm>
#include <cmath>

namespace lobelia {

DisplayLight::DisplayLight(const Image& image, double exposure_stops)
    : image_(&image), gain_(std::exp2(exposure_stops)) {}

Rgb DisplayLight::at(std::size_t index) const {
  const float* value = image_->values().data() + 3 * index;
  const auto shown = [this](float v) { return std::clamp(gain_ * double(v), 0.0, 1.0); };
  return {shown(value[0]), shown(value[1]), shown(value[2])};
}

}  // namespace lobelia
