// pk3.m, a clamped cubic and m squarings: the lobe nearest to cos^n that so few operations can make. A linear program
// gives the coefficients, and an interval proof the bound of what is possible.
//
//   value(s) = max(0, 1 + q1 t + q2 t^2 + q3 t^3)^k where s < 1, else 0; t = n s, k = 2^m
//   qj = aj + bj v + cj v^2, v = 1 / max(n, 16)
//
// `lobelia search` found the coefficients (docs/cheapest_lobe.md). For every n >= 16 the error against cos^n is at most
// 3.5e-3, 4.8e-4, 5.4e-5 and 1.23e-5 of the peak for m = 1 to 4, and the lobe never rises. Below n = 16 the coefficients
// are those of n = 16.
#include <fmt/format.h>

#include <boost/math/quadrature/gauss.hpp>

#include "base/words/numbers.hpp"
#include "renderer/lobes/lobe.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct PkLobe {
  static constexpr LobeInfo kInfo{"pk", "pk3.m", "max(0, 1 + q1 n s + q2 (n s)^2 + q3 (n s)^3)^k",
                                  "sum of 10 or 30 terms by Gauss-Legendre, exact",
                                  "the cheapest for its accuracy, by a linear program"};
  static constexpr std::array kOrders{2, 4, 8, 16};
  static constexpr int kUsualOrder = 4;
  static constexpr std::string_view kUnlisted = "";
  static constexpr bool has(int order) {
    return order >= 2 && order <= 16 && !(order & (order - 1));
  }
  static std::string member_name(int order) { return fmt::format("pk3.{}", squarings(order)); }

  /// a, b and c of q1, q2 and q3.
  struct Fit {
    double a[3], b[3], c[3];
  };
  static constexpr Fit kFits[] = {{{-0.4870510102, 0.1006701317, -0.008057364014},
                                   {-0.02714573094, -0.1437461631, 0.02973722682},
                                   {0, 0, 0}},
                                  {{-0.2489836846, 0.02922607759, -0.001588107903},
                                   {-0.01710772416, -0.08697986523, 0.008609950066},
                                   {0, 0, 0}},
                                  {{-0.1249374068, 0.007678866686, -0.0002564566794},
                                   {-0.005078414538, -0.05293123069, 0.003943782166},
                                   {0.05946058577, -0.1160499687, 0.001248944705}},
                                  {{-0.06249538915, 0.001944214873, -3.675033301e-05},
                                   {-0.0006733233308, -0.03015564769, 0.001583516365},
                                   {0.01116129152, -0.01780493112, -0.01515373696}}};

  /// With the coefficients, so that it can be given as a lobe's formula.
  static std::string member_formula(int order) {
    const Fit& fit = kFits[squarings(order) - 1];
    std::string text = "max(0, 1";
    for (int j = 0; j < 3; ++j) {
      text += fmt::format(" + ({}", fit.a[j]);
      const auto add = [&](double factor, std::string_view power) {
        if (factor != 0)
          text +=
              fmt::format(" {} {}/max(n, 16){}", factor < 0 ? '-' : '+', std::abs(factor), power);
      };
      add(fit.b[j], "");
      add(fit.c[j], "^2");
      text += j == 0 ? ") n s" : fmt::format(") (n s)^{}", j + 1);
    }
    return text + ")^k";
  }

  explicit PkLobe(LobeParameters p)
      : n(p.exponent),
        k(p.order),
        smallest64(smallest_base<double>(k)),
        smallest32(smallest_base<float>(k)) {
    double power = 1;
    for (int j = 0; j < 3; ++j) {
      of_t[j] = coefficient<double>(j);
      of_s[j] = of_t[j] * (power *= n);
    }
    // The cubic falls as far as the right angle. It may rise beyond: where its derivative has a root.
    const double inside = of_t[1] * of_t[1] - 3 * of_t[0] * of_t[2];
    const double below = inside >= 0 ? of_t[1] + std::sqrt(inside) : 0;
    clamp_ends_it = base(1.0) <= 0 && (below <= 0 || -of_t[0] / (below * n) >= 2);
  }

  template <class Real>
  Real value(Real s) const {
    constexpr bool kNarrow = std::is_same_v<typename ScalarOf<Real>::Type, float>;
    Real power = base(s);
    // Cut before the power: a subnormal product stalls even if it is not used.
    power = where_less(Real(kNarrow ? smallest32 : smallest64), power, power);
    for (int i = 1; i < k; i *= 2) power = power * power;
    return clamp_ends_it ? power : where_less(s, Real(1.0), power);
  }

  template <class Number>
  Number definition(Number c) const {
    using std::pow;
    const Number t = Number(n) * (Number(1) - c);
    const Number cubic = Number(1) + coefficient<Number>(0) * t + coefficient<Number>(1) * t * t +
                         coefficient<Number>(2) * t * t * t;
    return cubic > Number(0) ? Number(pow(cubic, Number(k))) : Number(0);
  }

  double moment(int j, double s_max) const { return integral(j, std::min(s_max, support())); }

  /// Inverts the integral, from the sample of the spherical Gaussian on.
  double sample(double xi) const {
    const double end = support(), below = xi * integral(0, end);
    return root([&](double s) { return below - integral(0, s); },
                [&](double s) { return -value(s); }, end,
                std::min(end, -std::log1p(xi * std::expm1(-n * end)) / n), 1e-14 * below);
  }
  double density(double s) const { return value(s) / integral(0, support()); }
  PaperColumn paper_column() const { return PaperColumn::kNone; }

  LobeText text() const {
    std::string body = "    float t = n * s;\n";
    const Fit& fit = kFits[squarings(k) - 1];
    for (int j = 0; j < 3; ++j)
      body += fmt::format("    float q{} = {} + v * ({} + v * ({}));\n", j + 1,
                          float32_text(fit.a[j]), float32_text(fit.b[j]), float32_text(fit.c[j]));
    body += "    float p = max(0.0, 1.0 + t * (q1 + t * (q2 + t * q3)));\n";
    for (int i = 1; i < k; i *= 2) body += "    p = p * p;\n";
    body += "    return p;\n";
    return {"    float v = 1.0 / max(n, 16.0);\n" + body, "",
            fmt::format("    float v = 1.0 / max({:.1f} * n, 16.0);\n", kHalfScale) + body};
  }
  /// Near the peak the base and each squaring round by 2^-25, together k 2^-24. On the flank the roundings of the
  /// coefficients and of the steps add half of that at most: the power makes them k base^(k - 1) times as large. There is
  /// no bound in units in the last place, because the cubic has no digits left where it meets 0.
  Float32Error float32_error() const {
    return {1.5 * 0x1p-24 * k, std::numeric_limits<double>::infinity()};
  }

  double n;
  int k;
  double of_t[3];                 ///< q1, q2 and q3
  double smallest64, smallest32;  ///< smaller bases have a subnormal power

 private:
  static constexpr int squarings(int order) {
    int count = 0;
    for (; order > 1; order /= 2) ++count;
    return count;
  }

  /// q1, q2 and q3 by `j`.
  template <class Number>
  Number coefficient(int j) const {
    const Fit& fit = kFits[squarings(k) - 1];
    const Number v = Number(1) / Number(std::max(n, 16.0));
    return Number(fit.a[j]) + (Number(fit.b[j]) + Number(fit.c[j]) * v) * v;
  }

  /// The cubic, by s; for half floats, which have no room for n^3, by t, with one multiplication more.
  template <class Real>
  Real base(Real s) const {
    constexpr bool kHalf =
        !std::is_same_v<Real, double> && std::is_same_v<typename ScalarOf<Real>::Type, Real>;
    const Real t = kHalf ? Real(n) * s : s;
    const double* q = kHalf ? of_t : of_s;
    return multiply_add(multiply_add(multiply_add(Real(q[2]), t, Real(q[1])), t, Real(q[0])), t,
                        Real(1));
  }

  /// The root of a falling function of s in [0, high], by Newton's method from `s`, kept between bounds.
  template <class F, class Slope>
  static double root(F f, Slope slope, double high, double s, double tolerance) {
    double low = 0;
    for (int step = 0; step < 100; ++step) {
      const double here = f(s);
      if (std::abs(here) <= tolerance) break;
      (here > 0 ? low : high) = s;
      const double next = s - here / slope(s);
      s = next > low && next < high ? next : (low + high) / 2;
    }
    return s;
  }

  /// The s where the lobe ends. Not in the constructor, because kernels, which make many lobes, do without.
  double support() const {
    if (base(1.0) > 0) return 1;
    const auto slope = [&](double s) {
      return multiply_add(multiply_add(3 * of_s[2], s, 2 * of_s[1]), s, of_s[0]);
    };
    return root([&](double s) { return base(s); }, slope, 1, 0, 1e-15);
  }

  /// The integral of value s^j over s from 0 to `end`, which is at most support(). Exact: the integrand is a polynomial
  /// of degree 3 k + j, at most 15 or 51, and N points are exact up to degree 2 N - 1.
  double integral(int j, double end) const {
    using boost::math::quadrature::gauss;
    const auto of_part = [&](double part) { return value(end * part) * std::pow(end * part, j); };
    return end * (k <= 4 ? gauss<double, 10>::integrate(of_part, 0.0, 1.0)
                         : gauss<double, 30>::integrate(of_part, 0.0, 1.0));
  }

  double of_s[3];      ///< q1, q2 and q3 times n, n^2 and n^3
  bool clamp_ends_it;  ///< it is 0 beyond by itself, because the cubic falls as far as s = 2
};
static_assert(Lobe<PkLobe>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
