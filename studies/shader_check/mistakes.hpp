// The usual mistakes in a highlight's shader, as transformed models in double: what a shader with the mistake computes.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "studies/shader_check/points.hpp"

namespace lobelia::shader_check {

/// The parts of a model that a mistake may change. A shader has at most one mistake in each.
enum class Part : std::uint8_t { kAngle, kExponent, kLobe, kCosine, kBehind, kRounding, kCount };

/// The parts of a formula, before a coefficient. Mistakes change members.
struct Formula {
  LobeAngle angle;
  LobeId lobe;
  int cosines = 0;                                   ///< the power of N.L
  bool has_shadowing = false;                        ///< Smith's, on top of the power of N.L
  double exponent = 1;                               ///< of lobe and shadowing
  double (*lobe_cosine)(const Geometry&) = nullptr;  ///< in place of the angle's own
  bool mirrored = false;                        ///< the lobe sees the absolute value of its cosine
  double (*factor)(const Geometry&) = nullptr;  ///< in place of the power of N.L
  enum class Behind : std::uint8_t { kBlack, kSigned, kAbsolute } behind = Behind::kBlack;
  enum class Half : std::uint8_t { kNone, kCosine, kS } half = Half::kNone;
};

struct Mistake {
  std::string_view id;  ///< "cosine-twice"
  Part part;
  std::string words;                            ///< "the cosine N.L is applied twice"
  bool (*applies)(const Highlight&) = nullptr;  ///< null: always
  std::function<void(Formula&, double n)> change;
  bool of_roughness = false;  ///< only of functions that take a roughness
};
std::span<const Mistake> mistakes();

/// The lobe and the cosines of the model with these mistakes, at a point.
Formula formula_of(const Highlight& highlight, double n, std::span<const Mistake* const> made);
double shape_value(const Formula& formula, const Geometry& geometry);

/// A coefficient that is used in place of the model's own.
struct CoefficientMistake {
  std::string_view id;
  std::string words;  ///< of the id "coefficient" only the formula: "(n + 8) / (8 pi)"
  std::function<double(const Highlight& highlight, double own, double n)> value;
};
std::span<const CoefficientMistake> coefficient_mistakes();

/// A mistake in the use of the result.
struct OutputMistake {
  std::string_view id, words;
  double (*value)(double radiance);
};
std::span<const OutputMistake> output_mistakes();

/// The model's own coefficient of cos^n as a formula, with the quarter of a distribution: "(n + 1) / (8 pi)".
std::string own_coefficient_text(const Highlight& highlight);

}  // namespace lobelia::shader_check
