// Limits that judged nothing, because no layer of their type was compared.
#pragma once

#include <span>

#include "compare/set/job.hpp"
#include "compare/set/report.hpp"

namespace lobelia {

/// The metrics of these limits that judge no layer of this type, in the order given. `has_coverage`: of a Cryptomatte.
std::vector<std::string> limits_of_other_types(std::span<const MetricLimit> limits, LayerType type,
                                               bool has_coverage);

/// Throws Error(kUsage) where a limit or a warning that was given judged no picture and no layer of any pair. In a set
/// some pairs may have no such layer. Nothing is thrown where a pair fails because it could not be compared, or because a
/// layer is missing: that may be the one.
void require_judged_limits(const CompareJob& job, std::span<const PairReport> pairs);

}  // namespace lobelia
