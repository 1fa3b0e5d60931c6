// The number that truths are computed in. For .cpp files of reference_scenes/engines/analytic/formulas/ alone: it takes seconds to
// compile. The rest of the room sees truths rounded to double.
#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <limits>

#include "reference_scenes/engines/analytic/formulas/number_limits.hpp"
#include "reference_scenes/engines/analytic/formulas/vector.hpp"

namespace lobelia::truth {

/// 50 decimal digits; no function of it is shared with the renderer, which has only those of the
/// standard library and of Highway.
using Big = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>,
                                          boost::multiprecision::et_off>;
static_assert(std::numeric_limits<Big>::digits >= 113);
inline const bool kBigLimits = made_limits<Big>();

using Big3 = Vector<Big>;

}  // namespace lobelia::truth
