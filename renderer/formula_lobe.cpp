#include "renderer/formula_lobe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <limits>
#include <mutex>

namespace lobelia {
namespace {

/// Smaller values are ignored in integrals and in sampling.
constexpr double kNothing = 1e-20;
/// A narrower lobe has no digits left in s. That of cos^n with the largest n has 7e-9.
constexpr double kNarrowest = 1e-15;
/// The relative error of an integral. Its estimate is that of a rule with fewer points, and so far too large.
constexpr double kAccuracy = 1e-11;
constexpr int kMostHalvings = 150;
/// More than the roundings of a formula that is 1 at s = 0.
constexpr double kRounding = 1e-9;
/// Places where a formula is tested: each from 1e-16 to 1, at equal ratios, and as many at equal steps.
constexpr int kTested = 500;

}  // namespace

/// The lobe's upper bound by steps: from edges[i] to edges[i + 1] it is its value at edges[i].
struct FormulaLobe::Steps {
  static constexpr int kCount = 512;
  std::once_flag once;
  std::vector<double> edges, sums;  ///< sums: the integral up to each edge, as a share of the whole
};

FormulaLobe::FormulaLobe(std::shared_ptr<const Formula> formula, double exponent)
    : formula_(std::move(formula)), n_(exponent), steps_(std::make_shared<Steps>()) {}

double FormulaLobe::value(double s) const {
  if (!(s < 1)) return 0;
  const double value = formula_->evaluate(s, n_);
  // Processors stall on what is smaller.
  return value >= std::numeric_limits<double>::min() ? std::min(value, 1.0) : 0.0;
}

void FormulaLobe::values(const double* s, double* value, std::size_t count) const {
  for (std::size_t i = 0; i < count; ++i) value[i] = this->value(s[i]);
}

double FormulaLobe::reach(double value, double s_max) const {
  double above = 0, beyond = s_max;
  if (this->value(s_max) > value) return s_max;
  // By ratios down to the narrowest lobe, and then by halves.
  while (beyond > kNarrowest && this->value(beyond / 2) <= value) beyond /= 2;
  for (int step = 0; step < 60; ++step) {
    const double middle = (above + beyond) / 2;
    (this->value(middle) > value ? above : beyond) = middle;
  }
  return beyond;
}

double FormulaLobe::moment(int j, double s_max) const {
  const auto integrand = [&](double s) { return value(s) * std::pow(s, j); };
  const double half = reach(0.5, s_max), end = reach(kNothing * half, s_max);
  struct Piece {
    double begin, width, integral, error;
    bool operator<(const Piece& other) const { return error < other.error; }
  };
  const auto piece_of = [&](double begin, double width) {
    double error = 0;
    const double mean = boost::math::quadrature::gauss_kronrod<double, 21>::integrate(
        [&](double u) { return integrand(begin + width * u); }, 0.0, 1.0, 0, 0.0, &error);
    return Piece{begin, width, width * mean, width * error};
  };
  // Pieces that grow, because a formula may fall on any scale and have a tail.
  std::vector<Piece> pieces;
  double from = 0;
  for (double to = half / (1 << 16); from < end; to *= 4) {
    to = 4 * to > end ? end : to;
    pieces.push_back(piece_of(from, to - from));
    from = to;
  }
  std::make_heap(pieces.begin(), pieces.end());
  // The worst piece is halved again and again: at a corner its error falls by four each time. The roundings of a formula
  // with a large exponent do not fall, so the number of steps is bounded.
  const auto total = [&](double Piece::*what) {
    double sum = 0;
    for (const Piece& piece : pieces) sum += piece.*what;
    return sum;
  };
  for (int step = 0;
       step < kMostHalvings && total(&Piece::error) > kAccuracy * total(&Piece::integral); ++step) {
    std::pop_heap(pieces.begin(), pieces.end());
    const Piece worst = pieces.back();
    pieces.back() = piece_of(worst.begin, worst.width / 2);
    std::push_heap(pieces.begin(), pieces.end());
    pieces.push_back(piece_of(worst.begin + worst.width / 2, worst.width / 2));
    std::push_heap(pieces.begin(), pieces.end());
  }
  return total(&Piece::integral);
}

const FormulaLobe::Steps& FormulaLobe::steps() const {
  std::call_once(steps_->once, [this] {
    Steps& made = *steps_;
    const double half = reach(0.5, 1), end = reach(kNothing * half, 1);
    const double most = std::log1p(end / half);
    for (int i = 0; i <= Steps::kCount; ++i)
      made.edges.push_back(i < Steps::kCount ? half * std::expm1(most * i / Steps::kCount) : end);
    made.sums.push_back(0);
    for (int i = 0; i < Steps::kCount; ++i)
      made.sums.push_back(made.sums.back() +
                          value(made.edges[i]) * (made.edges[i + 1] - made.edges[i]));
    const double whole = made.sums.back();
    for (double& sum : made.sums) sum /= whole;
  });
  return *steps_;
}

double FormulaLobe::sample(double xi) const {
  const Steps& here = steps();
  const auto above = std::upper_bound(here.sums.begin() + 1, here.sums.end() - 1, xi);
  const std::size_t i = std::size_t(above - here.sums.begin()) - 1;
  const double share = (xi - here.sums[i]) / (here.sums[i + 1] - here.sums[i]);
  return std::min(1.0, here.edges[i] + share * (here.edges[i + 1] - here.edges[i]));
}

double FormulaLobe::density(double s) const {
  const Steps& here = steps();
  if (!(s >= 0 && s < here.edges.back())) return 0;
  const auto above = std::upper_bound(here.edges.begin() + 1, here.edges.end() - 1, s);
  const std::size_t i = std::size_t(above - here.edges.begin()) - 1;
  return (here.sums[i + 1] - here.sums[i]) / (here.edges[i + 1] - here.edges[i]);
}

std::string FormulaLobe::why_not() const {
  const auto raw = [&](double s) { return formula_->evaluate(s, n_); };
  const auto says = [&](double s, const std::string& what) {
    return fmt::format("the formula {} is no lobe: at s = {:g} and n = {:g} it {}",
                       formula_->text(), s, n_, what);
  };
  std::vector<double> places{0};
  for (int i = 0; i < kTested; ++i) {
    places.push_back(std::pow(10, -16 + 16.0 * i / kTested));
    places.push_back((i + 0.5) / kTested);
  }
  std::ranges::sort(places);
  if (const double peak = raw(0); !std::isfinite(peak))
    return says(0, "is not a finite number; it has to be 1");
  else if (std::abs(peak - 1) > kRounding)
    return says(0, fmt::format("is {:g}; it has to be 1", peak));
  // A power multiplies the rounding of its base.
  const double rounding = kRounding + 4 * std::numeric_limits<double>::epsilon() * n_;
  double lowest = 1, lowest_at = 0, rise = rounding;
  std::string rises;  // where it rises most
  for (const double s : places) {
    const double value = raw(s);
    if (!std::isfinite(value)) return says(s, "is not a finite number");
    if (value < -rounding) return says(s, fmt::format("is {:g}; it has to be 0 or more", value));
    if (value - lowest > rise) {
      rise = value - lowest;
      rises = says(s, fmt::format("is {:g}, more than the {:g} at s = {:g}; it has to fall", value,
                                  lowest, lowest_at));
    }
    if (value < lowest) lowest = value, lowest_at = s;
  }
  if (!rises.empty()) return rises;
  if (reach(0.5, 1) <= kNarrowest)
    return says(kNarrowest, "is below one half; it has to fall more slowly");
  return "";
}

}  // namespace lobelia
