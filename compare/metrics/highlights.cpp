// The worst errors of the reference's highlights, each judged against its own peak.
//
// Source:       ours.
// Formula:      compare/highlights/find.hpp says which highlights there are, judge.hpp what their errors are. Each figure is
//               the largest over all highlights, after what noise, rounding and the reference's roughness explain
//               (slack.hpp) was taken off. A highlight that the reference lacks has an error in energy of its own light.
// Input:        scene-linear values, neither exposed nor clipped.
// Why:          max_rel_peak and the figures of highlight.cpp are shares of the brightest pixel. Beside a light in view,
//               another highlight may be missing without a trace in them.
#include <algorithm>
#include <cmath>

#include "compare/metrics/metric.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kHighlightsOutputs[] = {
    {"highlights.energy", "Energy of the worst highlight", Unit::kShare, Better::kLower, false,
     "largest error in energy of any highlight, a / b - 1 over its surroundings",
     "How much the light of one highlight is off, each seen by itself."},
    {"highlights.width", "Width of the worst highlight", Unit::kShare, Better::kLower, false,
     "largest error in width of any highlight, a / b - 1",
     "How much the width of one highlight is off."},
    {"highlights.shift", "Shift of the worst highlight", Unit::kPlain, Better::kLower, false,
     "largest distance of the centroids of any highlight in pixels",
     "How far away one highlight is, in pixels."},
    {"highlights.x", "", Unit::kPlain, Better::kNeither, false,
     "place of the worst highlight: its brightest pixel"},
    {"highlights.y", "", Unit::kPlain, Better::kNeither, false, "likewise, down"},
    {"highlights.count", "", Unit::kCount, Better::kNeither, false,
     "highlights that were judged: those of the reference, and those that only a has"}};

void measure_highlights(const MetricInput& input, std::span<double> values) {
  std::ranges::fill(values, 0);
  for (const JudgedHighlight& one : input.highlights) {
    values[0] = std::max(values[0], one.errors.energy_beyond);
    values[1] = std::max(values[1], one.errors.width_beyond);
    values[2] = std::max(values[2], one.errors.shift_beyond);
  }
  values[3] = input.highlights.front().highlight->x;
  values[4] = input.highlights.front().highlight->y;
  values[5] = double(input.highlights.size());
}

}  // namespace

extern constinit const Metric highlights_metric{kHighlightsOutputs,
                                                Family::kRadiance,
                                                Needs::kHighlights,
                                                "ours",
                                                measure_highlights,
                                                "",
                                                false};

}  // namespace lobelia
