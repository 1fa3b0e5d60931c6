// The time of found lobes, as SIMD code in float32.
#pragma once

#include <span>
#include <vector>

#include "core/timing.hpp"
#include "renderer/highlight.hpp"
#include "studies/search/shape.hpp"

namespace lobelia::search {

/// The lobe at `count` values of s, a multiple of 64, aligned for SIMD.
void evaluate(const Lobe& lobe, double n, std::size_t count, const float* s, float* value);

/// Seconds for one value of each lobe and of one of the catalogue, in interleaved rounds, for numbers that the cache holds.
std::vector<Times> times_of(std::span<const Lobe> lobes, const LobeId& last);

}  // namespace lobelia::search
