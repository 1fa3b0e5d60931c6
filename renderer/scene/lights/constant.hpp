// The same light from everywhere, infinitely far away.
#pragma once

#include "renderer/scene/lights/light.hpp"

namespace lobelia {

struct ConstantLight {
  Rgb radiance;  ///< W/(m^2 sr), >= 0

  static constexpr LightInfo kInfo{
      "constant", "the same light from everywhere, infinitely far away", LightKind::kEnvironment};
  static constexpr auto parameters() {
    return std::to_array<LightParameter<ConstantLight>>(
        {{kLightRadiance, &ConstantLight::radiance}});
  }

  Rgb strength() const { return radiance; }
  LightBounds bounds() const { return {LightBounds::kEverywhere, {}}; }

  DirectionSample sample(double u, double v) const {
    const double c = 1 - 2 * u, s = std::sqrt(std::max(0.0, 1 - c * c));
    const double turn = 2 * kPi * v;
    return {{s * std::cos(turn), c, s * std::sin(turn)}, kPdf, radiance};
  }
  EnvironmentLook look(Vec3) const { return {radiance, kPdf}; }
  static constexpr double kPdf = 1 / (4 * kPi);

  bool operator==(const ConstantLight&) const = default;
};
static_assert(LightType<ConstantLight>);

}  // namespace lobelia
