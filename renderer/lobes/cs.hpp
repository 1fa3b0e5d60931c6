// cs_k, polynomials that approximate cos^n: log2 k squarings and one multiply-add. The paper's is cs_16 (its eq.
// 1). cs_n is cos^n itself, and cs_k approaches the spherical Gaussian as k grows.
//
//   value(s) = max(0, 1 - n s / k)^k where s < 1, else 0
//
// The paper prints (n/16 (cos x - 1) + 1)^16 for x <= theta_cr = arccos((n - 16)/n), else 0, and then replaces
// theta_cr by 6/sqrt(n). We cut the lobe where the base reaches 0, exactly at theta_cr; between the two the paper's
// even power of a small negative base is at most 4e-15. Below n = k the lobe is wider than a hemisphere and is cut
// at s = 1, like cos^n. By Bernoulli's inequality it is nowhere above cos^n for n >= k.
#include <boost/math/special_functions/beta.hpp>

#include "renderer/lobes/lobe.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct CsLobe {
  static constexpr LobeInfo kInfo{"cs", "cs_k", "max(0, 1 - n s / k)^k",
                                  "(k/n)^(j+1) B(min(1, n S/k); j + 1, k + 1)",
                                  "Romanyuk et al., eq. (1), for k = 16"};
  static constexpr std::array kOrders{2, 4, 8, 16, 32, 64};
  static constexpr int kUsualOrder = 16;
  static constexpr std::string_view kUnlisted = "csK for any even K from 2 to 1024";
  static constexpr bool has(int order) {
    return order >= 2 && order <= kMaxOrder && order % 2 == 0;
  }
  static std::string member_name(int order) { return "cs" + std::to_string(order); }

  explicit CsLobe(LobeParameters p)
      : n(p.exponent),
        k(p.order),
        slope(n / k),
        support(std::min(1.0, k / n)),
        smallest64(smallest_base<double>(k)),
        smallest32(smallest_base<float>(k)) {}

  template <class Real>
  Real value(Real s) const {
    constexpr bool kNarrow = std::is_same_v<typename ScalarOf<Real>::Type, float>;
    const Real base = one_minus_product(slope, s);
    // Cut before the power: a subnormal product stalls even if it is not used.
    const Real power = to_the_k(where_less(Real(kNarrow ? smallest32 : smallest64), base, base));
    return support < 1 ? power : where_less(s, Real(1), power);
  }

  template <class Number>
  Number definition(Number c) const {
    using std::pow;
    const Number base = Number(n) / Number(k) * (c - Number(1)) + Number(1);
    return base > Number(0) ? Number(pow(base, Number(k))) : Number(0);
  }

  /// With w = n s / k, (k/n)^(j+1) times the integral of (1 - w)^k w^j: the incomplete beta function. For j = 0 and
  /// a lobe that ends before s_max, k / (n (k + 1)).
  double moment(int j, double s_max) const {
    return std::pow(k / n, j + 1) *
           boost::math::beta(j + 1.0, k + 1.0, std::min(1.0, slope * s_max));
  }

  double sample(double xi) const {
    return std::min(support, -std::expm1(std::log1p(-xi * mass) / (k + 1)) / slope);
  }
  double density(double s) const { return slope * (k + 1) / mass * value(s); }
  PaperColumn paper_column() const { return k == 16 ? PaperColumn::kCs16 : PaperColumn::kNone; }
  /// By squarings up to k = 64; a higher power would multiply the base's rounding too much.
  LobeText text() const {
    const std::string order = std::to_string(k) + ".0", slope_text = "n / " + order;
    if (k > 64)
      return {"    return exp(" + order + " * lobelia_log_one_minus(min(" + slope_text +
                  " * s, 0.999999)));\n",
              slope_text,
              "    return exp(-n * s * lobelia_log_ratio(min(" + slope_text + " * s, 0.9995)));\n"};
    // Not u: WGSL may have a type u16 one day.
    std::string body = "    float p1 = max(0.0, 1.0 - " + slope_text + " * s);\n", product;
    for (int power = 2; power <= k; power *= 2) {
      const std::string half = "p" + std::to_string(power / 2), now = "p" + std::to_string(power);
      body += "    float " + now + " = " + half + " * " + half + ";\n";
      if (k & power) product += (product.empty() ? "" : " * ") + now;
    }
    return {body + "    return " + product + ";\n", slope_text};
  }
  /// The base has two roundings, which the power multiplies by k, and the squarings add k - 1. Near the peak a
  /// rounding is half as large, because the numbers are just below 1.
  Float32Error float32_error() const { return {1.5 * 0x1p-24 * k, 3.0 * k}; }

  double n;
  int k;
  double slope, support;
  /// The integral of u^(k+1) from the lobe's end to its middle, u = 1 - n s / k.
  double mass = n > k ? 1 : -std::expm1((k + 1) * std::log1p(-slope));
  double smallest64, smallest32;  ///< smaller bases have a subnormal power

 private:
  /// By squaring, for an even k.
  template <class Real>
  Real to_the_k(Real u) const {
    Real square = u * u;
    int rest = k / 2;
    for (; rest % 2 == 0; rest /= 2) square = square * square;
    Real power = square;
    for (rest /= 2; rest > 0; rest /= 2) {
      square = square * square;
      if (rest % 2 == 1) power = power * square;
    }
    return power;
  }
};
static_assert(Lobe<CsLobe>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
