// The paper's formulas as the paper prints them, misprints included: O. N. Romanyuk, I. V. Abramchuk,
// S. A. Kyrylashchuk, S. O. Romanyuk, "Modelling of a specular component of colour by using
// energy-correct models of surface reflectivity" (Vinnytsia National Technical University).
//
// Written out again on purpose: the renderer's fast versions are checked against these, so nothing here comes from there.
// In long double, so that a residual of 5e-4 has ten digits left.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace lobelia::paper {

using Real = long double;

inline constexpr Real kPi = std::numbers::pi_v<Real>;
inline constexpr Real kRightAngle = kPi / 2;
inline constexpr int kFirstExponent = 16, kLastExponent = 1024;  ///< the paper's range of n

/// 1 - cos x without cancellation.
inline Real versine(Real x) {
  const Real half = std::sin(x / 2);
  return 2 * half * half;
}
inline Real degrees(Real radians) { return radians * 180 / kPi; }

// ---- the lobes, of the angle x in [0, pi/2]

inline Real cosine_lobe(Real x, Real n) {
  return x < kRightAngle ? std::exp(n * std::log1p(-versine(x))) : 0;
}

/// The base of eq. (1), n/16 (cos x - 1) + 1: negative beyond theta_cr.
inline Real cs16_base(Real x, Real n) { return 1 - n * versine(x) / 16; }
inline Real power_of_16(Real base) {
  for (int squaring = 0; squaring < 4; ++squaring) base *= base;
  return base;
}
/// Where the base of eq. (1) reaches 0: arccos((n - 16)/n), for n >= 8.
inline Real theta_cr(Real n) { return 2 * std::asin(std::sqrt(8 / n)); }
inline Real printed_theta_cr(Real n) { return 6 / std::sqrt(n); }
/// Below n = 16 it is wider than a hemisphere; it is cut there, as cos^n is.
inline Real cs16_support(Real n) { return n > 16 ? theta_cr(n) : kRightAngle; }
inline Real cs16_lobe(Real x, Real n) {
  return x <= cs16_support(n) ? power_of_16(std::max<Real>(0, cs16_base(x, n))) : 0;
}

inline Real schlick_lobe(Real x, Real n) {
  const Real c = std::cos(x);
  return c / (n * versine(x) + c);  // n - n c + c
}
inline Real gauss_lobe(Real x, Real n) { return std::exp(-n * x * x / 2); }

// ---- the table of coefficients

enum class Lobe { kCosine, kCs16 };
inline Real value(Lobe lobe, Real x, Real n) {
  return lobe == Lobe::kCosine ? cosine_lobe(x, n) : cs16_lobe(x, n);
}

using Coefficient = Real (*)(Real n);

/// A row of the table: a model, the integral that its coefficient normalises, and the two columns.
struct Row {
  std::string_view name;   ///< as the renderer's catalogue has it
  std::string_view title;  ///< for people
  bool half_angle;         ///< lobe(x/2), x being the angle of the reflected ray
  bool cosine;             ///< the integrand has cos x
  bool distribution;       ///< of normals: x is the angle of H, not of the reflected ray
  Coefficient cosine_column, cs16_column;

  Coefficient column(Lobe lobe) const {
    return lobe == Lobe::kCosine ? cosine_column : cs16_column;
  }
  /// Without N.L by definition.
  bool is_rdf() const { return !cosine && !distribution; }
};

namespace column {
inline Real phong_rdf(Real n) { return (n + 1) / (2 * kPi); }
inline Real phong_rdf_cs16(Real n) { return 1.063L * n / (2 * kPi); }
inline Real modified_phong(Real n) { return (n + 2) / (2 * kPi); }
inline Real modified_phong_cs16(Real n) { return (1.063L * n + 1) / (2 * kPi); }
inline Real blinn_phong_rdf(Real n) { return (n + 2) / (4 * kPi * (2 - std::exp2(-n / 2))); }
inline Real blinn_phong_rdf_cs16(Real n) { return (1.068L * n + 0.96L) / (8 * kPi); }
inline Real modified_blinn_phong(Real n) {
  return (n + 2) * (n + 4) / (4 * kPi * (std::exp2(-n / 2) + n));
}
inline Real modified_blinn_phong_cs16(Real n) { return (1.027L * n + 4.8L) / (8 * kPi); }
/// With 8 pi for the 4 pi that is printed.
inline Real modified_blinn_phong_corrected(Real n) { return modified_blinn_phong(n) / 2; }
}  // namespace column

enum RowNumber { kPhong, kModifiedPhong, kBlinn, kModifiedBlinn, kNdf, kHeightfield };
inline constexpr std::array<Row, 6> kRows = {{
    {"phong_rdf", "Phong (RDF)", false, false, false, column::phong_rdf, column::phong_rdf_cs16},
    {"modified_phong", "modified Phong", false, true, false, column::modified_phong,
     column::modified_phong_cs16},
    {"blinn_phong_rdf", "Blinn-Phong (RDF)", true, false, false, column::blinn_phong_rdf,
     column::blinn_phong_rdf_cs16},
    {"modified_blinn_phong", "modified Blinn-Phong", true, true, false,
     column::modified_blinn_phong, column::modified_blinn_phong_cs16},
    {"blinn_phong_ndf", "Blinn-Phong (NDF)", false, false, true, column::phong_rdf,
     column::phong_rdf_cs16},
    {"blinn_phong_heightfield", "Blinn-Phong (heightfield)", false, true, true,
     column::modified_phong, column::modified_phong_cs16},
}};

/// The cos^n column, the misprint of row 4 corrected.
inline Real true_cosine_column(const Row& row, Real n) {
  return row.cosine_column == column::modified_blinn_phong
             ? column::modified_blinn_phong_corrected(n)
             : row.cosine_column(n);
}

}  // namespace lobelia::paper
