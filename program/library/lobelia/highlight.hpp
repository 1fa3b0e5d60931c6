// Specular highlights: lobes, models, and coefficients that make their energy 1. Copy this file; it needs C++17 and nothing else.
//
//   using namespace lobelia::highlight;
//   const Highlight<BlinnPhongNdf, GgxLobe> shiny(64);                 // model, lobe, exponent
//   const Highlight<PhongRdf, CsLobe> cheap(64, 16);                   // a family of lobes also has an order
//   float light = shiny.radiance(normal, to_eye, to_light);            // Vector3<float>, unit, all away from the surface
//   double same = cheap.radiance_at(n_dot_l, n_dot_v, s);                 // s = 1 - cos of the lobe's angle
//
// radiance() is per unit irradiance normal to the beam, 1/sr, with N.L where the model has it: do not multiply by N.L again.
// Fresnel's factor and the colour are yours.
//
// Promised, and tested against the library for exponents of 0 to 1e8: in double, lobes to 1e-12 of their peak and coefficients
// to 1e-12 of themselves; in float, lobes to the error that `lobelia verify stability` allows float32.
//
// Made by `make headers` from Lobelia's renderer: edit that. Copyright (c) The Lobelia authors. SPDX-License-Identifier: MIT
// clang-format off
#ifndef LOBELIA_HIGHLIGHT_HPP
#define LOBELIA_HIGHLIGHT_HPP

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <type_traits>

