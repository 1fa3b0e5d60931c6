#include "compare/profile/cosine_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <vector>

#include "core/constants.hpp"

namespace lobelia {
namespace {

constexpr double kSmallest = 1e-3, kLargest = 1e8;
// Steps small enough not to miss a single minimum of the sum of squares. A few thousand pixels suffice to locate it.
constexpr double kRatio = 1.25;
constexpr std::size_t kScanned = 4096;

/// A pixel's scale and radiance, and the logarithm of its cosine.
struct Term {
  double log_cosine, scale, radiance;
};

double log_cosine(double angle) {
  const double half_sine = std::sin(angle / 2);
  return std::log1p(-std::min(1.0, 2 * half_sine * half_sine));
}

/// The best coefficient at an exponent.
struct Best {
  double coefficient, squares;
  double score;  ///< half of minus the derivative of the squares by ln n
};

Best best_at(const std::vector<Term>& terms, double exponent, std::size_t stride = 1) {
  double ff = 0, fy = 0;
  for (std::size_t i = 0; i < terms.size(); i += stride) {
    const double f = terms[i].scale * std::exp(exponent * terms[i].log_cosine);
    ff += f * f;
    fy += f * terms[i].radiance;
  }
  Best best{ff > 0 ? fy / ff : 0, 0, 0};
  for (std::size_t i = 0; i < terms.size(); i += stride) {
    const double f = terms[i].scale * std::exp(exponent * terms[i].log_cosine);
    const double residual = terms[i].radiance - best.coefficient * f;
    best.squares += residual * residual;
    if (f > 0) best.score += residual * best.coefficient * f * exponent * terms[i].log_cosine;
  }
  return best;
}

/// The logarithm of the exponent with the least sum of squares over a few thousand pixels.
double scan(const std::vector<Term>& terms) {
  const std::size_t stride = terms.size() / kScanned + 1;
  double least = kInfinity, at = kNaN;
  for (double u = std::log(kSmallest); u <= std::log(kLargest); u += std::log(kRatio)) {
    const Best best = best_at(terms, std::exp(u), stride);
    if (best.coefficient > 0 && best.squares < least) {
      least = best.squares;
      at = u;
    }
  }
  return at;
}

/// The root of the score near `u`, or NaN.
double refine(const std::vector<Term>& terms, double u) {
  const auto score = [&](double v) { return best_at(terms, std::exp(v)).score; };
  double reach = std::log(kRatio);
  double low = u - reach, high = u + reach, at_low = score(low), at_high = score(high);
  for (int wider = 0; wider < 4 && !(at_low > 0 && at_high < 0); ++wider) {
    reach *= 2;
    if (!(at_low > 0)) at_low = score(low = u - reach);
    if (!(at_high < 0)) at_high = score(high = u + reach);
  }
  if (!(at_low > 0 && at_high < 0)) return kNaN;
  std::uintmax_t steps = 100;
  const auto [from, to] = boost::math::tools::toms748_solve(
      score, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(52), steps);
  return (from + to) / 2;
}

/// The exponent's standard error by HC3.
double standard_error(const std::vector<Term>& terms, double exponent, double coefficient) {
  // Derivatives by the relative change of the coefficient (a) and of the exponent (b).
  struct Row {
    double a, b, residual;
  };
  std::vector<Row> rows;
  double aa = 0, ab = 0, bb = 0;
  for (const Term& term : terms) {
    const double f = coefficient * term.scale * std::exp(exponent * term.log_cosine);
    const double by_exponent = f > 0 ? f * exponent * term.log_cosine : 0;
    rows.push_back({f, by_exponent, term.radiance - f});
    aa += f * f;
    ab += f * by_exponent;
    bb += by_exponent * by_exponent;
  }
  const double determinant = aa * bb - ab * ab;
  double variance = 0;
  for (const Row& row : rows) {
    const double influence = (aa * row.b - ab * row.a) / determinant;
    const double leverage =
        (bb * row.a * row.a - 2 * ab * row.a * row.b + aa * row.b * row.b) / determinant;
    const double error = influence * row.residual / std::max(1e-6, 1 - leverage);
    variance += error * error;
  }
  return exponent * std::sqrt(variance);
}

CosineFit no_fit(std::size_t pixels, std::string why) {
  return {kNaN, kNaN, kNaN, kNaN, pixels, std::move(why)};
}

}  // namespace

CosineFit fit_cosine_lobe(std::span<const LobeSample> samples) {
  std::vector<Term> terms;
  for (const LobeSample& sample : samples) {
    if (!std::isfinite(sample.radiance) || !std::isfinite(sample.angle + sample.scale))
      return no_fit(samples.size(), "a pixel of it is not finite");
    terms.push_back({log_cosine(sample.angle), sample.scale, sample.radiance});
  }
  if (terms.size() < kFewestPixelsOfALobe)
    return no_fit(terms.size(), fmt::format("it has {} pixels, too few: {} are needed",
                                            terms.size(), kFewestPixelsOfALobe));
  const double coarse = scan(terms);
  if (std::isnan(coarse)) return no_fit(terms.size(), "it holds no light");
  const double exponent = std::exp(refine(terms, coarse));
  if (!(exponent >= kSmallest && exponent <= kLargest))
    return no_fit(terms.size(), "no power of a cosine fits it better than its neighbours do");
  const Best best = best_at(terms, exponent);
  const auto within = std::size_t(std::ranges::count_if(
      terms, [&](const Term& term) { return exponent * term.log_cosine >= std::log(0.5); }));
  if (within < kFewestPixelsOfALobe)
    return no_fit(
        terms.size(),
        fmt::format("not resolved: {} of its pixels are above half of its peak, {} are needed",
                    within, kFewestPixelsOfALobe));
  double brightest = 0;
  for (const Term& term : terms)
    brightest =
        std::max(brightest, best.coefficient * term.scale * std::exp(exponent * term.log_cosine));
  return {exponent,         standard_error(terms, exponent, best.coefficient),
          best.coefficient, std::sqrt(best.squares / double(terms.size())) / brightest,
          terms.size(),     ""};
}

}  // namespace lobelia
