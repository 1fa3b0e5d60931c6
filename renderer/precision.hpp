// The precision of shading a highlight. Rays always meet spheres in double precision, so that it does not change
// hits. Shading may be narrower where a bound on its error allows it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "renderer/highlight.hpp"

namespace lobelia {

enum class Precision : std::uint8_t {
  kFloat32,  ///< unit vectors are rounded to float32, the rest is float32
  kMixed,    ///< s = 1 - cos is computed in float64 and rounded; the lobe is float32
  kFloat64,  ///< everything is float64
  /// As a phone may shade: unit vectors, s and the lobe in half floats (base/pictures/half.hpp). Emulated, so its time is
  /// not a phone's, and no plan chooses it.
  kFloat16,
};
inline constexpr std::size_t kPrecisionCount = 4;

/// "float32", "mixed", "float64", "float16"
std::span<const std::string_view> precision_names();
std::string_view name(Precision precision);
std::optional<Precision> find_precision(std::string_view name);

/// The largest error that a precision may add to a picture, relative to the highlight's peak. It is a tenth of a half
/// float's step at the peak, and a third of the error of Cycles' float32.
inline constexpr double kAllowedShadingError = 1e-5;

/// Upper bound of |shaded - true| / peak, for unit vectors with |L + V| of at least `min_half_length` (0 where
/// nothing is known), which matters only to half-vector models. docs/numerics.md derives it.
double shading_error_bound(Precision precision, const Highlight& highlight, double min_half_length);

/// The narrowest precision with a bound within kAllowedShadingError.
Precision sufficient_precision(const Highlight& highlight, double min_half_length);

}  // namespace lobelia
