// The fused kernels of highlights with a Fresnel factor on a diffuse base.
#include "renderer/kernels/fused.hpp"

// As in kernels.cpp: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/kernels/fused_diffuse_fresnel.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "renderer/kernels/fused-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {
std::unique_ptr<const FusedKernel> make(const FusedSphere& sphere) {
  return fused::make<true, true>(sphere);
}
}  // namespace
}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(make);

std::unique_ptr<const FusedKernel> make_fused_diffuse_fresnel(const FusedSphere& sphere) {
  return HWY_DYNAMIC_DISPATCH(make)(sphere);
}

}  // namespace lobelia
#endif
