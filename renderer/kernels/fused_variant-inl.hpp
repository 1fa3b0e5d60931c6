// One variant of the fused kernel, in a file that defines LOBELIA_DIFFUSE and LOBELIA_FRESNEL. No guard: Highway
// includes it again for each instruction set.
#include "renderer/kernels/fused.hpp"

// As in kernels.cpp: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/kernels/fused_variant-inl.hpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "renderer/kernels/fused-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {
std::unique_ptr<const FusedKernel> make(const FusedSphere& sphere) {
  return fused::make<LOBELIA_DIFFUSE, LOBELIA_FRESNEL>(sphere);
}
}  // namespace
}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(make);

template <>
std::unique_ptr<const FusedKernel> make_fused<LOBELIA_DIFFUSE, LOBELIA_FRESNEL>(
    const FusedSphere& sphere) {
  return HWY_DYNAMIC_DISPATCH(make)(sphere);
}

}  // namespace lobelia
#endif
