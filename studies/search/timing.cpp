#include "studies/search/search.hpp"

#include <oneapi/tbb/cache_aligned_allocator.h>

#include "studies/cost/lobe_variants.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "studies/search/timing.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using search::Outer;
using Floats = hn::ScalableTag<float>;
using Vector = hn::Vec<Floats>;

constexpr std::size_t kTogether = 4;  ///< vectors that hide each other's latency

template <Outer kOuter>
HWY_INLINE Vector outer_of(Vector y) {
  const Floats d;
  if constexpr (kOuter == Outer::kClamp) return hn::Max(y, hn::Zero(d));
  if constexpr (kOuter == Outer::kReciprocal) return hn::Div(hn::Set(d, -1.0F), y);
  // The polynomial is of 2^23 (y + 127): the number's bits.
  const auto bits = hn::ConvertTo(hn::RebindToSigned<Floats>(), hn::Max(y, hn::Set(d, 0x1p23F)));
  return hn::BitCast(d, bits);
}

template <Outer kOuter, int kDegree>
void shape_values(const float* c, int squarings, std::size_t count, const float* s, float* value) {
  const Floats d;
  const std::size_t step = hn::Lanes(d);
  for (std::size_t i = 0; i < count; i += kTogether * step) {
    Vector y[kTogether];
    for (std::size_t j = 0; j < kTogether; ++j) {
      const Vector at = hn::Load(d, s + i + j * step);
      y[j] = hn::Set(d, c[kDegree]);
      for (int k = kDegree - 1; k >= 0; --k) y[j] = hn::MulAdd(y[j], at, hn::Set(d, c[k]));
      y[j] = outer_of<kOuter>(y[j]);
    }
    for (int m = 0; m < squarings; ++m)
      for (std::size_t j = 0; j < kTogether; ++j) y[j] = hn::Mul(y[j], y[j]);
    for (std::size_t j = 0; j < kTogether; ++j) hn::Store(y[j], d, value + i + j * step);
  }
}

template <Outer kOuter>
void of_degree(int degree, const float* c, int squarings, std::size_t count, const float* s,
               float* value) {
  using Values = void (*)(const float*, int, std::size_t, const float*, float*);
  static constexpr Values kTable[search::kMostDegree] = {
      shape_values<kOuter, 1>, shape_values<kOuter, 2>, shape_values<kOuter, 3>,
      shape_values<kOuter, 4>, shape_values<kOuter, 5>};
  kTable[degree - 1](c, squarings, count, s, value);
}

void lobe_values(const search::Shape& shape, const float* c, std::size_t count, const float* s,
                 float* value) {
  const auto with = shape.outer == Outer::kClamp        ? of_degree<Outer::kClamp>
                    : shape.outer == Outer::kReciprocal ? of_degree<Outer::kReciprocal>
                                                        : of_degree<Outer::kBits>;
  with(shape.degree, c, shape.squarings, count, s, value);
}

}  // namespace
}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(lobe_values);

namespace search {

void evaluate(const Lobe& lobe, double n, std::size_t count, const float* s, float* value) {
  const double bits = lobe.shape.outer == Outer::kBits ? 0x1p23 : 1;
  const double bias = lobe.shape.outer == Outer::kBits ? 127 : 0;
  float c[kMostDegree + 1] = {float(bits * (bias + lobe.constant(1 / n)))};
  double scale = bits;
  for (int j = 1; j <= lobe.shape.degree; ++j)
    c[j] = float((scale *= n) * lobe.coefficient(j, 1 / n));
  HWY_DYNAMIC_DISPATCH(lobe_values)(lobe.shape, c, count, s, value);
}

std::vector<Times> times_of(std::span<const Lobe> lobes, const LobeId& last) {
  constexpr std::size_t kCount = 4096, kRepeats = 32;
  constexpr int kRounds = 31;
  constexpr double kExponent = 64;
  std::vector<float, oneapi::tbb::cache_aligned_allocator<float>> s(kCount), value(kCount);
  for (std::size_t i = 0; i < kCount; ++i) s[i] = float(i) / kCount;
  std::vector<std::function<void()>> cases;
  const auto add = [&](const auto& values) {
    cases.push_back([=] {
      for (std::size_t i = 0; i < kRepeats; ++i) values();
    });
  };
  const float* from = s.data();
  float* to = value.data();
  for (const Lobe& lobe : lobes) add([=, &lobe] { evaluate(lobe, kExponent, kCount, from, to); });
  add([=] { cost::lobe_lanes(last, kExponent, kCount, from, to); });
  std::vector<Times> times = interleaved(cases, kRounds);
  for (Times& t : times) t = per(t, double(kCount * kRepeats));
  return times;
}

}  // namespace search
}  // namespace lobelia
#endif
