// Parallel light.
#ifndef LOBELIA_RENDERER_SCENE_LIGHTS_DIRECTIONAL_HPP
#define LOBELIA_RENDERER_SCENE_LIGHTS_DIRECTIONAL_HPP

#include "renderer/scene/lights/light.hpp"

namespace lobelia {

struct DirectionalLight {
  Vec3 direction;  ///< where the light travels (as in Mitsuba), unit length
  Rgb irradiance;  ///< on a plane normal to the beam, W/m^2, >= 0

  static constexpr LightInfo kInfo{"directional", "parallel light", LightKind::kDelta};
  static constexpr auto parameters() {
    return std::to_array<LightParameter<DirectionalLight>>({
        {{"direction", ParameterType::kVector, "", -kFar, kFar, "", "where the light travels"},
         &DirectionalLight::direction},
        {{"irradiance", ParameterType::kRgb, "1", 0, kBrightest, "W/m^2",
          "on a plane normal to the direction"},
         &DirectionalLight::irradiance},
    });
  }
  void finish(LightSource& source) {
    if (length(direction) > 0)
      direction = as_unit(direction);
    else
      source.error("", "direction is zero; allowed: any other vector");
  }

  Rgb strength() const { return irradiance; }
  LightBounds bounds() const { return {LightBounds::kFar, -direction}; }
  Lamp lamp() const { return Lamp::distant(direction, irradiance); }

  bool operator==(const DirectionalLight&) const = default;
};
static_assert(LightType<DirectionalLight>);

}  // namespace lobelia

#endif

#ifdef LOBELIA_LIGHT_KERNELS
HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

inline void sample_light(const DirectionalLight& light, std::size_t count, const Vec3Chunk&,
                         LightSamples& drawn) {
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    store(broadcast(-light.direction), drawn.to_light, i);
    Lanes(1.0).store(drawn.factor + i);
    Lanes(kInfinity).store(drawn.distance + i);
  }
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
