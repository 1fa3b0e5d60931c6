#include "renderer/precision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/pictures/half.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace {

constexpr std::string_view kNames[] = {"float32", "mixed", "float64", "float16"};
static_assert(std::size(kNames) == kPrecisionCount);
/// The largest relative error of one rounding.
constexpr double kUnit16 = 0x1p-11, kUnit32 = 0x1p-24, kUnit64 = 0x1p-53;

/// The error of the difference of the lobe's two unit vectors, in roundings. docs/numerics.md counts them.
double roundings(LobeAngle angle, double min_half_length) {
  return angle == LobeAngle::kReflection ? 20 : 5 + 4 / min_half_length;
}

/// The largest change of the lobe if the length of that difference, its chord, changes by `absolute + relative *
/// chord`.
double modulus(const Highlight& highlight, double absolute, double relative) {
  const auto value = [&](double chord) {
    return lobe_value(highlight.lobe, chord * chord / 2, highlight.exponent);
  };
  const auto change = [&](double chord) {
    const double step = absolute + relative * chord;
    // The step is infinite where half vectors may vanish, but no chord is longer than 2, and lobe_value() ends there.
    return value(std::max(0.0, chord - step)) - value(std::min(2.0, chord + step));
  };
  // On the lobe's scale, a chord of 1/sqrt(n), 64 points find the steepest place to a few per cent. The right angle,
  // where every lobe ends, is one more point.
  constexpr int kPoints = 64;
  const double end = std::min(std::numbers::sqrt2, 6 / std::sqrt(highlight.exponent));
  double most = change(std::numbers::sqrt2);
  for (int i = 1; i <= kPoints; ++i) most = std::max(most, change(end * i / kPoints));
  return 1.05 * most;
}

}  // namespace

std::span<const std::string_view> precision_names() { return kNames; }
std::string_view name(Precision precision) { return kNames[std::size_t(precision)]; }
std::optional<Precision> find_precision(std::string_view name) {
  return find_id<Precision>(kNames, name);
}

double shading_error_bound(Precision precision, const Highlight& highlight,
                           double min_half_length) {
  const double roundings_here = roundings(info(highlight.model).angle, min_half_length);
  const double in_float64 = modulus(highlight, roundings_here * kUnit64, 0);
  // The lobe's arithmetic, and the product with N.L in float64.
  const double in_lobe =
      lobe_float32_error(highlight.lobe, highlight.exponent).of_peak + 2 * kUnit64;
  switch (precision) {
    case Precision::kFloat32:
      return modulus(highlight, roundings_here * kUnit32, 0) + in_lobe;
    case Precision::kMixed:
      return in_float64 + modulus(highlight, 0, kUnit32) + in_lobe;
    case Precision::kFloat16: {
      if (highlight.exponent > kGreatestHalf) return std::numeric_limits<double>::infinity();
      // One more rounding for subnormal squares: s is off by 2.5 * 2^-25 at most, and so its chord by 0.8 * 2^-11. Twice
      // the lobe's arithmetic, because its constants are rounded too.
      const double in_vectors = modulus(highlight, (roundings_here + 1) * kUnit16, 2 * kUnit16);
      return in_vectors + 2 * in_lobe * (kUnit16 / kUnit32);
    }
    case Precision::kFloat64:
      break;
  }
  return in_float64 + in_lobe * (kUnit64 / kUnit32) + 8 * kUnit64;
}

Precision sufficient_precision(const Highlight& highlight, double min_half_length) {
  for (const Precision p : {Precision::kFloat32, Precision::kMixed})
    if (shading_error_bound(p, highlight, min_half_length) <= kAllowedShadingError) return p;
  return Precision::kFloat64;
}

}  // namespace lobelia
