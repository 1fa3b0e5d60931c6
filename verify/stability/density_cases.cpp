#include <cmath>
#include <limits>
#include <numbers>

#include "verify/stability/cases.hpp"
#include "verify/stability/naive.hpp"
#include "verify/truth/truth.hpp"

namespace lobelia::stability {
namespace {

/// Whether draws follow the lobe itself: their density over s then falls as the lobe does.
bool follows_the_lobe(LobeId lobe, double n) {
  const auto density = prepare(lobe, n).density;
  const double s = 0.5 / (n + 1);
  const double ratio = density(s) / density(0);
  return std::abs(ratio / truth::lobe(lobe, s, n) - 1) < 1e-12;
}

}  // namespace

Rows density_rows(LobeId lobe) {
  // Of the models the one whose energy is the integral of the lobe alone, over s from 0 to 1.
  const ModelId whole = *find_model("phong_rdf");
  Rows rows;
  for (const double n : kExponents) {
    const double in_front = truth::coefficient(whole, lobe, n) * 2 * std::numbers::pi;
    const bool follows = follows_the_lobe(lobe, n);
    const auto density = prepare(lobe, n).density;
    for (const double nats : {0.0, 1.0, 80.0, 100.0, 700.0, 800.0}) {
      const double s = std::min(1.0, -std::expm1(-nats / n));
      Row row{"density", "n s = " + std::to_string(int(nats)), "", std::string(info(lobe).name), n};
      const double value = density(s);
      constexpr double kInfinity = std::numeric_limits<double>::infinity();
      row.truth = follows ? in_front * truth::lobe(lobe, s, n) : std::nan("");
      const float naive = naive::lobe(lobe, float(1 - s), n) * float(in_front);
      row.naive = follows ? judge(naive, row.truth, in_front) : Answer{naive, 0, 0};
      row.ours = follows ? judge(value, row.truth, in_front) : Answer{value, 0, 0};
      row.bound_of_peak = follows ? kDensityBound : kInfinity;
      row.bound_ulp = kInfinity;
      row.within = is_within(row) && value >= 0;
      rows.push_back(row);
    }
  }
  return rows;
}

}  // namespace lobelia::stability
