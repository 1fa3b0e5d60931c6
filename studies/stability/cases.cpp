#include "studies/stability/cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reference_scenes/engines/analytic/formulas/definition.hpp"
#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/kernels/kernels.hpp"
#include "studies/stability/naive.hpp"

namespace lobelia::stability {
namespace {

constexpr double kSmallest = std::numeric_limits<float>::min();
/// A lobe may end a little before the smallest number, as the exponent at its end is rounded too.
constexpr double kNothing = 1.001 * kSmallest;

double unit_in_last_place(double value) {
  return std::ldexp(1.0, std::ilogb(std::max(std::abs(value), kSmallest)) - 23);
}

struct Abscissa {
  std::string name;
  float s;
};

std::vector<Abscissa> abscissae(LobeId lobe, double n) {
  // theta_cr: where a family's lobe ends, at arccos((n - k)/n) for cs_k; that of k = 16, the paper's, for the others.
  const double end = lobe.order > 0 ? s_of_value(lobe, n, 0, 60) : std::min(1.0, 16 / n);
  const auto at = [](double angle) { return float(truth::one_minus_cos(angle)); };
  std::vector<Abscissa> result{
      {"angle 0", 0},
      {"angle 1e-8", at(1e-8)},
      {"angle 1e-4", at(1e-4)},
      {"half of the peak", float(s_of_value(lobe, n, 0.5, 60))},
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
                      float(s_of_value(lobe, n, times * std::numeric_limits<float>::min(), 60))});
  return result;
}

}  // namespace

Answer judge(double value, double truth, double peak) {
  if (!std::isfinite(value)) return {value, kInfinity, kInfinity, 0};
  const double error = std::abs(value - truth);
  const bool nothing = std::abs(value) < kNothing && std::abs(truth) < kNothing;
  return {value, error / peak, nothing ? 0 : error / unit_in_last_place(truth), 0};
}

std::string_view outcome(const Row& row) {
  const Answer& ours = row.ours;
  // A NaN is outside.
  const bool holds = std::isfinite(row.truth) && ours.of_peak <= row.bound.of_peak &&
                     ours.ulp <= row.bound.ulp && ours.wrong_pixels == 0 &&
                     (ours.value == 0 || std::isnormal(ours.value));
  if (!holds) return kOutside;
  return row.bound.of_peak < 1 || std::isfinite(row.bound.ulp) ? kWithin : kNotCompared;
}

Row judged(std::string_view group, std::string_view name, const Subject& of, double truth,
           const Answer& naive, const Answer& ours, double bound_of_peak, double bound_ulp) {
  Row row{std::string(group),
          std::string(name),
          std::string(of.model),
          std::string(of.lobe),
          of.exponent,
          truth,
          naive,
          ours,
          {bound_of_peak, bound_ulp},
          ""};
  row.outcome = outcome(row);
  return row;
}

double s_of_value(LobeId lobe, double exponent, double value, int halvings) {
  double low = 0, high = 1;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (truth::lobe(lobe, middle, exponent) > value ? low : high) = middle;
  }
  return low;
}

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
      const double truth = truth::lobe(lobe, s, n);
      const double ulp = stated.ulp - (truth > 0 ? stated.ulp_per_nat * std::log(truth) : 0);
      rows.push_back(judged("lobe", name, {lobe, n}, truth,
                            judge(naive::lobe(lobe, float(1 - double(s)), n), truth, 1),
                            judge(value[0], truth, 1), stated.of_peak, ulp));
      if (value[0] != 0 && !std::isnormal(value[0])) rows.back().outcome = kOutside;
    }
  }
  return rows;
}

Rows coefficient_rows(LobeId lobe) {
  std::vector<std::pair<std::string, double>> exponents{{"smallest n: 2^(-n/2) is nearly 1", 1e-3},
                                                        {"(n+2)(n+4) overflows float32", 2e19}};
  for (const double n : kExponents) exponents.emplace_back("n = 0.1 to 1e8", n);
  Rows rows;
  for (const ModelId model : all_models())
    for (const auto& [name, n] : exponents) {
      const Highlight highlight{model, lobe, Normalisation::kExact, n};
      const double truth = truth::coefficient(model, lobe, n);
      rows.push_back(judged("coefficient", name, Subject(highlight), truth,
                            judge(naive::coefficient(highlight), truth, truth),
                            judge(radiance_coefficient(highlight), truth, truth),
                            kCoefficientBound));
    }
  return rows;
}

Rows density_rows(LobeId lobe) {
  Rows rows;
  for (const double n : kExponents) {
    const auto density = truth::density(lobe, n), ours = prepare(lobe, n).density;
    const double peak = density(0);
    for (const double nats : {0.0, 1.0, 80.0, 100.0, 700.0, 800.0}) {
      const double s = std::min(1.0, -std::expm1(-nats / n));
      const double truth = density(s);
      const float cosine = float(1 - s);
      const float naive =
          cosine > 0 ? naive::lobe(lobe, cosine, n) * draw_factor(lobe, cosine, n) * float(peak)
                     : 0;
      rows.push_back(judged("density", fmt::format("n s = {}", nats), {lobe, n}, truth,
                            judge(naive, truth, peak), judge(ours(s), truth, peak), kDensityBound));
      if (!(rows.back().ours.value >= 0)) rows.back().outcome = kOutside;
    }
  }
  return rows;
}

}  // namespace lobelia::stability
