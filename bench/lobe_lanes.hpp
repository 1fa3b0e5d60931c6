// A lobe over an array, by SIMD registers of either width.
#pragma once

#include <cstddef>

#include "renderer/highlight.hpp"

namespace lobelia::bench {

/// `count` is a multiple of 16.
void lobe_lanes(LobeId lobe, double exponent, std::size_t count, const float* s, float* value);
void lobe_lanes(LobeId lobe, double exponent, std::size_t count, const double* s, double* value);

}  // namespace lobelia::bench
