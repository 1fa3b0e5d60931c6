#include "renderer/kernels/wave.hpp"

#include <limits>

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
  for (std::size_t i = 0; i < count; i += Lanes::count()) {
    const Lanes3 o = load(origin, i), eye = load(to_eye, i);
    const auto left = hn::LoadU(d, leaves + i);
    auto nearest = hn::Set(d, std::numeric_limits<double>::infinity()), found = hn::Set(d, -1.0);
    for (std::size_t k = 0; k < spheres.size(); ++k) {
      Lanes3 off_axis;
      Lanes half, t;
      const Mask ahead =
          chord(broadcast(spheres[k].center) - o, Lanes(spheres[k].radius), eye, off_axis, half, t);
      const auto here = hn::Set(d, double(k));
      const Mask hit = hn::AndNot(hn::Eq(here, left), hn::And(ahead, hn::Lt(t.v, nearest)));
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
  static const WaveKernels table{camera_rays, nearest_sphere, surface, random};
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
