// Vectors of a chunk, a register at a time. Compiled once for each instruction set.
#include "renderer/kernels/kernels.hpp"
#include "renderer/kernels/lanes-inl.hpp"

#if defined(LOBELIA_RENDERER_KERNELS_CHUNK_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_RENDERER_KERNELS_CHUNK_INL_HPP
#undef LOBELIA_RENDERER_KERNELS_CHUNK_INL_HPP
#else
#define LOBELIA_RENDERER_KERNELS_CHUNK_INL_HPP
#endif

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

HWY_INLINE Lanes3 load(const Vec3Chunk& from, std::size_t i) {
  return {Lanes::load(from.x + i), Lanes::load(from.y + i), Lanes::load(from.z + i)};
}
HWY_INLINE void store(Lanes3 a, Vec3Chunk& to, std::size_t i) {
  a.x.store(to.x + i);
  a.y.store(to.y + i);
  a.z.store(to.z + i);
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
