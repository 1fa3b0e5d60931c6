// The distribution of Trowbridge and Reitz, known as GGX, over its peak.
//
//   value(s) = (1 + n s (2 - s) / 2)^-2 where s < 1, else 0
//
// As printed, alpha^4 / (c^2 (alpha^2 - 1) + 1)^2 with alpha^2 = 2 / (n + 2), which is Blinn-Phong's width for this
// exponent: both have the peak (n + 2) / (2 pi) as the distribution of a heightfield. The tail falls like 1 / s^2.
#include <boost/math/quadrature/tanh_sinh.hpp>

#include "renderer/lobes/lobe.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct GgxLobe {
  static constexpr LobeInfo kInfo{"ggx", "GGX", "1 / (1 + n s (2 - s) / 2)^2", "by quadrature",
                                  "Trowbridge and Reitz 1975; Walter et al. 2007, eq. 33"};
  static constexpr std::array<int, 0> kOrders{};

  explicit GgxLobe(LobeParameters p) : n(p.exponent) {}

  template <class Real>
  Real value(Real s) const {
    const Real share = Real(1) / multiply_add(Real(n / 2) * s, Real(2) - s, Real(1));
    return where_less(s, Real(1), share * share);
  }

  template <class Number>
  Number definition(Number c) const {
    const Number alpha_squared = Number(2) / (Number(n) + Number(2));
    const Number share = alpha_squared / (c * c * (alpha_squared - Number(1)) + Number(1));
    return share * share;
  }

  /// By quadrature with more points near s = 0, where the lobe falls.
  double moment(int j, double s_max) const {
    thread_local boost::math::quadrature::tanh_sinh<double> quadrature;
    const auto integrand = [&](double s) { return value(s) * std::pow(s, j); };
    return quadrature.integrate(integrand, 0.0, s_max, 1e-14);
  }

  /// Follows (1 + n s / 2)^-2, which is nowhere below the lobe, because only its integral has an inverse in closed form.
  double sample(double xi) const { return xi / (1 + n / 2 * (1 - xi)); }
  double density(double s) const {
    const double bracket = 1 + n / 2 * s;
    return s < 1 ? (1 + n / 2) / (bracket * bracket) : 0;
  }
  PaperColumn paper_column() const { return PaperColumn::kNone; }
  LobeText text() const {
    return {
        "    float share = 1.0 / (1.0 + 0.5 * n * s * (2.0 - s));\n    return share * share;\n", "",
        "    float share = 1.0 / (1.0 + n * s * (1.0 - s / 2048.0));\n    return share * share;\n"};
  }
  Float32Error float32_error() const { return {3e-7, 8}; }

  double n;
};
static_assert(Lobe<GgxLobe>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
