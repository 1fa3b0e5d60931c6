// A lobe that a scene gives by its formula, to try an idea before it gets a file here.
//
//   value(s) = the formula of s, c = 1 - s, x = arccos(c) and n where s < 1, else 0
//
// Every kernel evaluates it point by point in float64. Its energy is found by quadrature, and its samples by a table.
// Slow: `lobelia cost SCENE --level picture` shows how much.
#include "renderer/formula_lobe.hpp"
#include "renderer/lobes/lobe.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct ExpressionLobe {
  static constexpr LobeInfo kInfo{kFormulaLobe, kFormulaLobe, "the formula given", "by quadrature",
                                  "given as a formula"};
  static constexpr std::array<int, 0> kOrders{};

  explicit ExpressionLobe(const LobeParameters& p) : lobe(p.formula, p.exponent), n(p.exponent) {}

  template <class Real>
  Real value(Real s) const {
    using Scalar = typename ScalarOf<Real>::Type;
    if constexpr (std::is_same_v<Real, double>) {
      return lobe.value(s);
    } else if constexpr (std::is_same_v<Scalar, Real>) {  // a half float
      const Real value = lobe.formula().template evaluate<Real>(s, n);
      return where_less(s, Real(1), min(max(value, Real(0)), Real(1)));
    } else {
      HWY_ALIGN Scalar lanes[HWY_LANES(Scalar)];
      double wide[HWY_LANES(Scalar)];
      s.store(lanes);
      const std::size_t count = Real::count();
      std::copy_n(lanes, count, wide);
      lobe.values(wide, wide, count);
      for (std::size_t i = 0; i < count; ++i)
        lanes[i] =
            wide[i] >= double(std::numeric_limits<Scalar>::min()) ? Scalar(wide[i]) : Scalar(0);
      return Real::load(lanes);
    }
  }

  template <class Number>
  Number definition(Number c) const {
    const Number value = lobe.formula().template evaluate<Number>(Number(1) - c, n);
    return value > Number(0) ? (value < Number(1) ? value : Number(1)) : Number(0);
  }

  double moment(int j, double s_max) const { return lobe.moment(j, s_max); }
  double sample(double xi) const { return lobe.sample(xi); }
  double density(double s) const { return lobe.density(s); }
  PaperColumn paper_column() const { return PaperColumn::kNone; }
  LobeText text() const { return {formula_body(lobe.formula()), ""}; }
  /// Nobody has counted the roundings of the formula, so no precision but float64 is enough.
  Float32Error float32_error() const { return {1, 0}; }

  FormulaLobe lobe;
  double n;
};
static_assert(Lobe<ExpressionLobe>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
