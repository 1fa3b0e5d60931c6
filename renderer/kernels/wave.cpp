#include "renderer/kernels/wave.hpp"

#include <limits>
#include <numbers>

#include "renderer/sobol.hpp"

#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC  // see kernels.cpp
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/kernels/wave.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "renderer/kernels/chunk-inl.hpp"
#include "renderer/kernels/geometry-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

void camera_rays(const CameraFrame& camera, std::size_t count, const double* u, const double* v,
                 const double* lens_u, const double* lens_v, Vec3Chunk& to_eye) {
  const Lanes3 forward = broadcast(camera.forward);
  const Lanes3 right = broadcast(camera.right), up = broadcast(camera.up);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes x = Lanes::load(u + i) - Lanes::load(lens_u + i);
    const Lanes y = Lanes::load(v + i) - Lanes::load(lens_v + i);
    store(to_eye_of_ray(forward, x, right, y * up), to_eye, i);
  }
}

void nearest_sphere(const std::vector<Sphere>& spheres, std::size_t count, const Vec3Chunk& origin,
                    const Vec3Chunk& to_eye, const double* leaves, double* index,
                    double* distance) {
  const hn::ScalableTag<double> d;
  // The square of the distance to the centre, less that of the radius, of what lies on each sphere, at most.
  std::vector<double> on_it;
  for (const Sphere& sphere : spheres)
    on_it.push_back((outer_radius(sphere) - sphere.radius) *
                    (outer_radius(sphere) + sphere.radius));
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes3 o = load(origin, i), eye = load(to_eye, i);
    const auto left = hn::LoadU(d, leaves + i);
    auto nearest = hn::Set(d, std::numeric_limits<double>::infinity()), found = hn::Set(d, -1.0);
    for (std::size_t k = 0; k < spheres.size(); ++k) {
      Lanes3 off_axis;
      Lanes half, t;
      const Mask ahead =
          chord(broadcast(spheres[k].center) - o, Lanes(spheres[k].radius), eye, off_axis, half, t);
      // By Euclid's theorem of the secant it is the product of the ways to both ends of the chord.
      const Mask outside = hn::Gt((t * (t + half + half)).v, hn::Set(d, on_it[k]));
      const auto here = hn::Set(d, double(k));
      const Mask hit =
          hn::AndNot(hn::Eq(here, left), hn::And(hn::And(ahead, outside), hn::Lt(t.v, nearest)));
      nearest = hn::IfThenElse(hit, t.v, nearest);
      found = hn::IfThenElse(hit, here, found);
    }
    hn::StoreU(found, d, index + i);
    hn::StoreU(nearest, d, distance + i);
  }
}

void surface(std::size_t count, const Vec3Chunk& origin, const Vec3Chunk& to_eye,
             const Vec3Chunk& center, const double* radius, Vec3Chunk& point, Vec3Chunk& normal) {
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes3 c = load(center, i), eye = load(to_eye, i);
    const Lanes r = Lanes::load(radius + i);
    Lanes3 off_axis;
    Lanes half, t;
    chord(c - load(origin, i), r, eye, off_axis, half, t);
    const Lanes3 n = normal_of_chord(Lanes(-1.0) / r, eye, off_axis, half);
    store(n, normal, i);
    store(add_scaled(r, n, c), point, i);
  }
}

/// Beyond it rays run along a plane: its horizon.
constexpr double kFarthest = 1e15;

void nearest_plane(const Plane& plane, double plane_index, std::size_t count,
                   const Vec3Chunk& origin, const Vec3Chunk& to_eye, const double* leaves,
                   double* index, double* distance) {
  const hn::ScalableTag<double> d;
  const Lanes3 normal = broadcast(plane.normal), on_plane = broadcast(plane.point);
  const auto here = hn::Set(d, plane_index);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes t = dot(load(origin, i) - on_plane, normal) / dot(load(to_eye, i), normal);
    const auto before = hn::LoadU(d, distance + i);
    const Mask ahead = hn::And(hn::Gt(t.v, hn::Zero(d)), hn::Lt(t.v, hn::Set(d, kFarthest)));
    const Mask hit =
        hn::AndNot(hn::Eq(here, hn::LoadU(d, leaves + i)), hn::And(ahead, hn::Lt(t.v, before)));
    hn::StoreU(hn::IfThenElse(hit, t.v, before), d, distance + i);
    hn::StoreU(hn::IfThenElse(hit, here, hn::LoadU(d, index + i)), d, index + i);
  }
}

