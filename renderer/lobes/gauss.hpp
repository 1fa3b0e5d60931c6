// Gauss's bell of the angle x itself.
//
//   value(s) = exp(-n x^2 / 2), x = arccos(1 - s), where s < 1, else 0
//
// Close to cos^n both at the centre and in the tail, at the price of an inverse cosine. Its energy has no closed
// form.
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include "renderer/lobes/lobe.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct GaussLobe {
  static constexpr LobeInfo kInfo{"gauss", "Gauss", "exp(-n arccos(1 - s)^2 / 2)", "by quadrature",
                                  "Romanyuk et al., among the lobes compared"};
  static constexpr std::array<int, 0> kOrders{};

  explicit GaussLobe(LobeParameters p) : n(p.exponent) {}

  template <class Real>
  Real value(Real s) const {
    return where_less(s, Real(1), exp_or_zero(Real(-n) * half_square_of_angle(s)));
  }

  template <class Number>
  Number definition(Number c) const {
    using std::acos, std::exp;
    const Number x = acos(c);
    return exp(-Number(n) * x * x / Number(2));
  }

  /// By quadrature over x, until the bell has fallen to 1e-18. Over x / end, because Boost judges errors as if the
  /// interval had length 2.
  double moment(int j, double s_max) const {
    const double end = std::min(2 * std::asin(std::sqrt(s_max / 2)), 9.2 / std::sqrt(n));
    const auto integrand = [&](double u) {
      const double x = end * u, s = 2 * std::pow(std::sin(x / 2), 2);
      return std::exp(-n * x * x / 2) * std::pow(s, j) * std::sin(x);
    };
    using Quadrature = boost::math::quadrature::gauss_kronrod<double, 61>;
    return end * Quadrature::integrate(integrand, 0.0, 1.0, 8, 1e-13);
  }

  /// Takes x as a radius in the plane instead of an angle on the sphere, for a closed form: the density is the
  /// lobe's times x / sin x, at most pi/2.
  double sample(double xi) const {
    const double half_square = -std::log1p(-xi * mass) / n;
    return std::min(1.0, 2 * std::pow(std::sin(std::sqrt(half_square / 2)), 2));
  }
  double density(double s) const {
    const double x = 2 * std::asin(std::sqrt(s / 2));
    return n / mass * value(s) * (x > 0 ? x / std::sin(x) : 1);
  }
  PaperColumn paper_column() const { return PaperColumn::kNone; }
  LobeText text() const {
    return {
        "    // x^2/2 = s + s^2 P(s): an inverse cosine would lose a small angle, and those of many\n"
        "    // processors are rough.\n"
        "    float p = 0.0006289906971;\n"
        "    p = p * s - 0.00140708189;\n"
        "    p = p * s + 0.002161792173;\n"
        "    p = p * s - 0.0004488384646;\n"
        "    p = p * s + 0.002371639728;\n"
        "    p = p * s + 0.004988465579;\n"
        "    p = p * s + 0.01429481116;\n"
        "    p = p * s + 0.04444409844;\n"
        "    p = p * s + 0.1666666688;\n"
        "    return exp(-n * (s + s * s * p));\n",
        "",
        "    // x^2/2 = s (1 + s P(s)), as far as a half float sees P.\n"
        "    float t = s / 1024.0;\n"
        "    float p = 0.1667 + t * (0.0444 + t * (0.0143 + t * 0.0083));\n"
        "    return exp(-n * s * (1.0 + t * p));\n"};
  }
  Float32Error float32_error() const { return {2e-7, 3, 4}; }

  static constexpr double kQuarterTurn = std::numbers::pi * std::numbers::pi / 8;  ///< x^2 / 2
  double n;
  double mass = -std::expm1(-n * kQuarterTurn);
};
static_assert(Lobe<GaussLobe>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
