// The fused kernels of highlights on a diffuse base.
#define LOBELIA_DIFFUSE true
#define LOBELIA_FRESNEL false
#include "renderer/kernels/fused_variant-inl.hpp"
