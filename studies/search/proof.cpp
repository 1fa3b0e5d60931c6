#include "studies/search/minimax.hpp"

#include <algorithm>
#include <array>
#include <boost/numeric/interval.hpp>
#include <cmath>
#include <vector>

namespace lobelia::search {
namespace {

namespace bi = boost::numeric;

/// Rounds outward by a step of double after each operation, because the compiler assumes rounding to nearest and
/// moves operations across changes of the processor's rounding mode.
struct OneStepOutward : bi::interval_lib::rounded_arith_exact<double> {
  static double down(double x) { return std::nextafter(x, -HUGE_VAL); }
  static double up(double x) { return std::nextafter(x, HUGE_VAL); }
  double add_down(double a, double b) { return down(a + b); }
  double add_up(double a, double b) { return up(a + b); }
  double sub_down(double a, double b) { return down(a - b); }
  double sub_up(double a, double b) { return up(a - b); }
  double mul_down(double a, double b) { return down(a * b); }
  double mul_up(double a, double b) { return up(a * b); }
  double div_down(double a, double b) { return down(a / b); }
  double div_up(double a, double b) { return up(a / b); }
};
using Interval =
    bi::interval<double,
                 bi::interval_lib::policies<bi::interval_lib::save_state_nothing<OneStepOutward>,
                                            bi::interval_lib::checking_base<double>>>;

double magnitude(const Interval& x) { return std::max(std::abs(x.lower()), std::abs(x.upper())); }

/// cos^n at a point: evaluated in long double, whose functions are good to a few of its steps, and widened by some
/// thousand of them.
Interval target_at(double t, double v) {
  const long double x = static_cast<long double>(t) * v;
  if (x >= 1) return {0, 0};
  const long double value = v == 0 ? std::exp(-static_cast<long double>(t))
                                   : std::exp(std::log1p(-x) / static_cast<long double>(v));
  constexpr long double kWide = 1e-15L, kTiny = 1e-300L;
  return {double(value * (1 - kWide)), double(value * (1 + kWide) + kTiny)};
}

struct Box {
  double t_low, t_high, v_low, v_high;
};

/// The target falls as t grows, and as v does: (1 - t/n)^n rises with n.
Interval target_over(const Box& box) {
  return {target_at(box.t_high, box.v_high).lower(), target_at(box.t_low, box.v_low).upper()};
}

/// A function of t and v with its derivatives, at a point or over a box.
struct Jet {
  Interval f, t, v, tt, tv, vv;
};

Jet square(const Jet& a) {
  const Interval two(2);
  return {bi::square(a.f),
          two * a.f * a.t,
          two * a.f * a.v,
          two * (bi::square(a.t) + a.f * a.tt),
          two * (a.t * a.v + a.f * a.tv),
          two * (bi::square(a.v) + a.f * a.vv)};
}

/// f(y), from the values of f and of its first two derivatives over the range of y.
Jet chain(const Jet& y, const Interval& f, const Interval& first, const Interval& second) {
  return {f,
          first * y.t,
          first * y.v,
          second * bi::square(y.t) + first * y.tt,
          second * y.t * y.v + first * y.tv,
          second * bi::square(y.v) + first * y.vv};
}

/// A value that is not known at all. Products with it stay finite.
Interval anything() { return {-1e100, 1e100}; }

/// The lobe's value from y. The corners of M have no second derivative, but slopes between those beside them.
Jet outside(const Shape& shape, const Jet& y) {
  const double low = y.f.lower(), high = y.f.upper();
  Jet value;
  switch (shape.outer) {
    case Outer::kClamp:
      value = chain(y, max(y.f, Interval(0)),
                    low > 0    ? Interval(1)
                    : high < 0 ? Interval(0)
                               : Interval(0, 1),
                    low > 0 || high < 0 ? Interval(0) : anything());
      break;
    case Outer::kReciprocal: {
      const Interval reciprocal = Interval(-1) / y.f;
      value = chain(y, reciprocal, bi::square(reciprocal),
                    Interval(2) * bi::square(reciprocal) * reciprocal);
      break;
    }
    case Outer::kBits: {
      static constexpr double kLeast = -126;
      const auto piece = [](double bits) { return std::floor(std::max(bits, kLeast)); };
      const auto step = [](double whole) { return std::ldexp(1.0, int(whole)); };
      const auto at = [&](double bits) {
        return Interval(step(piece(bits))) *
               (Interval(1) + (Interval(std::max(bits, kLeast)) - piece(bits)));
      };
      value = chain(y, {at(low).lower(), at(high).upper()},
                    {low < kLeast ? 0 : step(piece(low)), step(piece(high))},
                    piece(low) == piece(high) && low >= kLeast ? Interval(0) : anything());
      break;
    }
  }
  for (int i = 0; i < shape.squarings; ++i) {
    // The square of a clamp has a second derivative on both sides of its corner: those of y^2 and of 0.
    if (i == 0 && shape.outer == Outer::kClamp && low <= 0 && high >= 0)
      value = chain(y, bi::square(value.f), Interval(2) * value.f, Interval(0, 2));
    else
      value = square(value);
  }
  return value;
}

/// y over a box, by the Taylor series about the middle, which is exact for a polynomial. Terms that cancel in y would
/// add up in the widths if their powers of t were taken one by one.
Jet inside(const Lobe& lobe, const Box& box) {
  const int degree = lobe.shape.degree, by_n = lobe.shape.by_n;
  const double t = (box.t_low + box.t_high) / 2, v = (box.v_low + box.v_high) / 2;
  const Interval dt = Interval(box.t_low, box.t_high) - t, dv = Interval(box.v_low, box.v_high) - v;
  const Interval none(0);
  Jet sum{none, none, none, none, none, none};
  for (int r = by_n; r >= 0; --r) {
    // The factor of dv^r as a polynomial of t, then of dt.
    std::array<Interval, kMostDegree + 1> series;
    series[0] = 0;
    for (int j = lobe.shape.first(); j <= degree; ++j) {
      Interval factor(0);
      for (int k = by_n; k >= r; --k)
        factor = factor * v + Interval(lobe.factor(j, k)) * (r == 0   ? 1.0
                                                             : r == 1 ? double(k)
                                                                      : k * (k - 1) / 2.0);
      series[std::size_t(j)] = factor;
    }
    if (r == 0) series[0] += lobe.shape.start();
    for (int first = 0; first < degree; ++first)
      for (int j = degree - 1; j >= first; --j)
        series[std::size_t(j)] += series[std::size_t(j) + 1] * t;
    Interval y(0), by_t(0), half_by_tt(0);
    for (int j = degree; j >= 0; --j) {
      half_by_tt = half_by_tt * dt + by_t;
      by_t = by_t * dt + y;
      y = y * dt + series[std::size_t(j)];
    }
    // Horner's rule in dv, again with derivatives. sum.vv is half of it until the end.
    sum.vv = sum.vv * dv + sum.v;
    sum.v = sum.v * dv + sum.f;
    sum.f = sum.f * dv + y;
    sum.tv = sum.tv * dv + sum.t;
    sum.t = sum.t * dv + by_t;
    sum.tt = sum.tt * dv + Interval(2) * half_by_tt;
  }
  sum.vv *= Interval(2);
  return sum;
}

/// h(x), the sum over k >= 0 of x^k / ((k+1)(k+2)), and its derivative; both grow with x, which is below kFar.
constexpr double kFar = 0.9;
std::pair<double, double> series_h(double x) {
  double h = 0, slope = 0, power = 1;  // x^k
  int k = 0;
  for (; power > 1e-13 && k < 400; ++k, power *= x) {
    h += power / ((k + 1.0) * (k + 2));
    slope += (k + 1) * power / ((k + 2.0) * (k + 3));
  }
  return {h, slope};
}

/// The target: its derivatives are -P by t and -t^2 P h(t v) by v, where P = (1 - t v)^(n-1), and follow from these.
Jet target_over(const Box& box, const Interval& value) {
  const Interval t(box.t_low, box.t_high), v(box.v_low, box.v_high);
  const Interval rest = Interval(1) - t * v, p = value / rest;
  // Their sums are cut at 1e-13, and the roundings are fewer than 400.
  constexpr double kWide = 1e-11;
  const auto [h_low, slope_low] = series_h(box.t_low * box.v_low);
  const auto [h_high, slope_high] = series_h(std::min(kFar, box.t_high * box.v_high));
  const Interval h(h_low * (1 - kWide), h_high * (1 + kWide)),
      slope(slope_low * (1 - kWide), slope_high * (1 + kWide));
  const Interval by_v = -bi::square(t) * p * h, p_by_v = t * p * (Interval(1) - t * h) / rest;
  return {value,   -p,
          by_v,    (Interval(1) - v) * p / rest,
          -p_by_v, -bi::square(t) * (p_by_v * h + p * slope * t)};
}

class BranchAndBound {
 public:
  BranchAndBound(const Lobe& lobe, const Range& range) : lobe_(lobe), range_(range) {}

