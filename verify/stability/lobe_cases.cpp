#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/kernels/kernels.hpp"
#include "verify/stability/cases.hpp"
#include "verify/stability/naive.hpp"

namespace lobelia::stability {
namespace {

struct Abscissa {
  std::string name;
  float s;
};

/// s at which the lobe is `value`, by bisection between its middle and its end.
float s_of_value(LobeId lobe, double exponent, double value) {
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (truth::lobe(lobe, middle, exponent) > value ? low : high) = middle;
  }
  return float(low);
}

std::vector<Abscissa> abscissae(LobeId lobe, double n) {
  // theta_cr = arccos((n - k)/n); of lobes without a k the paper's, k = 16. From n = k down it is none.
  const double end = std::min(1.0, (lobe.order > 0 ? lobe.order : 16) / n);
  const auto at = [](double angle) { return float(truth::one_minus_cos(angle)); };
  std::vector<Abscissa> result{
      {"angle 0", 0},
      {"angle 1e-8", at(1e-8)},
      {"angle 1e-4", at(1e-4)},
      {"half of the peak", s_of_value(lobe, n, 0.5)},
      {"just inside theta_cr", std::nextafter(float(end), 0.0f)},
      {"inside theta_cr by 1e-4", float(end * (1 - 1e-4))},
      {"just outside theta_cr", std::nextafter(float(end), 2.0f)},
      {"angle pi/4", at(std::numbers::pi / 4)},
      {"angle pi/2 - 1e-7", at(std::numbers::pi / 2 - 1e-7)},
      {"angle pi/2", 1},
      {"angle 2", at(2)},
  };
  for (const double times : {1e6, 2.0, 0.5, 1e-6})
    result.push_back({fmt::format("{:g} times the smallest float32", times),
                      s_of_value(lobe, n, times * std::numeric_limits<float>::min())});
  return result;
}

}  // namespace

std::vector<LobeId> lobes_under_test() {
  std::vector<LobeId> lobes(all_lobes().begin(), all_lobes().end());
  for (const char* name : {"cs12", "cs1024"}) lobes.push_back(*find_lobe(name));
  return lobes;
}

Rows lobe_rows(LobeId lobe) {
  Rows rows;
  for (const double n : kExponents) {
    const Float32Error stated = lobe_float32_error(lobe, n);
    for (const auto& [name, s] : abscissae(lobe, n)) {
      alignas(64) float given[16]{}, value[16]{};
      given[0] = s;
      kernels().lobe32(lobe)({{}, lobe, Normalisation::kExact, n}, 1, given, value);
      Row row{"lobe", name, "", std::string(info(lobe).name), n};
      row.truth = truth::lobe(lobe, s, n);
      row.naive = judge(naive::lobe(lobe, float(1 - double(s)), n), row.truth, 1);
      row.ours = judge(value[0], row.truth, 1);
      row.bound_of_peak = stated.of_peak;
      row.bound_ulp = stated.ulp;
      if (row.truth > 0) row.bound_ulp -= stated.ulp_per_nat * std::log(row.truth);
      row.outcome = value[0] == 0 || std::isnormal(value[0]) ? outcome(row) : Outcome::kOutside;
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace lobelia::stability
