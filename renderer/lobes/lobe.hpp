// What a lobe is: the shape of a highlight, a function of (s, n), value 1 at s = 0.
//
// s = 1 - cos(angle), computed by the caller as |a - b|^2 / 2 for unit a, b, which does not cancel.
//
// A lobe's file is compiled once for each instruction set (Highway's idiom, docs/decisions/0002), so
// its guard compares with HWY_TARGET_TOGGLE and its namespace is HWY_NAMESPACE. Elsewhere it is an
// ordinary header.
#pragma once

#include <hwy/highway.h>

#include <concepts>

#include "renderer/highlight.hpp"
#include "renderer/real.hpp"

namespace lobelia {

/// Which column of the paper's table of coefficients belongs to a lobe.
enum class PaperColumn { kNone, kCosine, kCs16 };

template <class L>
concept Lobe = requires(double s, double n, double s_max, int j) {
  { L::kInfo } -> std::convertible_to<const LobeInfo&>;
  /// In [0, 1], non-increasing in s, 1 at s = 0; s in [0, 2], n > 0. Templated on double or Lanes.
  { L::value(s, n) } -> std::same_as<double>;
  /// The integral of value(s, n) s^j over s from 0 to s_max, s_max in (0, 1], j = 0..3.
  { L::moment(j, n, s_max) } -> std::same_as<double>;
  { L::kPaperColumn } -> std::convertible_to<PaperColumn>;
};

}  // namespace lobelia
