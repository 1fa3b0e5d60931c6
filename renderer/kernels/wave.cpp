#include "renderer/kernels/wave.hpp"

#include <limits>

#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC  // see kernels.cpp
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/kernels/wave.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "renderer/kernels/chunk-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

void camera_rays(const CameraFrame& camera, std::size_t count, const double* u, const double* v,
                 const double* lens_u, const double* lens_v, Vec3Chunk& direction) {
  const Lanes3 forward = broadcast(camera.forward);
  const Lanes3 right = broadcast(camera.right), up = broadcast(camera.up);
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes x = Lanes::load(u + i) - Lanes::load(lens_u + i);
    const Lanes y = Lanes::load(v + i) - Lanes::load(lens_v + i);
    store(unit(forward + x * right + y * up), direction, i);
  }
}

void nearest_sphere(const std::vector<Sphere>& spheres, std::size_t count, const Vec3Chunk& origin,
                    const Vec3Chunk& direction, const double* leaves, double* index,
                    double* distance) {
  const hn::ScalableTag<double> d;
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes3 o = load(origin, i), w = load(direction, i);
    const auto left = hn::LoadU(d, leaves + i);
    auto nearest = hn::Set(d, std::numeric_limits<double>::infinity()), found = hn::Set(d, -1.0);
    for (std::size_t k = 0; k < spheres.size(); ++k) {
      // The foot of the perpendicular from the centre on the ray, then half the chord: no difference
      // of squares of large numbers, so a small or distant sphere stays round.
      const Lanes3 to_center = broadcast(spheres[k].center) - o;
      const Lanes along = dot(to_center, w);
      const Lanes3 off_axis = to_center - along * w;
      const Lanes half_chord_squared =
          Lanes(spheres[k].radius) * Lanes(spheres[k].radius) - dot(off_axis, off_axis);
      const Lanes t = along - sqrt(positive_part(half_chord_squared));
      const auto here = hn::Set(d, double(k));
      const auto hit = hn::AndNot(hn::Eq(here, left),
                                  hn::And(hn::Gt(half_chord_squared.v, hn::Zero(d)),
                                          hn::And(hn::Gt(t.v, hn::Zero(d)), hn::Lt(t.v, nearest))));
      nearest = hn::IfThenElse(hit, t.v, nearest);
      found = hn::IfThenElse(hit, here, found);
    }
    hn::StoreU(found, d, index + i);
    hn::StoreU(nearest, d, distance + i);
  }
}

}  // namespace

const WaveKernels& wave_kernel_table() {
  static const WaveKernels table{camera_rays, nearest_sphere};
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
