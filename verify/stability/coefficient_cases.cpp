#include <cmath>
#include <limits>

#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "verify/stability/cases.hpp"
#include "verify/stability/naive.hpp"

namespace lobelia::stability {

Rows coefficient_rows(LobeId lobe) {
  std::vector<std::pair<std::string, double>> exponents{
      {"smallest n: 2^(-n/2) is nearly 1", kMinExponent}, {"(n+2)(n+4) overflows float32", 2e19}};
  for (const double n : kExponents) exponents.emplace_back("n = 0.1 to 1e8", n);
  Rows rows;
  for (const ModelId model : all_models())
    for (const auto& [name, n] : exponents) {
      const Highlight highlight{model, lobe, Normalisation::kExact, n};
      Row row{"coefficient", name, std::string(info(model).name), std::string(info(lobe).name), n};
      row.truth = truth::coefficient(model, lobe, n);
      row.naive = judge(naive::coefficient(highlight), row.truth, row.truth);
      row.ours = judge(radiance_coefficient(highlight), row.truth, row.truth);
      row.bound_of_peak = kCoefficientBound;
      row.bound_ulp = std::numeric_limits<double>::infinity();
      row.outcome = outcome(row);
      rows.push_back(row);
    }
  return rows;
}

}  // namespace lobelia::stability
