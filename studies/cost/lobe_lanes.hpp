// A lobe over an array of s = 1 - cos, by SIMD registers of either width and by one number at a time.
#pragma once

#include <cstddef>

#include "renderer/highlight.hpp"

namespace lobelia::cost {

/// `count` is a multiple of 16.
void lobe_lanes(LobeId lobe, double exponent, std::size_t count, const float* s, float* value);
void lobe_lanes(LobeId lobe, double exponent, std::size_t count, const double* s, double* value);

/// cos^n by binary powering of 1 - s, n a whole number from 1 to 2^31. `count` is a multiple of 16.
void squaring_lanes(unsigned n, std::size_t count, const float* s, float* value);
void squaring_lanes(unsigned n, std::size_t count, const double* s, double* value);

}  // namespace lobelia::cost
