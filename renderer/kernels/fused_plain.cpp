// The fused kernels of highlights alone.
#define LOBELIA_DIFFUSE false
#define LOBELIA_FRESNEL false
#include "renderer/kernels/fused_variant-inl.hpp"
