#include "studies/search/minimax.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "base/system/error.hpp"
#include "base/system/module.hpp"
#include "studies/search/linear_program.hpp"

namespace lobelia::search {
namespace {

constinit ModuleFunction<decltype(::lobelia_solve)> solve{glpk_module, "lobelia_solve"};

constexpr double kNone = std::numeric_limits<double>::infinity();
/// The target falls below 1e-26 there, and the lobes must be below their errors.
constexpr double kLongest = 60, kBeyond = 1e4;

/// The least error is sought between these: a lobe with a larger one is useless, a smaller one is below the rounding of
/// double.
constexpr double kMostError = 0.5, kLeastError = 1e-12;

/// The leading coefficient, in the units of term(), is at least this far below 0.
constexpr double kLeastLeading = 1e-4;

struct Point {
  double t, v;
};

/// The y between which the value is within `error` of the target; infinite where anything is.
struct Band {
  double low, high;
};
Band band(const Shape& shape, const Point& p, double error) {
  const double target = cosine_power(p.t, p.v);
  return {target > error ? outer_inverse(shape, target - error) : -kNone,
          outer_inverse(shape, target + error)};
}

/// Where a lobe may be above 0, and so may not rise. A clamped polynomial without a square has no tail.
bool is_seen(const Shape& shape, const Point& p, double error) {
  return shape.outer == Outer::kClamp && shape.squarings == 0 ? cosine_power(p.t, p.v) >= error / 4
                                                              : p.t <= kLongest;
}

/// Where the target has fallen to `value`.
double end_of(double v, double value) {
  return v == 0 ? -std::log(value) : -std::expm1(v * std::log(value)) / v;
}

/// t^j v^r in units in which both are about 1.
constexpr double kUnitT = 10;
/// The power of t in the term of a coefficient.
int power_of_t(const Shape& shape, int index) { return index % shape.terms() + shape.first(); }
double term(const Shape& shape, const Range& range, const Point& p, int index) {
  const int j = power_of_t(shape, index), r = index / shape.terms();
  return std::pow(p.t / kUnitT, j) * std::pow(range.v_max() > 0 ? p.v / range.v_max() : 0, r);
}

constexpr int kExponents = 49;  ///< for which a lobe is looked at
std::vector<double> exponents_of(const Range& range, int count) {
  std::vector<double> v;
  if (range.least_n == range.most_n) return {range.v_max()};
  for (int i = 0; i < count; ++i)
    v.push_back(range.v_min() +
                (range.v_max() - range.v_min()) * (1 - std::cos(M_PI * i / (count - 1))) / 2);
  return v;
}

struct Program {
  double excess = kNone;  ///< by how much the bands must widen; at most 0 if they hold a polynomial
  std::vector<double> c;  ///< in the units of term()
  std::vector<Touch> touches;  ///< weights not normalised
};

/// The polynomial that is deepest inside of all bands, by the simplex method. The program that is solved is the dual one:
/// it has a row for each coefficient and a column for each of many inequalities, and so a basis that is small.
Program deepest(const Shape& shape, const Range& range, const std::vector<Point>& points,
                double error, double slope) {
  const int terms = shape.coefficients();
  const auto excess = std::size_t(terms);  // the last row
  LinearProgram program;
  program.sums.resize(excess + 1);
  program.sums[excess] = 1;
  // Adds the dual's column for the inequality: sum of factor(k) c_k - by_excess * excess <= bound. Returns the number by
  // which it was divided.
  const auto add = [&](const auto& factor, double by_excess, double bound) {
    std::vector<double>& values = program.columns.emplace_back();
    double most = by_excess;
    for (int k = 0; k < terms; ++k) {
      values.push_back(factor(k));
      most = std::max(most, std::abs(values.back()));
    }
    values.push_back(by_excess);
    for (double& value : values) value /= most;
    program.objective.push_back(-bound / most);
    return most;
  };
  // In the middle of all bands there is no deeper.
  add([](int) { return 0.0; }, 1, 1);
  struct Edge {
    Point point;
    double sign, scale;
    std::size_t column;
  };
  std::vector<Edge> edges;
  const auto add_point = [&](const Point& p, double low, double high) {
    const double width = (high - (low > -kNone ? low : outer_inverse(shape, error / 2) - 1)) / 2;
    const auto add_edge = [&](double sign, double bound) {
      const std::size_t column = program.columns.size();
      const double scale = add([&](int k) { return sign * term(shape, range, p, k); }, width,
                               sign * (bound - shape.start()));
      edges.push_back({p, sign, scale, column});
    };
    add_edge(1, high);
    if (low > -kNone) add_edge(-1, low);
  };
  for (const Point& p : points) {
    const auto [low, high] = band(shape, p, error);
    add_point(p, low, high);
  }
  // A lobe never rises.
  for (const Point& p : points)
    if (slope > 0 && p.t > 0 && is_seen(shape, p, error))
      add([&](int k) { return power_of_t(shape, k) * term(shape, range, p, k) * kUnitT / p.t; }, 0,
          -slope);
  for (const double v : exponents_of(range, kExponents)) {
    // A clamped polynomial must not reach 0 before the target has fallen to the error.
    if (shape.outer == Outer::kClamp)
      add_point({end_of(v, error), v}, 0, outer_inverse(shape, 2 * error));
    // Beyond all points the polynomial must go on falling.
    if (v * kLongest < 1)
      add(
          [&](int k) {
            return power_of_t(shape, k) == shape.degree ? term(shape, range, {kUnitT, v}, k) : 0;
          },
          0, -kLeastLeading);
  }
  LinearSolution solution;
  if (!solve(program, solution))
    throw Error(ExitCode::kInternal, "the linear program of {} has no solution", name(shape));
  Program result;
  result.excess = solution.duals[excess];
  for (std::size_t k = 0; k < excess; ++k) result.c.push_back(-solution.duals[k]);
  for (const Edge& edge : edges)
    if (const double weight = solution.x[edge.column]; weight > 1e-9)
      result.touches.push_back(
          {edge.point.t, edge.point.v, edge.sign * error, weight / edge.scale});
  return result;
}

/// A coefficient in the units of term() that is only the solver's rounding.
constexpr double kNoTerm = 1e-12;

/// With 10 digits.
Lobe in_units(const Shape& shape, const Range& range, const Program& program) {
  Lobe lobe{shape, program.c};
  for (int i = 0; i < shape.coefficients(); ++i) {
    const double unit =
        std::pow(kUnitT, power_of_t(shape, i)) * std::pow(range.v_max(), i / shape.terms());
    double& c = lobe.c[std::size_t(i)];
    if (std::abs(c) < kNoTerm) c = 0;
    c = std::strtod(fmt::format("{:.9e}", c / unit).c_str(), nullptr);
  }
  return lobe;
}

/// The least error for which the bands at the points hold a polynomial, and that.
std::pair<double, Program> least_error(const Shape& shape, const Range& range,
                                       const std::vector<Point>& points, double guess,
                                       double slope) {
  std::optional<Program> best;
  double least = 0;
  const auto excess = [&](double logarithm) {
    const double error = std::exp(logarithm);
    Program program = deepest(shape, range, points, error, slope);
    const double value = program.excess;
    if (value <= 0 && (!best || error < least)) least = error, best = std::move(program);
    return value;
  };
  double low = std::log(guess), high = low;
  const double most = std::log(kMostError), none = std::log(kLeastError);
  for (double step = 1e-3; excess(high) > 0; step *= 4) {
    if (high == most) return {kMostError, {}};
    high = std::min(high + step, most);
  }
  for (double step = 1e-3; low > none && excess(low) <= 0; step *= 4)
    low = std::max(low - step, none);
  // cos^n itself, or nearer to it than a double can tell.
  if (excess(low) <= 0) return {least, std::move(*best)};
  std::uintmax_t rounds = 60;
  boost::math::tools::toms748_solve(
      excess, low, high, [](double a, double b) { return b - a < 1e-8; }, rounds);
  return {least, std::move(*best)};
}

/// The derivative of y by t.
double slope_of(const Lobe& lobe, const Point& p) {
  double sum = 0;
  for (int j = lobe.shape.degree; j >= 1; --j) sum = sum * p.t + j * lobe.coefficient(j, p.v);
  return sum;
}

/// For each of many exponents, where along t the error of `lobe` is a maximum, and where the lobe falls least.
std::vector<Point> peaks(const Lobe& lobe, const Range& range, double most) {
  constexpr int kSteps = 1500;
  std::vector<Point> found;
  for (const double v : exponents_of(range, kExponents)) {
    const double end = v > 0 ? std::min(kLongest, 1 / v) : kLongest;
    const auto error = [&](double t) { return std::abs(lobe.value(t, v) - cosine_power(t, v)); };
    // The steps grow with t, as the lobes' scale does.
    const auto at = [&](int i) { return end * std::pow(double(i) / kSteps, 1.5); };
    double before = 0, here = error(at(1)), least = -kNone;
    std::optional<Point> flat;
    for (int i = 1; i < kSteps; ++i) {
      const double next = error(std::min(at(i + 1), end * (1 - 1e-12)));
      if (const double slope = slope_of(lobe, {at(i), v});
          slope > least && is_seen(lobe.shape, {at(i), v}, most)) {
        least = slope;
        flat = {at(i), v};
      }
      if (here >= before && here > next) {
        double low = at(i - 1), high = at(i + 1);
        for (int k = 0; k < 50; ++k) {
          const double third = (high - low) / 3;
          (error(low + third) < error(high - third) ? low : high) =
              error(low + third) < error(high - third) ? low + third : high - third;
        }
        found.push_back({(low + high) / 2, v});
      }
      before = here, here = next;
    }
    if (flat) found.push_back(*flat);
    if (lobe.shape.free_peak) found.push_back({0, v});
  }
  return found;
}

using Exact = boost::multiprecision::cpp_bin_float_50;

/// Sets weights with which the signed terms of the touches sum to 0 in 50 digits, near those that the simplex method
/// found. False if there are none, because something else than the touches stops the polynomial.
bool annihilate(const Shape& shape, std::vector<Touch>& touches) {
  const std::size_t unknowns = touches.size();
  if (unknowns == 0) return false;
  // Rows: every term, and the sum of the weights.
  std::vector<std::vector<Exact>> rows;
  for (int r = 0; r <= shape.by_n; ++r)
    for (int j = shape.first(); j <= shape.degree; ++j) {
      std::vector<Exact> row;
      for (const Touch& touch : touches)
        row.push_back((touch.error > 0 ? 1 : -1) * (j == 0 ? Exact(1) : pow(Exact(touch.t), j)) *
                      (r == 0 ? Exact(1) : pow(Exact(touch.v), r)));
      row.emplace_back(0);
      rows.push_back(std::move(row));
    }
  rows.emplace_back(unknowns + 1, Exact(1));
  // Terms that vanish at all touches, or depend on others, leave rows of zeros; touches too many keep their weights.
  std::vector<std::size_t> pivots;
  for (std::size_t column = 0; column < unknowns && pivots.size() < rows.size(); ++column) {
    const std::size_t next = pivots.size();
    std::size_t best = next;
    for (std::size_t i = next; i < rows.size(); ++i)
      if (abs(rows[i][column]) > abs(rows[best][column])) best = i;
    if (abs(rows[best][column]) < Exact(1e-30)) continue;
    std::swap(rows[next], rows[best]);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i == next) continue;
      const Exact factor = rows[i][column] / rows[next][column];
      for (std::size_t k = column; k <= unknowns; ++k) rows[i][k] -= factor * rows[next][k];
    }
    pivots.push_back(column);
  }
  std::vector<double> weights;
  for (const Touch& touch : touches) weights.push_back(touch.weight);
  const auto rest = [&](const std::vector<Exact>& row) {
    Exact sum = row[unknowns];
    for (std::size_t k = 0; k < unknowns; ++k)
      if (!std::ranges::count(pivots, k)) sum -= row[k] * touches[k].weight;
    return sum;
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Exact sum = rest(rows[i]);
    if (i >= pivots.size()) {
      if (abs(sum) > Exact(1e-25)) return false;
      continue;
    }
    const double weight = double(sum / rows[i][pivots[i]]);
    if (!(weight > 0)) return false;
    weights[pivots[i]] = weight;
  }
  for (std::size_t k = 0; k < unknowns; ++k) touches[k].weight = weights[k];
  return true;
}

