// Numbers of more digits than a double has, in several threads.
#pragma once

#include <boost/multiprecision/number.hpp>
#include <limits>

namespace lobelia::truth {

/// Boost computes the limits of a number when they are first asked for, without a lock: another thread may get them half
/// made. Before main() it does so for numbers with its default of expression templates (data_initializer in
/// cpp_bin_float.hpp, Boost 1.74): these have none. But its own logarithm and power ask for those of
/// number<Backend, et_on>. So each number has `inline const bool kXLimits = made_limits<X>();`.
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
