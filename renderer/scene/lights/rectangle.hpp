// A rectangle with the corners center +- half_u +- half_v. It shines to the side of half_u x half_v with the same
// radiance in every direction.
//
// Directions are drawn evenly from its solid angle (Ureña, Fajardo and King 2013, "An area-preserving
// parametrization for spherical rectangles"), or evenly from its area if the solid angle is too small to compute.
#ifndef LOBELIA_RENDERER_SCENE_LIGHTS_RECTANGLE_HPP
#define LOBELIA_RENDERER_SCENE_LIGHTS_RECTANGLE_HPP

#include <fmt/core.h>

#include "renderer/scene/lights/light.hpp"

namespace lobelia {

struct RectangleLight {
  Vec3 center, half_u, half_v;  ///< half_u and half_v are perpendicular
  Rgb radiance;                 ///< W/(m^2 sr), >= 0

  static constexpr LightInfo kInfo{"rectangle", "a rectangle that shines to one side",
                                   LightKind::kArea};
  static constexpr auto parameters() {
    return std::to_array<LightParameter<RectangleLight>>({
        {{"center", ParameterType::kPoint, "0, 0, 0", -kFar, kFar, "", "its centre"},
         &RectangleLight::center},
        {{"half_u", ParameterType::kVector, "", -kFar, kFar, "", "from the centre to a side"},
         &RectangleLight::half_u},
        {{"half_v", ParameterType::kVector, "", -kFar, kFar, "",
          "to the next side; perpendicular to half_u; it shines to the side of half_u x half_v"},
         &RectangleLight::half_v},
        {kLightRadiance, &RectangleLight::radiance},
    });
  }
  void finish(LightSource& source) const {
    if (!source.has("half_u") || !source.has("half_v")) return;
    const double u = length(half_u), v = length(half_v);
    for (const auto& [name, l] : {std::pair("half_u", u), std::pair("half_v", v)})
      if (l < kNear)
        return source.error(name,
                            fmt::format("{} is {:g} long; allowed: {:g} or more", name, l, kNear));
    const double cosine = dot(half_u, half_v) / (u * v);
    if (std::abs(cosine) > 1e-6)
      source.error("", fmt::format("half_u and half_v are not perpendicular: the cosine between "
                                   "them is {:g}; allowed: -1e-06 to 1e-06",
                                   cosine));
  }

  Rgb strength() const { return radiance; }
  LightBounds bounds() const { return {LightBounds::kBall, center, length(half_u + half_v)}; }
  double reach_along(Vec3 axis) const {
    return std::abs(dot(half_u, axis)) + std::abs(dot(half_v, axis));
  }

  Lamp lamp(double u, double v) const {
    return lamp_at(center + (2 * u - 1) * half_u + (2 * v - 1) * half_v);
  }
  Lamp whole_lamp() const { return lamp_at(center); }
  /// A lamp with the power of the whole rectangle.
  Lamp lamp_at(Vec3 position) const {
    const Vec3 normal = cross(half_u, half_v);  // a quarter of the area long
    return Lamp::near(position, 4 * length(normal) * radiance, normalize(normal));
  }

  double distance(Vec3 origin, Vec3 direction) const {
    const Vec3 normal = cross(half_u, half_v);
    const double against = -dot(direction, normal);
    if (!(against > 0)) return kInfinity;
    const double t = dot(origin - center, normal) / against;
    const Vec3 from = origin + t * direction - center;
    const bool within = std::abs(dot(from, half_u)) <= dot(half_u, half_u) &&
                        std::abs(dot(from, half_v)) <= dot(half_v, half_v);
    return t > 0 && within ? t : kInfinity;
  }

  /// The rectangle in a frame of unit vectors; it shines towards +z.
  struct Ready {
    Vec3 center, x, y, z;
    double half_x, half_y;
    explicit Ready(const RectangleLight& light)
        : center(light.center),
          x(normalize(light.half_u)),
          y(normalize(light.half_v)),
          z(cross(x, y)),
          half_x(length(light.half_u)),
          half_y(length(light.half_v)) {}
  };

  bool operator==(const RectangleLight&) const = default;
};
static_assert(LightType<RectangleLight>);

}  // namespace lobelia

#endif

#ifdef LOBELIA_LIGHT_KERNELS
HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

/// Below this bound of the solid angle the angles have lost too many digits. Evenly in area is then evenly in solid
/// angle to within a per cent or so.
inline constexpr double kSmallest = 1e-2;

/// The rectangle as seen from points: x0..x1 by y0..y1 in the plane z = z0 < 0.
struct View {
  Lanes x0, x1, y0, y1, z0, area;
  Mask in_front, small;
};

HWY_INLINE View view(const RectangleLight::Ready& light, Lanes3 point) {
  const hn::ScalableTag<double> d;
  const Lanes3 to_center = broadcast(light.center) - point;
  const Lanes x = dot(to_center, broadcast(light.x)), y = dot(to_center, broadcast(light.y));
  View v;
  v.x0 = x - Lanes(light.half_x), v.x1 = x + Lanes(light.half_x);
  v.y0 = y - Lanes(light.half_y), v.y1 = y + Lanes(light.half_y);
  v.z0 = dot(to_center, broadcast(light.z));
  v.area = Lanes(4 * light.half_x * light.half_y);
  v.in_front = hn::Lt(v.z0.v, hn::Zero(d));
  // The rectangle's nearest point gives an upper bound of the solid angle.
  const Lanes nx(hn::Max(hn::Max(v.x0.v, hn::Neg(v.x1.v)), hn::Zero(d)));
  const Lanes ny(hn::Max(hn::Max(v.y0.v, hn::Neg(v.y1.v)), hn::Zero(d)));
  const Lanes nearest = nx * nx + ny * ny + v.z0 * v.z0;
  v.small = hn::Lt((v.area * -v.z0).v, (Lanes(kSmallest) * nearest * sqrt(nearest)).v);
  return v;
}

