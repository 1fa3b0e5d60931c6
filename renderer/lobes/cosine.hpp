// The cosine lobe, cos^n: Phong 1975 (of the mirror angle), Blinn 1977 (of the half-vector angle).
//
//   value(s) = (1 - s)^n where s < 1, else 0
//
// The standard that the cheap lobes approximate.
#include <bit>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>

#include "renderer/lobes/lobe.hpp"

HWY_BEFORE_NAMESPACE();
namespace lobelia::HWY_NAMESPACE {

struct CosineLobe {
  static constexpr LobeInfo kInfo{"cosine", "cosine", "(1 - s)^n", "B(S; j + 1, n + 1)",
                                  "Phong 1975; Blinn 1977"};
  static constexpr std::array<int, 0> kOrders{};

  explicit CosineLobe(LobeParameters p) : n(p.exponent) {
    // Not in lobelia/highlight.hpp:
    if (n < 1 || n > 4096 || n != std::floor(n)) return;
    const unsigned whole = unsigned(n);
    if (std::bit_width(whole) + std::popcount(whole) - 2 > kMostFactors) return;
    whole_n = int(whole);
    smallest = smallest_base<float>(whole_n);
    // In it:
  }

  template <class Real>
  Real value(Real s) const {
    // Not in lobelia/highlight.hpp:
    if constexpr (requires {
                    { power_of_one_minus(s, 1, 0.0) } -> std::same_as<Real>;
                  })
      if (whole_n > 0) return power_of_one_minus(s, whole_n, smallest);
    // In it:
    return where_less(s, Real(1), exp_or_zero(Real(n) * log_one_minus(s)));
  }

  template <class Number>
  Number definition(Number c) const {
    using std::pow;
    return pow(c, Number(n));
  }

  /// The incomplete beta function; (1 - (1 - s_max)^(n+1)) / (n+1) for j = 0.
  double moment(int j, double s_max) const { return boost::math::beta(j + 1.0, n + 1, s_max); }

  double sample(double xi) const { return -std::expm1(std::log1p(-xi) / (n + 1)); }
  double density(double s) const { return (n + 1) * value(s); }
  PaperColumn paper_column() const { return PaperColumn::kCosine; }
  LobeText text() const {
    return {"    return exp(n * lobelia_log_one_minus(s));\n", "",
            "    return exp(-n * s * lobelia_log_ratio(s / 1024.0));\n"};
  }
  /// The exponent n ln(1 - s) has three roundings, which the power multiplies by the exponent.
  Float32Error float32_error() const { return {2e-7, 3, 4}; }

  double n;
  // Not in lobelia/highlight.hpp:
  int whole_n = 0;      ///< n, if few products make the power in float32 registers; else 0
  double smallest = 0;  ///< for it

 private:
  /// More are slower than logarithm and exponential.
  static constexpr int kMostFactors = 14;
  // In it:
};
static_assert(Lobe<CosineLobe>);

}  // namespace lobelia::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
