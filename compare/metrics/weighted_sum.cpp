#include "compare/metrics/weighted_sum.hpp"

// As in renderer/kernels/kernels.cpp: a debug build keeps to the baseline.
#ifndef __OPTIMIZE__
#define HWY_COMPILE_ONLY_STATIC
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "compare/metrics/weighted_sum.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Four vectors of sums at a time stay in registers; in memory, each would be loaded and stored for every
/// weight. Mul and Add, not MulAdd: see the header.
void weighted_sum_lanes(const float* weights, std::size_t count, const float* const* rows,
                        float* out, std::size_t size) {
  const hn::ScalableTag<float> d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + 4 * lanes <= size; i += 4 * lanes) {
    auto sum0 = hn::Zero(d), sum1 = sum0, sum2 = sum0, sum3 = sum0;
    for (std::size_t k = 0; k < count; ++k) {
      const auto weight = hn::Set(d, weights[k]);
      const float* in = rows[k] + i;
      sum0 = hn::Add(sum0, hn::Mul(weight, hn::LoadU(d, in)));
      sum1 = hn::Add(sum1, hn::Mul(weight, hn::LoadU(d, in + lanes)));
      sum2 = hn::Add(sum2, hn::Mul(weight, hn::LoadU(d, in + 2 * lanes)));
      sum3 = hn::Add(sum3, hn::Mul(weight, hn::LoadU(d, in + 3 * lanes)));
    }
    hn::StoreU(sum0, d, out + i);
    hn::StoreU(sum1, d, out + i + lanes);
    hn::StoreU(sum2, d, out + i + 2 * lanes);
    hn::StoreU(sum3, d, out + i + 3 * lanes);
  }
  for (; i < size; ++i) {
    float sum = 0;
    for (std::size_t k = 0; k < count; ++k) sum += weights[k] * rows[k][i];
    out[i] = sum;
  }
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(weighted_sum_lanes);

void weighted_sum(std::span<const float> weights, const float* const* rows, std::span<float> out) {
  HWY_DYNAMIC_DISPATCH(weighted_sum_lanes)
  (weights.data(), weights.size(), rows, out.data(), out.size());
}

}  // namespace lobelia
#endif  // HWY_ONCE
