#include "studies/cost/lobe_variants.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "studies/cost/lobe_lanes.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "renderer/kernels/lanes-inl.hpp"
#include "renderer/lobes/catalogue.hpp"
#include "studies/cost/binary_power.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

template <class L, class T>
void over(LobeId id, double exponent, std::size_t count, const T* s, T* value) {
  const L lobe(LobeParameters{exponent, id});
  for (std::size_t i = 0; i < count; i += LanesOf<T>::count())
    lobe.value(LanesOf<T>::load(s + i)).store(value + i);
}

template <class T>
void dispatch(LobeId id, double exponent, std::size_t count, const T* s, T* value) {
  using Over = void (*)(LobeId, double, std::size_t, const T*, T*);
  static constexpr auto kTable =
      map_types<Over>(LobesById{}, []<class L>() -> Over { return &over<L, T>; });
  kTable.at(id.index)(id, exponent, count, s, value);
}

template <class T>
void power_over(unsigned n, std::size_t count, const T* s, T* value) {
  for (std::size_t i = 0; i < count; i += LanesOf<T>::count()) {
    const LanesOf<T> c = LanesOf<T>(1.0) - LanesOf<T>::load(s + i);
    const auto times = [](LanesOf<T> a, LanesOf<T> b) HWY_ATTR { return a * b; };
    binary_power(where_less(LanesOf<T>(0.0), c, c), n, times).store(value + i);
  }
}

void lobe32(LobeId id, double exponent, std::size_t count, const float* s, float* value) {
  dispatch(id, exponent, count, s, value);
}
void lobe64(LobeId id, double exponent, std::size_t count, const double* s, double* value) {
  dispatch(id, exponent, count, s, value);
}
void power32(unsigned n, std::size_t count, const float* s, float* value) {
  power_over(n, count, s, value);
}
void power64(unsigned n, std::size_t count, const double* s, double* value) {
  power_over(n, count, s, value);
}

}  // namespace
}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(lobe32);
HWY_EXPORT(lobe64);
HWY_EXPORT(power32);
HWY_EXPORT(power64);

namespace cost {
void lobe_lanes(LobeId id, double exponent, std::size_t count, const float* s, float* value) {
  HWY_DYNAMIC_DISPATCH(lobe32)(id, exponent, count, s, value);
}
void lobe_lanes(LobeId id, double exponent, std::size_t count, const double* s, double* value) {
  HWY_DYNAMIC_DISPATCH(lobe64)(id, exponent, count, s, value);
}
void squaring_lanes(unsigned n, std::size_t count, const float* s, float* value) {
  HWY_DYNAMIC_DISPATCH(power32)(n, count, s, value);
}
void squaring_lanes(unsigned n, std::size_t count, const double* s, double* value) {
  HWY_DYNAMIC_DISPATCH(power64)(n, count, s, value);
}
}  // namespace cost
}  // namespace lobelia
#endif
