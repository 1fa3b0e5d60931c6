// Source: W. H. Press et al., "Numerical Recipes", 3rd edition, 2007, 6.2: the incomplete gamma function by its series and
// by Lentz's continued fraction. S. Bernstein, 1924; G. Bennett, "Probability Inequalities for the Sum of Independent
// Random Variables", Journal of the American Statistical Association 57 (297), 1962, (8a).
#include "studies/shader_check/bsdf/chances.hpp"

#include <algorithm>
#include <cmath>

namespace lobelia::shader_check::bsdf {
namespace {

constexpr int kMostTerms = 100'000;
constexpr double kSmall = 1e-300, kOfTerm = 1e-15;

/// Q(a, x) = 1 - P(a, x).
double upper_gamma(double a, double x) {
  const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int k = 1; k < kMostTerms && term > kOfTerm * sum; ++k) sum += term *= x / (a + k);
    return 1 - scale * sum;
  }
  double b = x + 1 - a, c = 1 / kSmall, d = 1 / b, fraction = d;
  for (int k = 1; k < kMostTerms; ++k) {
    const double factor = -k * (k - a);
    b += 2;
    d = factor * d + b;
    d = 1 / (std::abs(d) < kSmall ? kSmall : d);
    c = b + factor / c;
    if (std::abs(c) < kSmall) c = kSmall;
    fraction *= d * c;
    if (std::abs(d * c - 1) < kOfTerm) break;
  }
  return scale * fraction;
}

}  // namespace

double chance_of_chi_square(double chi_square, double freedom) {
  if (!(chi_square < 1e12)) return 0;
  if (freedom <= 0 || chi_square <= 0) return 1;
  return std::clamp(upper_gamma(freedom / 2, chi_square / 2), 0.0, 1.0);
}

double chance_of_mean(double distance, double count, double variance, double most) {
  if (!(distance > 0)) return std::isnan(distance) ? 0 : 1;
  return std::min(
      1.0, 2 * std::exp(-count * distance * distance / (2 * (variance + most * distance / 3))));
}

}  // namespace lobelia::shader_check::bsdf
