// The mean difference, with its sign.
//
// Source:       textbook (mean bias error).
// Formula:      sum (a - b) / (3 N) over the R, G and B values of all N pixels. Positive where `a` is
//               too bright. Noise cancels; a wrong normalisation does not.
// Input:        scene-linear values, neither exposed nor clipped; with .mask only pixels inside the mask.
// Limit:        on its size: --fail drift=0.01 asks for |drift| <= 0.01.
#include "compare/metrics/picture_part.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kDriftOutputs[] = {{"drift", "Mean difference, with its sign",
                                           Unit::kRadiance, Better::kNearZero, false,
                                           "signed mean of a - b over all RGB values",
                                           "Positive where ours is brighter; noise cancels here."}};
constexpr MetricOutput kDriftMaskOutputs[] = {
    {"drift.mask", "Mean difference with its sign, inside the mask", Unit::kRadiance,
     Better::kNearZero, false, "signed mean of a - b inside the mask",
     "Of the pixels that see a surface."}};

template <Part part>
void measure_drift(const MetricInput& input, std::span<double> values) {
  values[0] = mean_over<part>(input, [](double a, double b) { return a - b; });
}

}  // namespace

extern constinit const Metric drift_metric{kDriftOutputs, Family::kRadiance, Needs::kNothing,
                                           "textbook", measure_drift<Part::kPicture>};

extern constinit const Metric drift_mask_metric{kDriftMaskOutputs, Family::kRadiance, Needs::kMask,
                                                "textbook", measure_drift<Part::kMask>};

}  // namespace lobelia