/// The best of all polynomials (`slope` = 0), or of those that fall by `slope` where the lobe is not 0.
Minimax exchange(const Shape& shape, const Range& range, double slope) {
  constexpr int kRounds = 25, kPatience = 8;
  std::vector<Point> points;
  for (const double v : exponents_of(range, 5)) {
    const double end = v > 0 ? std::min(kLongest, 1 / v) : kLongest;
    for (int i = shape.first(); i <= 60; ++i)
      if (const double t = end * std::pow(i / 60.0, 1.5); t * v < 1) points.push_back({t, v});
    for (double t = kLongest; t < kBeyond && t * v < 1; t *= 1.5) points.push_back({t, v});
  }
  Minimax best;
  best.error = kNone;
  double guess = 1e-2;
  for (int round = 0, idle = 0; round < kRounds && idle < kPatience; ++round) {
    double error = 0;
    Program program;
    try {
      std::tie(error, program) = least_error(shape, range, points, guess, slope);
    } catch (const Error&) {
      break;  // points too near to each other; what was found before is good
    }
    if (program.c.empty()) return best;
    guess = error;
    const Lobe lobe = in_units(shape, range, program);
    double most = 0;
    bool falls = true;
    for (const Point& p : peaks(lobe, range, error)) {
      const double there = std::abs(lobe.value(p.t, p.v) - cosine_power(p.t, p.v));
      const bool rises = slope > 0 && p.t > 0 && is_seen(shape, p, error) && slope_of(lobe, p) >= 0;
      most = std::max(most, there);
      falls = falls && !rises;
      if (there > error * (1 + 1e-6) || rises) points.push_back(p);
    }
    if (!falls) most = kNone;
    idle = most < best.error * (1 - 1e-4) ? 0 : idle + 1;
    if (most < best.error) {
      best.lobe = lobe;
      best.error = most;
    }
    std::vector<Touch>& touches = program.touches;
    double sum = 0;
    for (const Touch& touch : touches) sum += touch.weight;
    for (Touch& touch : touches) touch.weight /= sum;
    const double bound = annihilate(shape, touches) ? lower_bound_of(shape, touches) : 0;
    if (bound > best.lower_bound) {
      best.lower_bound = bound;
      best.touches = touches;
    }
    if (falls && best.error <= best.lower_bound * (1 + 1e-4)) break;
  }
  return best;
}

}  // namespace

