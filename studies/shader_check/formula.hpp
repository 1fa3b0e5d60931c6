// The formula of a highlight's shader in parts, each of which a mistake may change.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "studies/shader_check/points.hpp"

namespace lobelia::shader_check {

/// A point's geometry as a shader sees it that reverses none or one of its vectors; kToLight: N where L is behind.
enum class Reversed : std::uint8_t { kNone, kLight, kNormal, kEye, kToLight, kCount };
struct Seen {
  explicit Seen(const Point& point);
  Geometry geometry[std::size_t(Reversed::kCount)];
  const Geometry& as(Reversed reversed) const { return geometry[std::size_t(reversed)]; }
};

/// Schlick's (1 - V.H)^5.
double fresnel_power(const Geometry& geometry);

/// A formula before its coefficient: lobe * cosine * geometry term * floor of the denominator * Fresnel.
struct Formula {
  // The lobe.
  LobeAngle angle;
  LobeId lobe;
  double exponent = 1;                               ///< of lobe and geometry term
  double (*lobe_cosine)(const Geometry&) = nullptr;  ///< in place of the angle's own
  bool mirrored = false;    ///< the lobe sees the absolute value of its cosine
  double least_cosine = 0;  ///< max(cosine, this)
  enum class Half : std::uint8_t { kNone, kCosine, kS } half = Half::kNone;
  // What it is multiplied by. `light` is N.L, or what stands for it behind the surface.
  double (*cosine)(double light, const Geometry&) = nullptr;
  double (*geometry_term)(double n_dot_l, double n_dot_v, const Geometry&,
                          double exponent) = nullptr;  ///< G / ((N.L) (N.V)); null: 1
  double least_product = 0, more_product = 0;  ///< max(4 (N.L) (N.V), least) + more, in its place
  double f0 = -1;                              ///< of Schlick's Fresnel factor; below 0: none
  double (*fresnel)(const Geometry&) = fresnel_power;
  enum class Behind : std::uint8_t {
    kBlack,
    kSigned,
    kAbsolute,
    kLeast,
    kReversed,
    kReversedAbsolute
  } behind = Behind::kBlack;
  double least_light = 0;  ///< max(N.L, this), for kLeast
  Reversed reversed = Reversed::kNone;
};

/// Of the model itself at an exponent.
Formula own_formula(const Highlight& highlight, double exponent);

/// The lobe, and all by which it is multiplied, at each point.
std::vector<double> lobe_values(const Formula& formula, std::span<const Seen> points);
std::vector<double> factor_values(const Formula& formula, std::span<const Seen> points);
/// Their product.
std::vector<double> shape_values(const Formula& formula, std::span<const Seen> points);

/// Height-correlated Smith shadowing of GGX, over (N.L) (N.V).
double smith_term(double n_dot_l, double n_dot_v, const Geometry& geometry, double exponent);

}  // namespace lobelia::shader_check
