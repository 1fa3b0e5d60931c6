// Rays and spheres, point lights and frames for registers. All kernels use these operations, so that their pictures
// agree bit for bit.
#include "renderer/kernels/kernels.hpp"
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

/// A point light nearer to a surface than this is in the surface. The largest intensity at this distance times the
/// largest coefficient is still finite in float32.
inline constexpr double kTouching = 1e-9;

HWY_INLINE Lanes3 broadcast(Vec3 a) { return {Lanes(a.x), Lanes(a.y), Lanes(a.z)}; }
HWY_INLINE Lanes3 load(const Vec3Chunk& from, std::size_t i) {
  return {Lanes::load(from.x + i), Lanes::load(from.y + i), Lanes::load(from.z + i)};
}
HWY_INLINE void store(Lanes3 a, Vec3Chunk& to, std::size_t i) {
  a.x.store(to.x + i);
  a.y.store(to.y + i);
  a.z.store(to.z + i);
}

/// The unit vector to the eye along the ray forward + u right + v_up.
HWY_INLINE Lanes3 to_eye_of_ray(Lanes3 forward, Lanes u, Lanes3 right, Lanes3 v_up) {
  const Lanes3 along = add_scaled(u, right, forward) + v_up;
  return -inverse_sqrt(dot(along, along)) * along;
}

/// Half of the chord of a ray in a sphere, the perpendicular from the ray to the centre, and the distance to the
/// nearer end. Returns whether that end is ahead. Has no difference of large squares, so a small or distant sphere
/// stays round.
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

/// A unit vector at an angle, given by sine and cosine, from the unit vector `axis`, turned about it by `turn`
/// radians, as about() in renderer/frame.hpp.
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
  const Lanes3 offset = position - point;
  const Lanes squared = dot(offset, offset);
  distance = sqrt(squared);
  // A light in the surface has no direction. It lights nothing, as one inside the sphere.
  const Lanes apart = squared - Lanes(kTouching * kTouching);
  to_light = where_less(Lanes(0.0), apart, Lanes(1.0) / distance) * offset;
  falloff = where_less(Lanes(0.0), apart, Lanes(1.0) / squared);
}

/// (1 - V.H)^5, the weight of 1 against F0 in Schlick's Fresnel factor.
HWY_INLINE Lanes schlick_weight(Lanes3 to_eye, Lanes3 to_light) {
  const Lanes3 sum = to_eye + to_light;
  const Lanes base = positive_part(Lanes(1.0) - Lanes(0.5) * sqrt(dot(sum, sum)));
  const Lanes square = base * base;
  return square * square * base;
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
