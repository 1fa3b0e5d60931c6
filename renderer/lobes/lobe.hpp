// A lobe is the shape of a highlight: a function of (s, n) that is 1 at s = 0, and 0 for s >= 1.
//
// s = 1 - cos(angle), which the caller computes without cancellation as |a - b|^2 / 2 for unit a, b. Subnormal
// values are 0, because processors stall on them.
//
// Lobes are compiled once for each instruction set (Highway's idiom, docs/decisions/0001), so their namespace is
// HWY_NAMESPACE. Only catalogue.hpp includes their files, and its guard, which compares with HWY_TARGET_TOGGLE,
// serves all.
#pragma once

#include <hwy/highway.h>

#include <array>
#include <concepts>
#include <numbers>

#include "renderer/highlight.hpp"
#include "renderer/real.hpp"

namespace lobelia {

struct LobeParameters {
  double exponent;                                   ///< n, at least kFlatExponent
  int order;                                         ///< k of a family of lobes; 0 otherwise
  std::shared_ptr<const Formula> formula = nullptr;  ///< of a lobe by a formula; null otherwise

  LobeParameters(double n, int k) : exponent(std::max(n, kFlatExponent)), order(k) {}
  LobeParameters(double n, const LobeId& lobe) : LobeParameters(n, lobe.order) {
    formula = lobe.formula;
  }
  explicit LobeParameters(const Highlight& h) : LobeParameters(h.exponent, h.lobe) {}
};

/// A lobe as text, for `lobelia export`.
struct LobeText {
  /// The body of a float32 function of `s` in [0, 1) and `n` that returns the value, in what GLSL, HLSL, OSL and MSL have
  /// in common: `float NAME = ...;` declares, and there is no `?:`. It may call the functions of
  /// renderer/export/gpu/geometry.txt.
  std::string body;
  /// The slope as a formula of n, if the lobe is (1 - slope s)^(n / slope): it gives the energy of every model.
  /// Empty for other lobes, and for cos^n, because the models have its coefficients.
  std::string slope;
  /// The body for half floats, where `s` is kHalfScale times as large and `n` that much smaller, so that no product is
  /// subnormal. Empty if `body` is right as it is: a function of n s alone.
  std::string half_body = {};
};
inline constexpr double kHalfScale = 1024;

/// The column of a lobe in the paper's table of coefficients.
enum class PaperColumn { kNone, kCosine, kCs16 };

/// A family of lobes: which orders it has, and how its members are named.
template <class L>
concept LobeFamily = requires(int order) {
  { L::has(order) } -> std::same_as<bool>;
  /// Ends in the order's digits for every member that is not in kOrders.
  { L::member_name(order) } -> std::same_as<std::string>;
  /// The order that is compiled in, for speed.
  { L::kUsualOrder } -> std::convertible_to<int>;
  /// The members that are not in kOrders, in words; empty if there are none.
  { L::kUnlisted } -> std::convertible_to<std::string_view>;
};

template <class L>
concept Lobe = (std::size(L::kOrders) == 0 || LobeFamily<L>)&&requires(const L& lobe,
                                                                       LobeParameters parameters,
                                                                       double s, double c, int j) {
  { L::kInfo } -> std::convertible_to<const LobeInfo&>;
  /// The listed members of a family, ascending; empty for a single lobe.
  L::kOrders;
  L(parameters);
  /// In [0, 1], non-increasing in s, 1 at s = 0; s in [0, 2]. Templated on double or SIMD lanes.
  { lobe.value(s) } -> std::same_as<double>;
  /// The textbook formula of c = cos(angle) in (0, 1], for any type of number: the truth in 113 bits, or naive in
  /// float32. Never used for a picture.
  { lobe.definition(c) } -> std::same_as<double>;
  /// The integral of value(s) s^j over s from 0 to s_max, s_max in (0, 1], j = 0..3.
  { lobe.moment(j, s) } -> std::same_as<double>;
  /// A random s in [0, 1] from a number in [0, 1), and its density.
  { lobe.sample(s) } -> std::same_as<double>;
  { lobe.density(s) } -> std::same_as<double>;
  { lobe.paper_column() } -> std::convertible_to<PaperColumn>;
  { lobe.text() } -> std::same_as<LobeText>;
  /// Derived from this lobe's float32 arithmetic.
  { lobe.float32_error() } -> std::convertible_to<Float32Error>;
};

}  // namespace lobelia
