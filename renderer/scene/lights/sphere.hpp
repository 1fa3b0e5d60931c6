// A ball of light with the same radiance from every point, seen from outside.
//
// Directions are drawn evenly from its cone (Shirley, Wang and Zimmerman 1996, section 3.2.1). The formulas have no
// cancellation, so they stay exact for a tiny or distant ball.
#ifndef LOBELIA_RENDERER_SCENE_LIGHTS_SPHERE_HPP
#define LOBELIA_RENDERER_SCENE_LIGHTS_SPHERE_HPP

#include "renderer/scene/lights/light.hpp"

namespace lobelia {

struct SphereLight {
  Vec3 center;
  double radius = 1;  ///< > 0
  Rgb radiance;       ///< W/(m^2 sr), >= 0

  static constexpr LightInfo kInfo{"sphere", "a ball of light, which other light passes through",
                                   LightKind::kArea};
  static constexpr auto parameters() {
    return std::to_array<LightParameter<SphereLight>>({
        {{"center", ParameterType::kPoint, "0, 0, 0", -kFar, kFar, "", "its centre"},
         &SphereLight::center},
        {{"radius", ParameterType::kFloat, "1", kNear, kFar, "", "its radius"},
         &SphereLight::radius},
        {kLightRadiance, &SphereLight::radiance},
    });
  }

  Rgb strength() const { return radiance; }
  LightBounds bounds() const { return {LightBounds::kBall, center, radius, true}; }
  double reach_along(Vec3) const { return radius; }

  Lamp lamp(double u, double v) const {
    const double z = 1 - 2 * u, r = std::sqrt(std::max(0.0, 1 - z * z));
    const double turn = 2 * kPi * v;
    const Vec3 normal{r * std::cos(turn), r * std::sin(turn), z};
    const double area = 4 * kPi * radius * radius;
    return Lamp::near(center + radius * normal, area * radiance, normal);
  }
  Lamp whole_lamp() const { return Lamp::near(center, kPi * radius * radius * radiance); }

  double distance(Vec3 origin, Vec3 direction) const {
    const Vec3 to_center = center - origin;
    const double b = dot(to_center, direction), c = dot(to_center, to_center) - radius * radius;
    const double discriminant = b * b - c;
    return c > 0 && b > 0 && discriminant > 0 ? b - std::sqrt(discriminant) : kInfinity;
  }

  bool operator==(const SphereLight&) const = default;
};
static_assert(LightType<SphereLight>);

}  // namespace lobelia

#endif

#ifdef LOBELIA_LIGHT_KERNELS
HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

/// 1 - cos of the half angle of the cone, seen from outside.
HWY_INLINE Lanes cone(Lanes radius_squared, Lanes distance_squared) {
  const Lanes sine_squared = radius_squared / distance_squared;
  return sine_squared / (Lanes(1.0) + sqrt(positive_part(Lanes(1.0) - sine_squared)));
}

/// Distance along a unit direction to the ball; `inside` is half of the chord, squared.
HWY_INLINE Lanes entry(Lanes3 to_center, Lanes3 direction, Lanes radius_squared, Lanes& inside) {
  const Lanes along = dot(to_center, direction);
  const Lanes3 off_axis = subtract_scaled(along, direction, to_center);
  inside = radius_squared - dot(off_axis, off_axis);
  return along - sqrt(positive_part(inside));
}

inline void sample_light(const SphereLight& light, std::size_t count, const Vec3Chunk& point,
                         const double* u, const double* v, LightSamples& drawn) {
  const Lanes3 center = broadcast(light.center);
  const Lanes r2(light.radius * light.radius);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes3 to_center = center - load(point, i);
    const Lanes d2 = dot(to_center, to_center), widest = cone(r2, d2);
    const Lanes s = Lanes::load(u + i) * widest;
    const Lanes3 l = about(Lanes(1.0) / sqrt(d2) * to_center, sqrt(s * (Lanes(2.0) - s)),
                           Lanes(1.0) - s, Lanes(2 * kPi) * Lanes::load(v + i));
    Lanes inside;
    entry(to_center, l, r2, inside).store(drawn.distance + i);
    store(l, drawn.to_light, i);
    where_less(r2, d2, Lanes(2 * kPi) * widest).store(drawn.factor + i);
  }
}

inline void meet_light(const SphereLight& light, std::size_t count, const Vec3Chunk& origin,
                       const Vec3Chunk& to_eye, bool densities, LightMeetings& met) {
  const hn::ScalableTag<double> d;
  const Lanes3 center = broadcast(light.center);
  const Lanes r2(light.radius * light.radius);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes3 to_center = center - load(origin, i);
    const Lanes d2 = dot(to_center, to_center);
    Lanes inside;
    const Lanes t = entry(to_center, Lanes(-1.0) * load(to_eye, i), r2, inside);
    const Mask hit = hn::And(hn::Gt(d2.v, r2.v),
                             hn::And(hn::Gt(inside.v, hn::Zero(d)), hn::Gt(t.v, hn::Zero(d))));
    choose(hit, t, Lanes(kInfinity)).store(met.distance + i);
    if (densities) (Lanes(1.0) / (Lanes(2 * kPi) * cone(r2, d2))).store(met.pdf + i);
  }
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
