// The spherical Gaussian, the limit of cs_k for large k.
//
//   value(s) = exp(-n s) where s < 1, else 0
#include <boost/math/special_functions/gamma.hpp>

#include "renderer/lobes/lobe.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct SphericalGaussianLobe {
  static constexpr LobeInfo kInfo{"spherical_gaussian", "spherical Gaussian", "exp(-n s)",
                                  "gamma(j + 1, n S)/n^(j+1)",
                                  "Wang et al. 2009, All-frequency rendering, sec. 3"};
  static constexpr std::array<int, 0> kOrders{};

  explicit SphericalGaussianLobe(LobeParameters p) : n(p.exponent) {}

  template <class Real>
  Real value(Real s) const {
    return where_less(s, Real(1), exp_or_zero(Real(-n) * s));
  }

  template <class Number>
  Number definition(Number c) const {
    using std::exp;
    return exp(Number(n) * (c - Number(1)));
  }

  /// The incomplete gamma function; (1 - exp(-n s_max)) / n for j = 0.
  double moment(int j, double s_max) const {
    return boost::math::tgamma_lower(j + 1.0, n * s_max) / std::pow(n, j + 1);
  }

  double sample(double xi) const { return std::min(1.0, -std::log1p(-xi * mass) / n); }
  double density(double s) const { return n / mass * value(s); }
  PaperColumn paper_column() const { return PaperColumn::kNone; }
  LobeText text() const { return {"    return exp(-n * s);\n", "0.0"}; }
  Float32Error float32_error() const { return {2e-7, 3, 2}; }

  double n;
  double mass = -std::expm1(-n);
};
static_assert(Lobe<SphericalGaussianLobe>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