struct Spherical {
  Lanes b0, b1, k, solid_angle;
};

HWY_INLINE Spherical spherical(const View& v) {
  const hn::ScalableTag<double> d;
  const Lanes z2 = v.z0 * v.z0;
  // The normals of the four planes through the point and a side each have a zero component, which shortens their
  // products.
  const auto component = [&](Lanes a) HWY_ATTR { return a / sqrt(z2 + a * a); };
  const Lanes n0 = -component(v.y0), n1 = component(v.x1), n2 = component(v.y1),
              n3 = -component(v.x0);
  const auto angle = [&](Lanes a, Lanes b)
                         HWY_ATTR { return Lanes(hn::Acos(d, hn::Neg((a * b).v))); };
  const Lanes g0 = angle(n0, n1), g1 = angle(n1, n2), g2 = angle(n2, n3), g3 = angle(n3, n0);
  const Lanes k = Lanes(2 * kPi) - g2 - g3;
  return {n0, n2, k, g0 + g1 - k};
}

inline void sample_light(const RectangleLight::Ready& light, std::size_t count,
                         const Vec3Chunk& point, const double* u, const double* v,
                         LightSamples& drawn) {
  const hn::ScalableTag<double> d;
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const View r = view(light, load(point, i));
    const Lanes ui = Lanes::load(u + i), vi = Lanes::load(v + i);
    Lanes x = r.x0 + ui * (r.x1 - r.x0), y = r.y0 + vi * (r.y1 - r.y0);
    Lanes solid_angle(0.0);
    if (!hn::AllTrue(d, r.small)) {
      const Spherical s = spherical(r);
      const Lanes angle = ui * s.solid_angle + s.k;
      const Lanes f = (Lanes(hn::Cos(d, angle.v)) * s.b0 - s.b1) / Lanes(hn::Sin(d, angle.v));
      const Lanes size = Lanes(1.0) / sqrt(f * f + s.b0 * s.b0);
      const Lanes c = clamp(Lanes(hn::CopySign(size.v, f.v)), Lanes(-1.0), Lanes(1.0));
      const Lanes rest(hn::Max((Lanes(1.0) - c * c).v, hn::Set(d, 1e-300)));
      const Lanes xs = clamp(-c * r.z0 / sqrt(rest), r.x0, r.x1);
      const Lanes d2 = xs * xs + r.z0 * r.z0;
      const Lanes h0 = r.y0 / sqrt(d2 + r.y0 * r.y0), h1 = r.y1 / sqrt(d2 + r.y1 * r.y1);
      const Lanes h = h0 + vi * (h1 - h0), h2 = h * h;
      const Lanes lift(hn::Max((Lanes(1.0) - h2).v, hn::Set(d, 1e-12)));
      const Lanes ys = clamp(h * sqrt(d2 / lift), r.y0, r.y1);
      x = choose(r.small, x, xs), y = choose(r.small, y, ys);
      solid_angle = s.solid_angle;
    }
    const Lanes squared = x * x + y * y + r.z0 * r.z0, distance = sqrt(squared);
    const Lanes by_area = r.area * -r.z0 / (squared * distance);
    const Lanes3 offset = add_scaled(x, broadcast(light.x),
                                     add_scaled(y, broadcast(light.y), r.z0 * broadcast(light.z)));
    store(Lanes(1.0) / distance * offset, drawn.to_light, i);
    distance.store(drawn.distance + i);
    const Lanes inverse = choose(r.small, by_area, solid_angle);
    Lanes(hn::IfThenElseZero(r.in_front, inverse.v)).store(drawn.factor + i);
  }
}

inline void meet_light(const RectangleLight::Ready& light, std::size_t count,
                       const Vec3Chunk& origin, const Vec3Chunk& to_eye, bool densities,
                       LightMeetings& met) {
  const hn::ScalableTag<double> d;
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const View r = view(light, load(origin, i));
    const Lanes3 eye = load(to_eye, i);
    const Lanes away = dot(eye, broadcast(light.z)), t = -r.z0 / away;
    const Lanes x = -t * dot(eye, broadcast(light.x)), y = -t * dot(eye, broadcast(light.y));
    const Mask across = hn::And(hn::And(hn::Ge(x.v, r.x0.v), hn::Le(x.v, r.x1.v)),
                                hn::And(hn::Ge(y.v, r.y0.v), hn::Le(y.v, r.y1.v)));
    const Mask hit = hn::And(hn::And(r.in_front, hn::Gt(away.v, hn::Zero(d))), across);
    choose(hit, t, Lanes(kInfinity)).store(met.distance + i);
    if (!densities) continue;
    const Lanes by_area = t * t * t / (r.area * -r.z0);
    choose(r.small, by_area, Lanes(1.0) / spherical(r).solid_angle).store(met.pdf + i);
  }
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
