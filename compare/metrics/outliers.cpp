// The number of pixels outside a tolerance.
//
// Source:       the failure rule of `idiff` (-fail, -failpercent). The tolerance also follows the rounding
//               of the reference: a half-float picture is off by a share of each value.
// Formula:      the number of pixels with |a - b| > relative * |b| + of_peak * peak in R, G or B;
//               peak as in max_rel_peak. off_edge counts those off the tolerance's edges, on which
//               rounding may decide what a ray hits; 0 if it names no edges.
// Input:        scene-linear values, neither exposed nor clipped.
#include <cmath>

#include "base/pictures/image_values.hpp"
#include "compare/metrics/metric.hpp"

namespace lobelia {
namespace {

constexpr MetricOutput kOutliersOutputs[] = {
    {"outliers", "Pixels beyond the tolerance", Unit::kCount, Better::kLower, false,
     "pixels outside the tolerance",
     "A few pixels may be: on the silhouette and on the terminator rounding decides what a ray hits."},
    {"outliers.off_edge", "Of these, away from the edges", Unit::kCount, Better::kLower, false,
     "of these, away from the edges of the scene",
     "Not on a silhouette, a terminator or a shadow’s edge, where only rounding decides."}};

void measure_outliers(const MetricInput& input, std::span<double> values) {
  const std::span<const float> a = input.a.values(), b = input.b.values();
  const double relative = input.tolerance->relative;
  const double floor = input.tolerance->of_peak * peak_value(input.b);
  const PixelFlags& edges = input.tolerance->edges;
  std::int64_t outliers = 0, off_edge = 0;
  in_parts(a.size() / 3, 6 * sizeof(float), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = 3 * begin; i < 3 * end; i += 3) {
      if (!input.in_region(i / 3)) continue;
      bool outside = false;
      for (std::size_t j = i; j < i + 3; ++j) {
        const double reference = b[j];
        outside |= std::abs(double(a[j]) - reference) > relative * std::abs(reference) + floor;
      }
      outliers += outside;
      off_edge += outside && !edges.empty() && edges[i / 3] == 0;
    }
  });
  values[0] = double(outliers);
  values[1] = double(off_edge);
}

}  // namespace

extern constinit const Metric outliers_metric{kOutliersOutputs, Family::kRadiance,
                                              Needs::kTolerance, "idiff -fail, -failpercent",
                                              measure_outliers};

}  // namespace lobelia