namespace lobelia {
namespace highlight {

struct LobeParameters {
  double exponent;  ///< n; tiny for 0, by which closed forms cannot divide
  int order;        ///< k of a family of lobes: 2, 4, ... 1024 of cs_k; 2, 4, 8 or 16 of pk3.m, k = 2^m
  LobeParameters(double n, int k = 0) : exponent(std::max(n, 1e-60)), order(k) {}
};

/// The angle that the lobe sees; s is 1 - its cosine.
enum class LobeAngle : std::uint8_t {
  kReflection,  ///< between L and R, the mirror direction of V (Phong family)
  kHalfVector,  ///< between the normal and the half vector (Blinn family)
};

/// GGX's alpha squared for an exponent: the width at which both have the same peak as a heightfield's distribution.
inline constexpr double alpha_squared(double exponent) { return 2 / (exponent + 2); }

/// The integral that the coefficient makes 1, over s = 1 - cos of the lobe's angle:
///   energy = coefficient * 2 pi * sum over j of weights[j] * integral of lobe(s) s^j, 0..s_max.
/// For the half-vector models the lobe's angle is half the angle x of the reflected ray, so
/// sin x dx = 4 (1 - s) ds, cos x = 1 - 4 s + 2 s^2, and x = pi/2 is s = 1 - cos(pi/4).
struct EnergyIntegral {
  std::array<double, 4> weights;
  double s_max;
};

inline constexpr double kHalfOfRightAngle = 1 - 1.41421356237309504880 / 2;  ///< 1 - cos(pi/4)

// ---- numbers: float and double

using std::sqrt;

template <class Real>
struct ScalarOf {
  using Type = Real;
};
template <class Real>
Real where_less(Real a, Real b, Real value) {
  return a < b ? value : Real(0);
}
template <class Real>
Real exp_or_zero(Real x) {
  return x >= std::log(std::numeric_limits<Real>::min()) ? std::exp(x) : Real(0);
}
template <class Real>
Real log_one_minus(Real s) {
  return s < 1 ? std::log1p(-s) : Real(0);
}
template <class Real>
Real half_square_of_angle(Real s) {
  const Real half_angle = std::asin(std::sqrt(std::min(s, Real(1)) / 2));
  return 2 * half_angle * half_angle;
}
template <class Real>
Real one_minus_product(double q, Real s) {
  return Real(1 - q * double(s));
}
template <class Real>
Real multiply_add(Real a, Real b, Real c) {
  return a * b + c;
}
/// The smallest u with a normal number u^k of that type.
template <class Scalar>
inline double smallest_base(int k) {
  return std::exp2(double(std::numeric_limits<Scalar>::min_exponent - 1) / k);
}

// ---- lobes: value(s) is 1 at s = 0 and 0 for s >= 1

/// cosine: (1 - s)^n. Phong 1975; Blinn 1977.
struct CosineLobe {
  static constexpr const char* kName = "cosine";
  explicit CosineLobe(LobeParameters p) : n(p.exponent) {
  }
  template <class Real>
  Real value(Real s) const {
    return where_less(s, Real(1), exp_or_zero(Real(n) * log_one_minus(s)));
  }
  double n;
};

/// cs_k: max(0, 1 - n s / k)^k. Romanyuk et al., eq. (1), for k = 16.
struct CsLobe {
  static constexpr const char* kName = "cs";
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
  double n;
  int k;
  double slope, support;
  double smallest64, smallest32;  ///< smaller bases have a subnormal power
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

/// spherical Gaussian: exp(-n s). Wang et al. 2009, All-frequency rendering, sec. 3.
struct SphericalGaussianLobe {
  static constexpr const char* kName = "spherical_gaussian";
  explicit SphericalGaussianLobe(LobeParameters p) : n(p.exponent) {}
  template <class Real>
  Real value(Real s) const {
    return where_less(s, Real(1), exp_or_zero(Real(-n) * s));
  }
  double n;
};

/// Gauss: exp(-n arccos(1 - s)^2 / 2). Romanyuk et al., among the lobes compared.
struct GaussLobe {
  static constexpr const char* kName = "gauss";
  explicit GaussLobe(LobeParameters p) : n(p.exponent) {}
  template <class Real>
  Real value(Real s) const {
    return where_less(s, Real(1), exp_or_zero(Real(-n) * half_square_of_angle(s)));
  }
  double n;
};

/// Schlick: (1 - s) / (1 - s + n s). Schlick 1994, A fast alternative to Phong's specular model.
struct SchlickLobe {
  static constexpr const char* kName = "schlick";
  explicit SchlickLobe(LobeParameters p) : n(p.exponent) {}
  template <class Real>
  Real value(Real s) const {
    const Real c = Real(1) - s;
    return where_less(Real(0), c, c / (c + Real(n) * s));
  }
  double n;
};

/// pk3.m: max(0, 1 + q1 n s + q2 (n s)^2 + q3 (n s)^3)^k. the cheapest for its accuracy, by a linear program.
struct PkLobe {
  static constexpr const char* kName = "pk";
  /// a, b and c of q1, q2 and q3.
  struct Fit {
    double a[3], b[3], c[3];
  };
  static constexpr Fit kFits[] = {{{-0.4870510102, 0.1006701317, -0.008057364014},
                                   {-0.02714573094, -0.1437461631, 0.02973722682},
                                   {0, 0, 0}},
                                  {{-0.2489836846, 0.02922607759, -0.001588107903},
                                   {-0.01710772416, -0.08697986523, 0.008609950066},
                                   {0, 0, 0}},
                                  {{-0.1249374068, 0.007678866686, -0.0002564566794},
                                   {-0.005078414538, -0.05293123069, 0.003943782166},
                                   {0.05946058577, -0.1160499687, 0.001248944705}},
                                  {{-0.06249538915, 0.001944214873, -3.675033301e-05},
                                   {-0.0006733233308, -0.03015564769, 0.001583516365},
                                   {0.01116129152, -0.01780493112, -0.01515373696}}};
  explicit PkLobe(LobeParameters p)
      : n(p.exponent),
        k(p.order),
        smallest64(smallest_base<double>(k)),
        smallest32(smallest_base<float>(k)) {
    double power = 1;
    for (int j = 0; j < 3; ++j) {
      of_t[j] = coefficient<double>(j);
      of_s[j] = of_t[j] * (power *= n);
    }
    // The cubic falls as far as the right angle. It may rise beyond: where its derivative has a root.
    const double inside = of_t[1] * of_t[1] - 3 * of_t[0] * of_t[2];
    const double below = inside >= 0 ? of_t[1] + std::sqrt(inside) : 0;
    clamp_ends_it = base(1.0) <= 0 && (below <= 0 || -of_t[0] / (below * n) >= 2);
  }
  template <class Real>
  Real value(Real s) const {
    constexpr bool kNarrow = std::is_same_v<typename ScalarOf<Real>::Type, float>;
    Real power = base(s);
    // Cut before the power: a subnormal product stalls even if it is not used.
    power = where_less(Real(kNarrow ? smallest32 : smallest64), power, power);
    for (int i = 1; i < k; i *= 2) power = power * power;
    return clamp_ends_it ? power : where_less(s, Real(1.0), power);
  }
  double n;
  int k;
  double of_t[3];                 ///< q1, q2 and q3
  double smallest64, smallest32;  ///< smaller bases have a subnormal power
  static constexpr int squarings(int order) {
    int count = 0;
    for (; order > 1; order /= 2) ++count;
    return count;
  }
  /// q1, q2 and q3 by `j`.
  template <class Number>
  Number coefficient(int j) const {
    const Fit& fit = kFits[squarings(k) - 1];
    const Number v = Number(1) / Number(std::max(n, 16.0));
    return Number(fit.a[j]) + (Number(fit.b[j]) + Number(fit.c[j]) * v) * v;
  }
  /// The cubic, by s; for half floats, which have no room for n^3, by t, with one multiplication more.
  template <class Real>
  Real base(Real s) const {
    constexpr bool kHalf =
        !std::is_same_v<Real, double> && std::is_same_v<typename ScalarOf<Real>::Type, Real>;
    const Real t = kHalf ? Real(n) * s : s;
    const double* q = kHalf ? of_t : of_s;
    return multiply_add(multiply_add(multiply_add(Real(q[2]), t, Real(q[1])), t, Real(q[0])), t,
                        Real(1));
  }
  double of_s[3];      ///< q1, q2 and q3 times n, n^2 and n^3
  bool clamp_ends_it;  ///< it is 0 beyond by itself, because the cubic falls as far as s = 2
};

/// GGX: 1 / (1 + n s (2 - s) / 2)^2. Trowbridge and Reitz 1975; Walter et al. 2007, eq. 33.
struct GgxLobe {
  static constexpr const char* kName = "ggx";
  explicit GgxLobe(LobeParameters p) : n(p.exponent) {}
  template <class Real>
  Real value(Real s) const {
    const Real share = Real(1) / multiply_add(Real(n / 2) * s, Real(2) - s, Real(1));
    return where_less(s, Real(1), share * share);
  }
  double n;
};

using Lobes = std::tuple<CosineLobe, CsLobe, SphericalGaussianLobe, GaussLobe, SchlickLobe, PkLobe, GgxLobe>;

// ---- models: radiance per unit irradiance normal to the beam, E

/// For cosines above 0; 1 at normal incidence.
template <class Real>
Real smith_factor(double alpha_squared, Real n_dot_l, Real n_dot_v) {
  using std::sqrt;
  const Real least = Real(alpha_squared), rest = Real(1 - alpha_squared);
  const Real root_l = sqrt(multiply_add(rest * n_dot_l, n_dot_l, least));
  const Real root_v = sqrt(multiply_add(rest * n_dot_v, n_dot_v, least));
  return Real(2.0) / multiply_add(n_dot_l, root_v, n_dot_v * root_l);
}

/// Phong (RDF).
///   radiance = coef * lobe(angle of R from V) * E,   0 where N.L <= 0
struct PhongRdf {
  static constexpr const char* kName = "phong_rdf";
  static constexpr LobeAngle kAngle = LobeAngle::kReflection;
  static constexpr bool kAppliesCosine = false, kHasShadowing = false;
  static double exact_cosine(double n) { return (n + 1.0) / (2.0 * 3.14159265358979323846); }
  static constexpr EnergyIntegral kEnergy{{1, 0, 0, 0}, 1};
  static constexpr double kShare = 1;
};

/// modified Phong.
///   radiance = coef * lobe(angle of R from V) * (N.L) * E
struct ModifiedPhong {
  static constexpr const char* kName = "modified_phong";
  static constexpr LobeAngle kAngle = LobeAngle::kReflection;
  static constexpr bool kAppliesCosine = true, kHasShadowing = false;
  static double exact_cosine(double n) { return (n + 2.0) / (2.0 * 3.14159265358979323846); }
  static constexpr EnergyIntegral kEnergy{{1, -1, 0, 0}, 1};
  static constexpr double kShare = 1;
};

/// Blinn-Phong (RDF).
///   radiance = coef * lobe(angle of N from H) * E,   0 where N.L <= 0
struct BlinnPhongRdf {
  static constexpr const char* kName = "blinn_phong_rdf";
  static constexpr LobeAngle kAngle = LobeAngle::kHalfVector;
  static constexpr bool kAppliesCosine = false, kHasShadowing = false;
  static double exact_cosine(double n) { return (n + 2.0) / (4.0 * 3.14159265358979323846 * (2.0 - std::exp2(-0.5 * n))); }
  static constexpr EnergyIntegral kEnergy{{4, -4, 0, 0}, kHalfOfRightAngle};
  static constexpr double kShare = 1;
};

/// modified Blinn-Phong.
///   radiance = coef * lobe(angle of N from H) * (N.L) * E
struct ModifiedBlinnPhong {
  static constexpr const char* kName = "modified_blinn_phong";
  static constexpr LobeAngle kAngle = LobeAngle::kHalfVector;
  static constexpr bool kAppliesCosine = true, kHasShadowing = false;
  static double exact_cosine(double n) { return (n + 2.0) * (n + 4.0) / (8.0 * 3.14159265358979323846 * (std::exp2(-0.5 * n) + n)); }
  static constexpr EnergyIntegral kEnergy{{4, -20, 24, -8}, kHalfOfRightAngle};
  static constexpr double kShare = 1;
};

/// Blinn-Phong (NDF).
///   D = coef * lobe(angle of N from H),   f_r = D F / 4 with implicit geometry G = (N.L)(N.V)
///   radiance = D / 4 * (N.L) * E, with F = 1
struct BlinnPhongNdf {
  static constexpr const char* kName = "blinn_phong_ndf";
  static constexpr LobeAngle kAngle = LobeAngle::kHalfVector;
  static constexpr bool kAppliesCosine = true, kHasShadowing = false;
  static double exact_cosine(double n) { return (n + 1.0) / (2.0 * 3.14159265358979323846); }
  static constexpr EnergyIntegral kEnergy{{1, 0, 0, 0}, 1};
  static constexpr double kShare = 0.25;
};

/// Blinn-Phong (heightfield).
///   D = coef * lobe(angle of N from H), with the projected area, the integral of D cos a, equal to 1
///   radiance = D / 4 * (N.L) * E, with implicit geometry and F = 1
struct BlinnPhongHeightfield {
  static constexpr const char* kName = "blinn_phong_heightfield";
  static constexpr LobeAngle kAngle = LobeAngle::kHalfVector;
  static constexpr bool kAppliesCosine = true, kHasShadowing = false;
  static double exact_cosine(double n) { return (n + 2.0) / (2.0 * 3.14159265358979323846); }
  static constexpr EnergyIntegral kEnergy{{1, -1, 0, 0}, 1};
  static constexpr double kShare = 0.25;
};

/// microfacet (Smith).
///   D = coef * lobe(angle of N from H), with the projected area, the integral of D cos a, equal to 1
///   radiance = D G / (4 (N.L) (N.V)) * (N.L) * E, with F = 1
struct MicrofacetSmith : BlinnPhongHeightfield {
  static constexpr const char* kName = "microfacet_smith";
  static constexpr LobeAngle kAngle = LobeAngle::kHalfVector;
  static constexpr bool kAppliesCosine = true, kHasShadowing = true;
};

using Models = std::tuple<PhongRdf, ModifiedPhong, BlinnPhongRdf, ModifiedBlinnPhong, BlinnPhongNdf, BlinnPhongHeightfield, MicrofacetSmith>;

// ---- a model with a lobe

/// The integral of lobe(s) (w0 + w1 s + w2 s^2 + w3 s^3) over s, to about 1e-14: trapezoids after s = end / (1 + exp(-pi sinh t)),
/// which crowds them where a narrow lobe falls. About 500 values of the lobe.
template <class Lobe>
double integral(const Lobe& lobe, const EnergyIntegral& energy) {
  double end = energy.s_max, below = 0;
  for (int i = 0; i < 100; ++i) {  // the lobe's own end
    const double middle = (below + end) / 2;
    (lobe.value(middle) > 0 ? below : end) = middle;
  }
  constexpr double kStep = 1.0 / 64, kPi = 3.14159265358979323846;
  double sum = 0;
  for (int i = -256; i <= 224; ++i) {
    const double t = kStep * i, fall = std::exp(-kPi * std::sinh(t)), s = end / (1 + fall);
    const auto& w = energy.weights;
    sum += std::cosh(t) * s * (fall / (1 + fall)) * lobe.value(s) * (w[0] + s * (w[1] + s * (w[2] + s * w[3])));
  }
  return kPi * kStep * sum;
}

/// s = 1 - cos of the lobe's angle. Real and Vector have the same precision.
template <LobeAngle angle, class Real, class Vector>
Real one_minus_cos(Vector normal, Vector to_eye, Vector to_light) {
  Vector difference;
  if constexpr (angle == LobeAngle::kReflection) {
    difference = Real(2.0) * dot(normal, to_eye) * normal - to_eye - to_light;
  } else {
    const Vector sum = to_light + to_eye;
    difference = normal - Real(1.0) / sqrt(dot(sum, sum)) * sum;
  }
  return Real(0.5) * dot(difference, difference);
}

/// Your own vectors do as well, if they have +, -, a product with a number, and dot().
template <class Real>
struct Vector3 {
  using Scalar = Real;
  Real x, y, z;
  friend Vector3 operator+(Vector3 a, Vector3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector3 operator-(Vector3 a, Vector3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector3 operator*(Real k, Vector3 a) { return {k * a.x, k * a.y, k * a.z}; }
  friend Real dot(Vector3 a, Vector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
};

template <class Model, class Lobe>
class Highlight {
 public:
  explicit Highlight(double exponent, int order = 0)
      : lobe_(LobeParameters(exponent, order)), alpha_squared_(alpha_squared(exponent)) {
    if constexpr (std::is_same_v<Lobe, CosineLobe>)
      coefficient_ = Model::kShare * Model::exact_cosine(exponent);
    else
      coefficient_ = Model::kShare / (2 * 3.14159265358979323846 * integral(lobe_, Model::kEnergy));
  }
  const Lobe& lobe() const { return lobe_; }
  /// The factor of the lobe in radiance; for a microfacet model a quarter of that of its distribution.
  double coefficient() const { return coefficient_; }

  /// For s = 1 - cos of the angle that the lobe sees, which one_minus_cos() computes without cancellation.
  template <class Real>
  Real radiance_at(Real n_dot_l, Real n_dot_v, Real s) const {
    if (!(n_dot_l > 0)) return 0;
    Real factor = Real(coefficient_) * lobe_.value(s);
    if (Model::kAppliesCosine) factor *= n_dot_l;
    if (Model::kHasShadowing) factor *= smith_factor(alpha_squared_, n_dot_l, n_dot_v);
    return factor;
  }
  template <class Vector, class Real = decltype(dot(Vector(), Vector()))>
  Real radiance(const Vector& normal, const Vector& to_eye, const Vector& to_light) const {
    return radiance_at(dot(normal, to_light), dot(normal, to_eye),
                       one_minus_cos<Model::kAngle, Real>(normal, to_eye, to_light));
  }

 private:
  Lobe lobe_;
  double alpha_squared_, coefficient_;
};

}  // namespace highlight
}  // namespace lobelia

#endif  // LOBELIA_HIGHLIGHT_HPP
