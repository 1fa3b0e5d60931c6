#include <cmath>
#include <limits>

#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "verify/stability/cases.hpp"
#include "verify/stability/naive.hpp"

namespace lobelia::stability {

Rows density_rows(LobeId lobe) {
  Rows rows;
  for (const double n : kExponents) {
    const auto truth = truth::density(lobe, n), ours = prepare(lobe, n).density;
    const double peak = truth(0);
    for (const double nats : {0.0, 1.0, 80.0, 100.0, 700.0, 800.0}) {
      const double s = std::min(1.0, -std::expm1(-nats / n));
      Row row{"density", "n s = " + std::to_string(int(nats)), "", std::string(info(lobe).name), n};
      row.truth = truth(s);
      const float cosine = float(1 - s);
      const float naive =
          cosine > 0 ? naive::lobe(lobe, cosine, n) * draw_factor(lobe, cosine) * float(peak) : 0;
      row.naive = judge(naive, row.truth, peak);
      row.ours = judge(ours(s), row.truth, peak);
      row.bound_of_peak = kDensityBound;
      row.bound_ulp = std::numeric_limits<double>::infinity();
      row.outcome = row.ours.value >= 0 ? outcome(row) : Outcome::kOutside;
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace lobelia::stability
