// Relative mean square error: each error counts relative to its value, so that errors in the flank of a
// highlight are visible beside those of its peak.
//
// Source:       F. Rousselle, C. Knaus, M. Zwicker, "Adaptive Sampling and Reconstruction using
//               Greedy Error Minimization", ACM Transactions on Graphics 30 (6), 2011, section 6.
// Formula:      sum (a - b)^2 / (b^2 + eps) / (3 N) over the R, G and B values of all N pixels. eps = 0.01
//               bounds the weight of black pixels. The id names it, for figures depend on it.
// Input:        scene-linear values, neither exposed nor clipped.
// Differs:      some tools divide by the squared mean of a pixel's channels; here each channel has its own
//               denominator.
#include "compare/metrics/picture_part.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kRelmseOutputs[] = {
    {"relmse.eps=0.01", "Relative mean square difference", Unit::kPlain, Better::kLower, false,
     "mean of (a - b)^2 / (b^2 + 0.01)",
     "Each squared difference divided by the reference’s squared value plus 0.01.", 0, true}};

void measure_relmse(const MetricInput& input, std::span<double> values) {
  const auto errors = value_errors(input);
  values[0] = errors->mean(errors->relative);
}

}  // namespace

extern constinit const Metric relmse_metric{kRelmseOutputs,  Family::kRadiance,
                                            Needs::kNothing, "Rousselle, Knaus, Zwicker 2011",
                                            measure_relmse,  kValueErrors};

}  // namespace lobelia
