// Number types with more digits than double, in several threads.
#pragma once

#include <boost/multiprecision/number.hpp>
#include <limits>

namespace lobelia::truth {

/// Computes a number type's limits. Boost computes them at first use without a lock, so another thread may read them half
/// made. Boost's own initialiser before main() covers types with expression templates only (data_initializer in
/// cpp_bin_float.hpp, Boost 1.74). Ours have none, yet Boost's logarithm and power use the limits of number<Backend, et_on>.
/// So each type X has `inline const bool kXLimits = made_limits<X>();`.
template <class Number>
bool made_limits() {
  using Limits = std::numeric_limits<
      boost::multiprecision::number<typename Number::backend_type, boost::multiprecision::et_on>>;
  Limits::epsilon();
  Limits::round_error();
  Limits::min();
  Limits::max();
  Limits::infinity();
  Limits::quiet_NaN();
  return true;
}

}  // namespace lobelia::truth
