// Where a register of rays meets a sphere, and what arrives there from a point light: the same operations
// for every kernel, so that the pictures of all of them agree bit for bit.
#include <hwy/highway.h>

#include "core/vec.hpp"
#include "renderer/kernels/lanes-inl.hpp"

#if defined(LOBELIA_RENDERER_KERNELS_GEOMETRY_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_RENDERER_KERNELS_GEOMETRY_INL_HPP
#undef LOBELIA_RENDERER_KERNELS_GEOMETRY_INL_HPP
#else
#define LOBELIA_RENDERER_KERNELS_GEOMETRY_INL_HPP
#endif

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

using Mask = hn::Mask<hn::ScalableTag<double>>;

/// A point light nearer to a surface than this stands in it; the largest intensity at this distance
/// times the largest coefficient is still finite in float32.
inline constexpr double kTouching = 1e-9;

HWY_INLINE Lanes3 broadcast(Vec3 a) { return {Lanes(a.x), Lanes(a.y), Lanes(a.z)}; }

/// The unit vector to the eye along the ray forward + u right + v_up.
HWY_INLINE Lanes3 to_eye_of_ray(Lanes3 forward, Lanes u, Lanes3 right, Lanes3 v_up) {
  const Lanes3 along = add_scaled(u, right, forward) + v_up;
  return -inverse_sqrt(dot(along, along)) * along;
}

/// Half of the chord that a ray shares with a sphere, the foot of the perpendicular from the centre on the
/// ray, and the distance to the nearer end. Whether that is ahead. No difference of squares of large
/// numbers, so a small or distant sphere stays round.
HWY_INLINE Mask chord(Lanes3 to_center, Lanes radius, Lanes3 to_eye, Lanes3& off_axis, Lanes& half,
                      Lanes& distance) {
  const hn::ScalableTag<double> d;
  const Lanes back = dot(to_center, to_eye);
  off_axis = subtract_scaled(back, to_eye, to_center);
  const Lanes half_squared = radius * radius - dot(off_axis, off_axis);
  half = sqrt(positive_part(half_squared));
  distance = -back - half;
  return hn::And(hn::Gt(half_squared.v, hn::Zero(d)), hn::Gt(distance.v, hn::Zero(d)));
}

/// The unit normal at the nearer end of that chord.
HWY_INLINE Lanes3 normal_of_chord(Lanes minus_inverse_radius, Lanes3 to_eye, Lanes3 off_axis,
                                  Lanes half) {
  return minus_inverse_radius * subtract_scaled(half, to_eye, off_axis);
}

/// A unit vector at an angle, given by sine and cosine, from the unit vector `axis`, turned about it by
/// `turn` radians. As about() of renderer/frame.hpp.
HWY_INLINE Lanes3 about(Lanes3 axis, Lanes sine, Lanes cosine, Lanes turn) {
  const hn::ScalableTag<double> d;
  const Lanes sign(hn::CopySignToAbs(hn::Set(d, 1.0), axis.z.v));
  const Lanes a = Lanes(-1.0) / (sign + axis.z), b = axis.x * axis.y * a;
  const Lanes3 first(Lanes(1.0) + sign * axis.x * axis.x * a, sign * b, -(sign * axis.x));
  const Lanes3 second(b, sign + axis.y * axis.y * a, -axis.y);
  const Lanes x = sine * Lanes(hn::Cos(d, turn.v)), y = sine * Lanes(hn::Sin(d, turn.v));
  return add_scaled(x, first, add_scaled(y, second, cosine * axis));
}

/// From a point on a sphere to a point light: the unit vector, 1 / distance^2, and the distance.
HWY_INLINE void to_point_light(Lanes3 position, Lanes3 point, Lanes3& to_light, Lanes& falloff,
                               Lanes& distance) {
  const Lanes3 way = position - point;
  const Lanes squared = dot(way, way);
  distance = sqrt(squared);
  // A light in the surface itself has no direction; left dark, as one inside the sphere is.
  const Lanes apart = squared - Lanes(kTouching * kTouching);
  to_light = where_less(Lanes(0.0), apart, Lanes(1.0) / distance) * way;
  falloff = where_less(Lanes(0.0), apart, Lanes(1.0) / squared);
}

/// (1 - V.H)^5, by which Schlick's Fresnel factor goes from its value at normal incidence to 1.
HWY_INLINE Lanes schlick_weight(Lanes3 to_eye, Lanes3 to_light) {
  const Lanes3 sum = to_eye + to_light;
  const Lanes base = positive_part(Lanes(1.0) - Lanes(0.5) * sqrt(dot(sum, sum)));
  const Lanes square = base * base;
  return square * square * base;
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
