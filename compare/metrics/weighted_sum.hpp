// Sums of weighted rows: what filtering a picture is made of.
#pragma once

#include <cstddef>
#include <span>

namespace lobelia {

struct WeightedSum {
  std::span<const float> weights;
  float* out;
};

/// For each of one to three sums of equally many weights: out[i] = sum over k of weights[k] * rows[k][i],
/// i < size, product and sum rounded separately and added in the order of k: the same bits on every
/// processor. Together, as each value is then loaded once.
void weighted_sums(std::span<const WeightedSum> sums, const float* const* rows, std::size_t size);

}  // namespace lobelia