void plane_surface(const Plane& plane, double plane_index, std::size_t count,
                   const Vec3Chunk& origin, const Vec3Chunk& to_eye, const double* index,
                   const double* distance, Vec3Chunk& point, Vec3Chunk& normal) {
  const hn::ScalableTag<double> d;
  const Lanes3 up = broadcast(plane.normal), on_plane = broadcast(plane.point);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Mask here = hn::Eq(hn::Set(d, plane_index), hn::LoadU(d, index + i));
    const Lanes3 eye = load(to_eye, i);
    const Lanes3 at = subtract_scaled(Lanes::load(distance + i), eye, load(origin, i));
    // Back onto the plane, from which a distant ray's rounding has led.
    const Lanes3 p = subtract_scaled(dot(at - on_plane, up), up, at);
    const Mask from_above = hn::Gt(dot(eye, up).v, hn::Zero(d));
    const auto put = [&](const Lanes& now, double* to)
                         HWY_ATTR { hn::BlendedStore(now.v, here, d, to + i); };
    put(p.x, point.x), put(p.y, point.y), put(p.z, point.z);
    const auto facing = [&](Lanes n) HWY_ATTR {
      return Lanes(hn::IfThenElse(from_above, n.v, hn::Neg(n.v)));
    };
    put(facing(up.x), normal.x), put(facing(up.y), normal.y), put(facing(up.z), normal.z);
  }
}

void plane_hides(const Plane& plane, std::size_t count, const Vec3Chunk& point,
                 const Vec3Chunk& to_light, const double* distance, double* visible) {
  const hn::ScalableTag<double> d;
  const Lanes3 normal = broadcast(plane.normal), on_plane = broadcast(plane.point);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes t = dot(on_plane - load(point, i), normal) / dot(load(to_light, i), normal);
    const Mask between = hn::And(hn::Gt(t.v, hn::Zero(d)), hn::Lt(t.v, hn::LoadU(d, distance + i)));
    hn::StoreU(hn::IfThenZeroElse(between, hn::LoadU(d, visible + i)), d, visible + i);
  }
}

void scatter_evenly(std::size_t count, const Vec3Chunk& normal, const double* u, const double* v,
                    Vec3Chunk& to_light) {
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    // Malley's method: a point of the disc, lifted. N.L = sqrt(1 - u).
    const Lanes square = Lanes::load(u + i);
    const Lanes3 l = about(load(normal, i), sqrt(square), sqrt(Lanes(1.0) - square),
                           Lanes(2 * std::numbers::pi) * Lanes::load(v + i));
    store(l, to_light, i);
  }
}

void random(std::size_t count, const std::uint32_t* pixel, const std::uint32_t* index,
            std::uint32_t dimension, double* u, double* v) {
  // Plain integers: the compiler makes registers of them for each instruction set by itself.
  for (std::size_t i = 0; i < count; ++i) {
    const sobol::Pair p = sobol::pair(pixel[i], index[i], dimension);
    u[i] = p.u;
    v[i] = p.v;
  }
}

}  // namespace

const WaveKernels& wave_kernel_table() {
  static const WaveKernels table{camera_rays,   nearest_sphere, surface,        nearest_plane,
                                 plane_surface, plane_hides,    scatter_evenly, random};
  return table;
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(wave_kernel_table);

const WaveKernels& wave_kernels() {
  static const WaveKernels& table = HWY_DYNAMIC_DISPATCH(wave_kernel_table)();
  return table;
}

}  // namespace lobelia
#endif
