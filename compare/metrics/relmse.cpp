// Relative mean square error: every value counts by its own size, so that an error in the flank of a
// highlight is not drowned by its peak.
//
// Source:       F. Rousselle, C. Knaus, M. Zwicker, "Adaptive Sampling and Reconstruction using
//               Greedy Error Minimization", ACM Transactions on Graphics 30 (6), 2011, section 6.
// Formula:      sum (a - b)^2 / (b^2 + eps) / (3 N) over the R, G and B values of all N pixels,
//               eps = 0.01, which keeps black pixels from weighing without bound: it stands in the
//               id, because the figure means nothing without it.
// Input:        scene-linear values, neither exposed nor clipped.
// Differs:      some divide a pixel's squared error by its squared mean over the channels; here each
//               channel has its own denominator.
#include "compare/metrics/picture_part.hpp"

namespace lobelia {
namespace {

constexpr double kEpsilon = 0.01;

constexpr MetricOutput kOutputs[] = {
    {"relmse.eps=0.01", "Relative mean square difference", Unit::kPlain, Better::kLower, false,
     "mean of (a - b)^2 / (b^2 + 0.01)",
     "Each squared difference divided by the reference’s squared value plus 0.01.", 0, true}};

void measure(const MetricInput& input, std::span<double> values) {
  values[0] = mean_over<Part::kPicture>(
      input, [](double a, double b) { return (a - b) * (a - b) / (b * b + kEpsilon); });
}

}  // namespace

extern const Metric relmse_metric;
constinit const Metric relmse_metric{kOutputs, Family::kRadiance, Needs::kNothing,
                                     "Rousselle, Knaus, Zwicker 2011", measure};

}  // namespace lobelia
