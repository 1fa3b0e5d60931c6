// Schlick's rational lobe, which needs one division and no power.
//
//   value(s) = c / (n - n c + c) with c = 1 - s, that is (1 - s) / (1 - s + n s), where s < 1, else 0
//
// Near the peak it falls as cos^n does; its tail falls like 1/(n s) and reaches to the horizon.
#include <boost/math/quadrature/tanh_sinh.hpp>

#include "renderer/lobes/lobe.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct SchlickLobe {
  static constexpr LobeInfo kInfo{"schlick", "Schlick", "(1 - s) / (1 - s + n s)", "by quadrature",
                                  "Schlick 1994, A fast alternative to Phong's specular model"};
  static constexpr std::array<int, 0> kOrders{};

  explicit SchlickLobe(LobeParameters p) : n(p.exponent) {}

  template <class Real>
  Real value(Real s) const {
    const Real c = Real(1) - s;
    return where_less(Real(0), c, c / (c + Real(n) * s));
  }

  template <class Number>
  Number definition(Number c) const {
    return c / (Number(n) - Number(n) * c + c);
  }

  /// By quadrature with more points near s = 0, where the lobe falls.
  double moment(int j, double s_max) const {
    thread_local boost::math::quadrature::tanh_sinh<double> quadrature;
    const auto integrand = [&](double s) { return (1 - s) / (1 - s + n * s) * std::pow(s, j); };
    return quadrature.integrate(integrand, 0.0, s_max, 1e-14);
  }

  /// Follows 1 / (1 - s + n s), the lobe without the factor 1 - s, because only its integral has an inverse in
  /// closed form. Below n = 1 that would prefer the edge of the lobe; every s is as likely instead.
  double sample(double xi) const {
    const double m = n - 1;
    return m <= 0 ? xi : std::clamp(std::expm1(xi * std::log1p(m)) / m, 0.0, 1.0);
  }
  double density(double s) const {
    const double m = std::max(0.0, n - 1);
    return s < 1 ? (m == 0 ? 1 : m / std::log1p(m)) / (1 + m * s) : 0;
  }
  PaperColumn paper_column() const { return PaperColumn::kNone; }
  LobeText text() const {
    return {"    return (1.0 - s) / (1.0 - s + n * s);\n", "",
            "    float c = 1.0 - s / 1024.0;\n    return c / (c + n * s);\n"};
  }
  Float32Error float32_error() const { return {2e-7, 4}; }

  double n;
};
static_assert(Lobe<SchlickLobe>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