  Proof run() {
    proof_.decreases = true;
    std::vector<Box> boxes{{0, kEnd, range_.v_min(), range_.v_max()}};
    // A first look, so that most boxes are left out at once.
    for (int i = 0; i <= 4000; ++i)
      for (int k = 0; k <= 4; ++k)
        look(kEnd * std::pow(i / 4000.0, 2),
             range_.v_min() + (range_.v_max() - range_.v_min()) * k / 4);
    while (!boxes.empty() && proof_.decreases) {
      const Box box = boxes.back();
      boxes.pop_back();
      if (box.t_low * box.v_low >= 1) continue;  // beyond the right angle
      proof_.decreases = ++proof_.boxes <= kMostBoxes;
      bound(box, boxes);
    }
    beyond();
    return proof_;
  }

 private:
  static constexpr double kEnd = 64;  ///< e^-64 is 0 to every error that is asked for
  static constexpr double kSmallestStep = 1e-9;
  static constexpr double kSame =
      1e-7;  ///< of the peak; less is not told apart, and float32 rounds as much
  static constexpr long kMostBoxes = 100'000;  ///< ten times those of a lobe that can be proved

  Jet error(const Box& box, const Jet& value) const {
    const Jet target = target_over(box, target_over(box));
    return {value.f - target.f,   value.t - target.t,   value.v - target.v,
            value.tt - target.tt, value.tv - target.tv, value.vv - target.vv};
  }
  void look(double t, double v) {
    if (t * v >= 1) return;
    const Interval value = outside(lobe_.shape, inside(lobe_, Box{t, t, v, v})).f;
    proof_.seen = std::max(proof_.seen, magnitude(value - target_at(t, v)));
  }