double lower_bound_of(const Shape& shape, const std::vector<Touch>& touches) {
  // The sum over the touches of weight * sign * y is start * sum of weight * sign whatever the coefficients are. Errors
  // below e keep it below what follows from the ends of the bands.
  double constant = 0;
  for (const Touch& touch : touches)
    constant += touch.weight * std::copysign(1.0, touch.error) * shape.start();
  const auto room = [&](double logarithm) {
    double most = 0;
    for (const Touch& touch : touches) {
      const auto [low, high] = band(shape, {touch.t, touch.v}, std::exp(logarithm));
      most += touch.weight * (touch.error > 0 ? high : -low);
    }
    return std::min(most, 1e300) - constant;
  };
  double low = std::log(1e-18), high = 0;
  if (!(room(low) < 0)) return 0;
  for (int i = 0; i < 100; ++i) (room((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  return std::exp(low);
}

Minimax minimax(const Shape& shape, const Range& range, double slope) {
  Minimax best = exchange(shape, range, slope);
  // Where not only the errors stop the polynomial, all polynomials still have a certificate.
  if (!best.lobe.c.empty() && best.lower_bound < best.error * 0.99) {
    Minimax any = exchange(shape, range, 0);
    if (any.lower_bound > best.lower_bound) {
      best.lower_bound = any.lower_bound;
      best.touches = std::move(any.touches);
    }
  }
  return best;
}

}  // namespace lobelia::search
