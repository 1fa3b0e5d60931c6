#include "studies/shader_check/signatures.hpp"

#include <algorithm>
#include <cmath>

namespace lobelia::shader_check {
namespace {

/// Some roundings of a float32 near 1, which is 6e-8 off at most.
constexpr double kRoundingOfCosine = 6e-7;
constexpr std::size_t kFewest = 30;
constexpr double kLeastLobe = 1e-3;  // below it the difference is one of the power
constexpr double kEdge = 1e-5;

}  // namespace

bool is_rounding_of_cosine(const Candidate& candidate, const Observed& observed) {
  const std::vector<Group> groups = groups_of(observed);
  double sum = 0, squares = 0;
  bool is_over = false;
  std::vector<double> sizes;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const double n = groups[g].exponent, step = 0.01 / n;
    const Formula formula = formula_of(candidate.highlight, n, candidate.shape);
    const std::vector<double> factors = factor_values(formula, groups[g].seen);
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const Geometry& geometry = groups[g].seen[i].as(formula.reversed);
      const double s =
          formula.angle == LobeAngle::kReflection ? geometry.s_mirror : geometry.s_half;
      if (s < step || s + step >= 1) continue;
      const double factor = candidate.fit.coefficients[g] * factors[i],
                   lobe = lobe_value(formula.lobe, s, n);
      if (factor <= 0 || lobe < kLeastLobe) continue;
      const double slope =
          (lobe_value(formula.lobe, s - step, n) - lobe_value(formula.lobe, s + step, n)) /
          (2 * step);
      if (slope <= 0) continue;
      const double difference = groups[g].values[i] / factor - lobe, off = difference / slope;
      is_over = is_over || std::abs(difference) > allowed_error(n);
      // A single rounding of the result is no more than this.
      const double result = lobe / slope * 1.2e-7;
      const double size = std::max(std::abs(off) - result, 0.0);
      sum += off, squares += off * off;
      sizes.push_back(size);
    }
  }
  // Else something other made the verdict.
  if (sizes.size() < kFewest || squares == 0 || !is_over) return false;
  const auto most = sizes.begin() + std::ptrdiff_t(0.98 * double(sizes.size() - 1));
  std::nth_element(sizes.begin(), most, sizes.end());
  const double count = double(sizes.size()), mean = sum / count, rms = std::sqrt(squares / count);
  return *most <= kRoundingOfCosine && std::abs(mean) < 0.7 * rms;
}

bool is_power_of_negative(const Candidate& candidate, const Observed& observed) {
  bool is_always = true, is_where_lit = true, is_any = false;
  for (std::size_t i = 0; i < observed.points.size(); ++i) {
    const Seen seen(observed.points[i]);
    const Formula formula =
        formula_of(candidate.highlight, observed.points[i].exponent, candidate.shape);
    const Geometry& g = seen.as(formula.reversed);
    const double cosine = formula.lobe_cosine                       ? formula.lobe_cosine(g)
                          : formula.angle == LobeAngle::kReflection ? g.mirror
                                                                    : g.n_dot_h;
    if (std::abs(cosine) < kEdge || std::abs(g.n_dot_l) < kEdge) continue;
    const bool is_nan = std::isnan(observed.values[i]);
    is_any = is_any || is_nan;
    is_always = is_always && is_nan == (cosine < 0);
    is_where_lit = is_where_lit && is_nan == (cosine < 0 && g.n_dot_l > 0);
  }
  return is_any && (is_always || is_where_lit);
}

}  // namespace lobelia::shader_check
