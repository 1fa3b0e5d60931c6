// Sums of weighted rows: what filtering a picture is made of.
#pragma once

#include <cstddef>
#include <span>

namespace lobelia {

/// out[i] = sum over k of weights[k] * rows[k][i], product and sum rounded separately and added in the
/// order of k: the same bits on every processor.
void weighted_sum(std::span<const float> weights, const float* const* rows, std::span<float> out);

}  // namespace lobelia
