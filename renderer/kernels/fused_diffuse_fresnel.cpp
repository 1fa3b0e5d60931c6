// The fused kernels of highlights with a Fresnel factor on a diffuse base.
#define LOBELIA_DIFFUSE true
#define LOBELIA_FRESNEL true
#include "renderer/kernels/fused_variant-inl.hpp"
