// The number type of ground truths. For the .cpp files of this folder only, because it takes seconds to compile; everything
// else sees truths rounded to double.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <limits>

#include "reference_scenes/engines/analytic/formulas/number_limits.hpp"
#include "reference_scenes/engines/analytic/formulas/vector.hpp"

namespace lobelia::truth {

/// 50 decimal digits. It shares no function with the renderer, which uses the standard library and Highway.
using Big = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                          boost::multiprecision::et_off>;
static_assert(std::numeric_limits<Big>::digits >= 113);
inline const bool kBigLimits = made_limits<Big>();

using Big3 = Vector<Big>;

}  // namespace lobelia::truth
