// The number in which errors of float and double are measured. For .cpp files alone: it takes seconds to compile.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <limits>

#include "reference_scenes/engines/analytic/formulas/number_limits.hpp"

namespace lobelia::cost {

using Quad = boost::multiprecision::cpp_bin_float_quad;
static_assert(std::numeric_limits<Quad>::digits == 113);
inline const bool kQuadLimits = truth::made_limits<Quad>();

}  // namespace lobelia::cost
