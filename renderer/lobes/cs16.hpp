// cs16, the paper's stand-in for cos^n with four squarings and one multiply-add (eq. 1).
//
//   value(s, n) = max(0, 1 - n s / 16)^16
//
// The paper prints (n/16 (cos x - 1) + 1)^16 for x <= theta_cr = arccos((n - 16)/n), else 0, and then
// replaces theta_cr by 6/sqrt(n). We cut where the base reaches 0, which is theta_cr exactly; between
// the two the paper's even power of a small negative base is at most 4e-15. Published for n = 16..1024;
// at n = 16 it is cos^16 itself, and for n < 16 it is wider than a hemisphere, where it is cut at s = 1
// as cos^n is.
#include <boost/math/quadrature/gauss.hpp>

#include "renderer/lobes/lobe.hpp"

#if defined(LOBELIA_RENDERER_LOBES_CS16_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOBELIA_RENDERER_LOBES_CS16_HPP
#undef LOBELIA_RENDERER_LOBES_CS16_HPP
#else
#define LOBELIA_RENDERER_LOBES_CS16_HPP
#endif

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct Cs16Lobe {
  static constexpr LobeInfo kInfo{"cs16", "cs16", "max(0, 1 - n s / 16)^16",
                                  "Romanyuk et al., eq. (1)"};
  static constexpr PaperColumn kPaperColumn = PaperColumn::kCs16;

  template <class Real>
  static Real value(Real s, Real n) {
    const Real u1 = positive_part(Real(1) - n * s * Real(1.0 / 16));
    const Real u2 = u1 * u1, u4 = u2 * u2, u8 = u4 * u4;
    return u8 * u8 * step_positive(Real(1) - s);
  }

  /// With w = n s / 16: (16/n)^(j+1) times the integral of (1 - w)^16 w^j from 0 to min(1, n s_max / 16),
  /// a polynomial of degree 19 at most, for which ten Gauss points are exact. (The closed form is a sum
  /// of alternating terms that loses eight digits at n = 0.1.)
  static double moment(int j, double n, double s_max) {
    const auto integrand = [j](double w) { return std::pow(1 - w, 16) * std::pow(w, j); };
    return std::pow(16 / n, j + 1) * boost::math::quadrature::gauss<double, 10>::integrate(
                                         integrand, 0.0, std::min(1.0, n * s_max / 16));
  }
};
static_assert(Lobe<Cs16Lobe>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