  void bound(const Box& box, std::vector<Box>& boxes) {
    const Jet y = inside(lobe_, box), value = outside(lobe_.shape, y);
    double most = magnitude(value.f - target_over(box));
    const double t = (box.t_low + box.t_high) / 2, v = (box.v_low + box.v_high) / 2;
    // Half of the widths, and a little more than the middle's rounding takes away.
    const double dt = (box.t_high - box.t_low) / 2 * (1 + 1e-9),
                 dv = (box.v_high - box.v_low) / 2 * (1 + 1e-9);
    double along_t = dt, along_v = dv * kEnd / std::max(range_.v_max(), 1e-12);
    if (box.t_high * box.v_high < kFar) {
      const Box middle{t, t, v, v};
      const Jet there = error(middle, outside(lobe_.shape, inside(lobe_, middle)));
      const Jet around = error(box, value);
      constexpr double kUp = 1 + 1e-13;
      proof_.seen = std::max(proof_.seen, magnitude(there.f));
      const double first_t = magnitude(around.t) * dt, first_v = magnitude(around.v) * dv;
      const double tt = magnitude(around.tt) * dt * dt / 2, tv = magnitude(around.tv) * dt * dv,
                   vv = magnitude(around.vv) * dv * dv / 2;
      const double second_t = magnitude(there.t) * dt + tt, second_v = magnitude(there.v) * dv + vv;
      const bool second = second_t + second_v + tv < first_t + first_v;
      along_t = second ? second_t + tv / 2 : first_t;
      along_v = second ? second_v + tv / 2 : first_v;
      most = std::min(most, (magnitude(there.f) + along_t + along_v) * kUp);
    } else {
      look(t, v);
    }
    const bool falls = y.t.upper() < 0 || (lobe_.shape.outer == Outer::kClamp && y.f.upper() < 0);
    if (!falls && t * v < 1) {
      const Box middle{t, t, v, v};
      const Jet there = inside(lobe_, middle);
      if (there.t.lower() >= 0 && outside(lobe_.shape, there).f.lower() > 0)
        proof_.decreases = false;
    }
    const bool small = box.t_high - box.t_low < kSmallestStep;
    if ((most <= std::max(kSame, proof_.seen * (1 + kSlack)) && falls) || small) {
      proof_.bound = std::max(proof_.bound, most);
      if (small && !falls) proof_.decreases = false;
      return;
    }
    if (box.v_low == box.v_high || !(along_v > along_t)) {
      boxes.push_back({t, box.t_high, box.v_low, box.v_high});
      boxes.push_back({box.t_low, t, box.v_low, box.v_high});
    } else {
      boxes.push_back({box.t_low, box.t_high, v, box.v_high});
      boxes.push_back({box.t_low, box.t_high, box.v_low, v});
    }
  }

  /// From kEnd to n: the derivative of y is t^(degree - 1) times a polynomial of w = 1/t.
  void beyond() {
    if (kEnd * range_.v_min() >= 1) return;
    const double v_max = std::min(range_.v_max(), 1 / kEnd);
    constexpr int kPieces = 64;
    const auto piece = [](double low, double high, int i) {
      const Interval width = (Interval(high) - low) / Interval(double(kPieces));
      return hull(low + width * Interval(double(i)), low + width * Interval(i + 1.0));
    };
    bool falls = true;
    for (int i = 0; i < kPieces; ++i)
      for (int k = 0; k < kPieces; ++k) {
        const Interval w = piece(0, 1 / kEnd, i), v = piece(range_.v_min(), v_max, k);
        if (w.upper() < v.lower()) continue;  // t is at most n
        Interval sum(0);
        for (int j = 1; j <= lobe_.shape.degree; ++j)
          sum = sum * w + Interval(double(j)) * lobe_.coefficient(j, v);
        falls = falls && sum.upper() < 0;
      }
    const double most =
        outside(lobe_.shape, inside(lobe_, Box{kEnd, kEnd, range_.v_min(), v_max})).f.upper();
    proof_.bound =
        std::max({proof_.bound, falls ? most : 1.0, target_at(kEnd, range_.v_min()).upper()});
    proof_.decreases = proof_.decreases && falls;
  }

  const Lobe& lobe_;
  const Range& range_;
  Proof proof_;
};

}  // namespace

Proof prove(const Lobe& lobe, const Range& range) { return BranchAndBound(lobe, range).run(); }

}  // namespace lobelia::search
