#include "renderer/kernels/lights.hpp"

#include <limits>
#include <numbers>

#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC  // see kernels.cpp
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/kernels/lights.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "renderer/kernels/chunk-inl.hpp"
#include "renderer/kernels/geometry-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

constexpr double kPi = std::numbers::pi, kInfinity = std::numeric_limits<double>::infinity();

HWY_INLINE Lanes choose(Mask mask, Lanes yes, Lanes no) {
  return Lanes(hn::IfThenElse(mask, yes.v, no.v));
}
HWY_INLINE Lanes clamp(Lanes x, Lanes low, Lanes high) {
  return Lanes(hn::Min(hn::Max(x.v, low.v), high.v));
}

// ---- a ball: the cone that it fills (Shirley, Wang and Zimmerman 1996, section 3.2.1), which stays exact
// for a ball that is tiny or far because nothing in it cancels

/// 1 - cos of the half angle of the cone, seen from outside.
HWY_INLINE Lanes cone(Lanes radius_squared, Lanes distance_squared) {
  const Lanes sine_squared = radius_squared / distance_squared;
  return sine_squared / (Lanes(1.0) + sqrt(positive_part(Lanes(1.0) - sine_squared)));
}

/// Along a unit direction to where it enters the ball; `inside` is half of the chord, squared.
HWY_INLINE Lanes entry(Lanes3 to_center, Lanes3 direction, Lanes radius_squared, Lanes& inside) {
  const Lanes along = dot(to_center, direction);
  const Lanes3 off_axis = subtract_scaled(along, direction, to_center);
  inside = radius_squared - dot(off_axis, off_axis);
  return along - sqrt(positive_part(inside));
}

void sample_sphere(const SphereLight& light, std::size_t count, const Vec3Chunk& point,
                   const double* u, const double* v, DrawnChunk& drawn) {
  const Lanes3 center = broadcast(light.center);
  const Lanes r2(light.radius * light.radius);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes3 way = center - load(point, i);
    const Lanes d2 = dot(way, way), widest = cone(r2, d2);
    const Lanes s = Lanes::load(u + i) * widest;
    const Lanes3 l = about(Lanes(1.0) / sqrt(d2) * way, sqrt(s * (Lanes(2.0) - s)), Lanes(1.0) - s,
                           Lanes(2 * kPi) * Lanes::load(v + i));
    Lanes inside;
    entry(way, l, r2, inside).store(drawn.distance + i);
    store(l, drawn.to_light, i);
    where_less(r2, d2, Lanes(2 * kPi) * widest).store(drawn.inverse_pdf + i);
  }
}

void meet_sphere(const SphereLight& light, std::size_t count, const Vec3Chunk& origin,
                 const Vec3Chunk& to_eye, bool densities, MetChunk& met) {
  const hn::ScalableTag<double> d;
  const Lanes3 center = broadcast(light.center);
  const Lanes r2(light.radius * light.radius);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes3 way = center - load(origin, i);
    const Lanes d2 = dot(way, way);
    Lanes inside;
    const Lanes t = entry(way, Lanes(-1.0) * load(to_eye, i), r2, inside);
    const Mask hit = hn::And(hn::Gt(d2.v, r2.v),
                             hn::And(hn::Gt(inside.v, hn::Zero(d)), hn::Gt(t.v, hn::Zero(d))));
    choose(hit, t, Lanes(kInfinity)).store(met.distance + i);
    if (densities) (Lanes(1.0) / (Lanes(2 * kPi) * cone(r2, d2))).store(met.pdf + i);
  }
}

// ---- a rectangle: the solid angle that it fills (Ureña, Fajardo and King 2013, "An area-preserving
// parametrization for spherical rectangles"); where that is too small for the angles of its corners to be
// told apart, its area

/// Below this bound of the solid angle the angles have lost too many digits, and evenly in area is evenly
/// in solid angle to within a per cent or so.
constexpr double kSmallest = 1e-2;

/// The rectangle as seen from points: x0..x1 by y0..y1 in the plane z = z0 < 0.
struct View {
  Lanes x0, x1, y0, y1, z0, area;
  Mask in_front, small;
};

HWY_INLINE View view(const PreparedRectangle& light, Lanes3 point) {
  const hn::ScalableTag<double> d;
  const Lanes3 way = broadcast(light.center) - point;
  const Lanes x = dot(way, broadcast(light.x)), y = dot(way, broadcast(light.y));
  View v;
  v.x0 = x - Lanes(light.half_x), v.x1 = x + Lanes(light.half_x);
  v.y0 = y - Lanes(light.half_y), v.y1 = y + Lanes(light.half_y);
  v.z0 = dot(way, broadcast(light.z));
  v.area = Lanes(4 * light.half_x * light.half_y);
  v.in_front = hn::Lt(v.z0.v, hn::Zero(d));
  // The nearest point of it bounds the solid angle from above.
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
  // The normals of the four planes through the point and a side have one component of zero each, so
  // that their products are short.
  const auto component = [&](Lanes a) HWY_ATTR { return a / sqrt(z2 + a * a); };
  const Lanes n0 = -component(v.y0), n1 = component(v.x1), n2 = component(v.y1),
              n3 = -component(v.x0);
  const auto angle = [&](Lanes a, Lanes b)
                         HWY_ATTR { return Lanes(hn::Acos(d, hn::Neg((a * b).v))); };
  const Lanes g0 = angle(n0, n1), g1 = angle(n1, n2), g2 = angle(n2, n3), g3 = angle(n3, n0);
  const Lanes k = Lanes(2 * kPi) - g2 - g3;
  return {n0, n2, k, g0 + g1 - k};
}

void sample_rectangle(const PreparedRectangle& light, std::size_t count, const Vec3Chunk& point,
                      const double* u, const double* v, DrawnChunk& drawn) {
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
    const Lanes3 way = add_scaled(x, broadcast(light.x),
                                  add_scaled(y, broadcast(light.y), r.z0 * broadcast(light.z)));
    store(Lanes(1.0) / distance * way, drawn.to_light, i);
    distance.store(drawn.distance + i);
    const Lanes inverse = choose(r.small, by_area, solid_angle);
    Lanes(hn::IfThenElseZero(r.in_front, inverse.v)).store(drawn.inverse_pdf + i);
  }
}

void meet_rectangle(const PreparedRectangle& light, std::size_t count, const Vec3Chunk& origin,
                    const Vec3Chunk& to_eye, bool densities, MetChunk& met) {
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

}  // namespace

const LightKernels& light_kernel_table() {
  static const LightKernels table{sample_sphere, sample_rectangle, meet_sphere, meet_rectangle};
  return table;
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(light_kernel_table);

const LightKernels& light_kernels() {
  static const LightKernels& table = HWY_DYNAMIC_DISPATCH(light_kernel_table)();
  return table;
}

PreparedRectangle::PreparedRectangle(const RectangleLight& light)
    : center(light.center),
      x(normalize(light.half_u)),
      y(normalize(light.half_v)),
      z(cross(x, y)),
      half_x(length(light.half_u)),
      half_y(length(light.half_v)) {}

}  // namespace lobelia
#endif
