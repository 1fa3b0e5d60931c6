// A lobe is the shape of a highlight: a function of (s, n) that is 1 at s = 0, and 0 where s >= 1.
//
// s = 1 - cos(angle), computed by the caller as |a - b|^2 / 2 for unit a, b, which does not cancel.
// A value too small for a normal number of its precision is 0, so that no processor stalls on it.
//
// A lobe's file is compiled once for each instruction set (Highway's idiom, docs/decisions/0002), so
// its guard compares with HWY_TARGET_TOGGLE and its namespace is HWY_NAMESPACE. Elsewhere it is an
// ordinary header.
#pragma once

#include <hwy/highway.h>

#include <array>
#include <concepts>
#include <numbers>
#include <string>

#include "renderer/highlight.hpp"
#include "renderer/real.hpp"

namespace lobelia {

/// The parameters of a lobe.
struct LobeParameters {
  double exponent;  ///< n
  int order;        ///< k of a family of lobes; 0 otherwise
};

/// A lobe in the language that GLSL, HLSL and OSL have in common, for `lobelia export`.
struct LobeText {
  /// The body of a float32 function of `s` in [0, 1) and `n` that returns the value. It may call the functions of
  /// shaders/gpu/geometry.txt.
  std::string body;
  /// The slope in terms of n, if the lobe is (1 - slope s)^(n / slope). The energy of every model follows from it. Empty
  /// for other lobes, and for cos^n, because the models have its coefficients.
  std::string slope;
};

/// Which column of the paper's table of coefficients belongs to a lobe.
enum class PaperColumn { kNone, kCosine, kCs16 };

template <class L>
concept Lobe = requires(const L& lobe, LobeParameters parameters, double s, double c, int j) {
  { L::kInfo } -> std::convertible_to<const LobeInfo&>;
  /// The members of a family that lists and tables show, ascending; empty for a single lobe.
  L::kOrders;
  L(parameters);
  /// In [0, 1], non-increasing in s, 1 at s = 0; s in [0, 2]. Templated on double or SIMD lanes.
  { lobe.value(s) } -> std::same_as<double>;
  /// The same as textbooks write it, of c = cos(angle) in (0, 1], for any type of number: the truth
  /// in 113 bits, the naive formula in float32. Never used for a picture.
  { lobe.definition(c) } -> std::same_as<double>;
  /// The integral of value(s) s^j over s from 0 to s_max, s_max in (0, 1], j = 0..3.
  { lobe.moment(j, s) } -> std::same_as<double>;
  /// A random s in [0, 1] from a number in [0, 1), and the density of such s.
  { lobe.sample(s) } -> std::same_as<double>;
  { lobe.density(s) } -> std::same_as<double>;
  { lobe.paper_column() } -> std::convertible_to<PaperColumn>;
  { lobe.text() } -> std::same_as<LobeText>;
  /// As this lobe's float32 arithmetic is derived to be.
  { lobe.float32_error() } -> std::convertible_to<Float32Error>;
};

}  // namespace lobelia
