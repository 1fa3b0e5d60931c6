#include "bench/lobe_lanes.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/lobe_lanes.cpp"
#include <hwy/foreach_target.h>  // includes this file again for each instruction set
#include <hwy/highway.h>

#include "renderer/kernels/lanes-inl.hpp"
#include "renderer/lobes/catalogue.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {
namespace {

template <class L, class T>
void over(LobeId id, double exponent, std::size_t count, const T* s, T* value) {
  const L lobe({exponent, id.order});
  for (std::size_t i = 0; i < count; i += LanesOf<T>::count())
    lobe.value(LanesOf<T>::load(s + i)).store(value + i);
}

template <class T>
void dispatch(LobeId id, double exponent, std::size_t count, const T* s, T* value) {
  using Over = void (*)(LobeId, double, std::size_t, const T*, T*);
  static constexpr auto kTable =
      map_types<Over>(Lobes{}, []<class L>() -> Over { return &over<L, T>; });
  kTable.at(id.index)(id, exponent, count, s, value);
}

void lobe32(LobeId id, double exponent, std::size_t count, const float* s, float* value) {
  dispatch(id, exponent, count, s, value);
}
void lobe64(LobeId id, double exponent, std::size_t count, const double* s, double* value) {
  dispatch(id, exponent, count, s, value);
}

}  // namespace
}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lobelia {

HWY_EXPORT(lobe32);
HWY_EXPORT(lobe64);

namespace bench {
void lobe_lanes(LobeId id, double exponent, std::size_t count, const float* s, float* value) {
  HWY_DYNAMIC_DISPATCH(lobe32)(id, exponent, count, s, value);
}
void lobe_lanes(LobeId id, double exponent, std::size_t count, const double* s, double* value) {
  HWY_DYNAMIC_DISPATCH(lobe64)(id, exponent, count, s, value);
}
}  // namespace bench
}  // namespace lobelia
#endif
