// How far a reference picture may be from ours before something is wrong.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "compare/compare.hpp"

namespace lobelia {

/// For an engine of reference_scenes, and the edge_ring of the scene. Pixels beyond it count as outliers; up to three are allowed, on
/// the edges of the scene only, because a silhouette or a terminator may fall on the other side of a
/// pixel's centre.
///
///   povray   6e-4 of the value: it writes half floats, which round by 2^-11 = 4.9e-4; and 1e-8 of the
///            peak, where those are subnormal
///   blender  3e-5 of the peak: Cycles computes in float32; tests/reference_scenes/agreement_test.cpp has what
///            was measured: 2.0e-5
///   analytic 1e-5 of the peak: what the renderer's choice of precision allows itself (docs/numerics.md)
Tolerance agreement(std::string_view engine, std::vector<std::uint8_t> edges);

}  // namespace lobelia
