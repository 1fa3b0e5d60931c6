// The fused kernels of highlights with a Fresnel factor.
#define LOBELIA_DIFFUSE false
#define LOBELIA_FRESNEL true
#include "renderer/kernels/fused_variant-inl.hpp"
