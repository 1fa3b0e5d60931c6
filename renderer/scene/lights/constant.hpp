// The same light from everywhere, infinitely far away.
#ifndef LOBELIA_RENDERER_SCENE_LIGHTS_CONSTANT_HPP
#define LOBELIA_RENDERER_SCENE_LIGHTS_CONSTANT_HPP

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
    return {{s * std::cos(turn), c, s * std::sin(turn)}, 1 / (4 * kPi), radiance};
  }
  static constexpr bool has_bright() { return false; }
  EnvironmentLook look(Vec3) const { return {radiance, {}}; }

  bool operator==(const ConstantLight&) const = default;
};
static_assert(LightType<ConstantLight>);

}  // namespace lobelia

#endif

#ifdef LOBELIA_LIGHT_KERNELS
HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

inline void look_at(const ConstantLight& light, std::size_t count, const Vec3Chunk&,
                    EnvironmentLook* looks) {
  std::fill_n(looks, count, EnvironmentLook{light.radiance, {}});
}

inline void sample_bright(const ConstantLight&, std::size_t count, const double*, const double*,
                          LightSamples& drawn) {
  std::fill_n(drawn.factor, count, 0.0);
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
