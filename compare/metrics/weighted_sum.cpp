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

/// Sums as many values as `d` and kVectors hold, from the i-th on. The sums stay in registers; in memory each would
/// be loaded and stored for every weight. Mul and Add, not MulAdd: see the header.
template <std::size_t kSums, std::size_t kVectors, class D>
HWY_INLINE void sum_at(D d, const WeightedSum* sums, const float* const* rows, std::size_t i) {
  const std::size_t lanes = hn::Lanes(d), count = sums[0].weights.size();
  hn::Vec<D> sum[kSums][kVectors];
  for (auto& of_vectors : sum)
    for (auto& lane_sums : of_vectors) lane_sums = hn::Zero(d);
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t v = 0; v < kVectors; ++v) {
      const auto in = hn::LoadU(d, rows[k] + i + v * lanes);
      for (std::size_t s = 0; s < kSums; ++s)
        sum[s][v] = hn::Add(sum[s][v], hn::Mul(hn::Set(d, sums[s].weights[k]), in));
    }
  for (std::size_t s = 0; s < kSums; ++s)
    for (std::size_t v = 0; v < kVectors; ++v)
      hn::StoreU(sum[s][v], d, sums[s].out + i + v * lanes);
}

template <std::size_t kSums>
HWY_INLINE void sum_all(const WeightedSum* sums, const float* const* rows, std::size_t size) {
  // Four sums at least, as an addition takes that long; no more than there are registers for.
  constexpr std::size_t kVectors = kSums == 1 ? 4 : 2;
  const hn::ScalableTag<float> d;
  const hn::CappedTag<float, 1> single;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + kVectors * lanes <= size; i += kVectors * lanes)
    sum_at<kSums, kVectors>(d, sums, rows, i);
  for (; i + lanes <= size; i += lanes) sum_at<kSums, 1>(d, sums, rows, i);
  for (; i < size; ++i) sum_at<kSums, 1>(single, sums, rows, i);
}

void weighted_sums_lanes(std::span<const WeightedSum> sums, const float* const* rows,
                         std::size_t size) {
  if (sums.size() == 1) sum_all<1>(sums.data(), rows, size);
  if (sums.size() == 2) sum_all<2>(sums.data(), rows, size);
  if (sums.size() == 3) sum_all<3>(sums.data(), rows, size);
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(weighted_sums_lanes);

void weighted_sums(std::span<const WeightedSum> sums, const float* const* rows, std::size_t size) {
  HWY_DYNAMIC_DISPATCH(weighted_sums_lanes)(sums, rows, size);
}

}  // namespace lobelia
#endif  // HWY_ONCE
