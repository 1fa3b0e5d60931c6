// Powers of a whole exponent by repeated squaring, for numbers and for SIMD registers.
#include <hwy/highway.h>

#if defined(LOBELIA_COST_BINARY_POWER_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_COST_BINARY_POWER_HPP
#undef LOBELIA_COST_BINARY_POWER_HPP
#else
#define LOBELIA_COST_BINARY_POWER_HPP
#endif

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

/// base^n, n >= 1, from the lowest bit of n up: floor(log2 n) squarings, and a product more for every bit of n
/// that is set after the first. `times` multiplies.
template <class Number, class Times>
HWY_INLINE Number binary_power(Number base, unsigned n, Times times) {
  for (; n % 2 == 0; n /= 2) base = times(base, base);
  Number power = base;
  for (n /= 2; n > 0; n /= 2) {
    base = times(base, base);
    if (n % 2 == 1) power = times(power, base);
  }
  return power;
}

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
