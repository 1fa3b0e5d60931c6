// The families of cheap lobes among which `lobelia search` looks for the cheapest.
//
// A shape is value = M(y)^(2^m): a polynomial y of t = n s, an increasing function M that a processor has for nearly
// nothing, and m squarings. The coefficients of y may depend on the exponent, as polynomials in v = 1/n, which costs
// once a material. With a free peak the constant of y is one of the coefficients. Because M increases, "within e of cos^n" is for every s and n a pair of linear inequalities in the
// coefficients; docs/cheapest_lobe.md says what follows from that.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/operation_count.hpp"

namespace lobelia::search {

/// M.
enum class Outer {
  kClamp,       ///< max(0, y); y(0) = 1
  kReciprocal,  ///< 1 / -y; y(0) = -1, so that it increases
  kBits,  ///< 2^floor(y) (1 + y - floor(y)), the bits of y read as a number; y(0) = 0, y at least -126
};

inline constexpr int kMostDegree = 5;

struct Shape {
  Outer outer = Outer::kClamp;
  int degree = 1;     ///< of y in t, 1 to 5
  int squarings = 0;  ///< m
  int by_n = 0;       ///< degree of y's coefficients in v = 1/n; 0: the same for all n
  bool free_peak =
      false;  ///< y(0) is start() plus a coefficient, so that the value at s = 0 is only nearly 1

  int power() const { return 1 << squarings; }
  double start() const;                            ///< y(0), for a peak of 1
  int first() const { return free_peak ? 0 : 1; }  ///< least power of t that has a coefficient
  int terms() const { return degree + 1 - first(); }
  int coefficients() const { return terms() * (by_n + 1); }
  friend bool operator==(const Shape&, const Shape&) = default;
};

/// "pk3.2" (clamped polynomial), "rk2.1" (reciprocal), "bk1.0" (bits): the degree and the number of squarings. With a
/// free peak "pf3.2".
std::string name(const Shape& shape);

/// From s to the value, with what depends on n alone computed before.
OperationCount operations(const Shape& shape);

/// The exponents for which a lobe should hold, as v = 1/n.
struct Range {
  double least_n = 16, most_n = 1024;  ///< most_n may be infinite
  double v_min() const { return 1 / most_n; }
  double v_max() const { return 1 / least_n; }
};

/// c[r * terms + j - first] is the factor of t^j v^r.
struct Lobe {
  Shape shape;
  std::vector<double> c;

  double factor(int j, int r) const {
    return c[std::size_t(r * shape.terms() + j - shape.first())];
  }
  /// The coefficient of t^j for v, j = first() to degree.
  template <class Number>
  Number coefficient(int j, Number v) const {
    Number sum(factor(j, shape.by_n));
    for (int r = shape.by_n - 1; r >= 0; --r) sum = sum * v + Number(factor(j, r));
    return sum;
  }
  /// y(0).
  template <class Number>
  Number constant(Number v) const {
    return shape.free_peak ? Number(shape.start()) + coefficient(0, v) : Number(shape.start());
  }
  /// y.
  template <class Number>
  Number polynomial(Number t, Number v) const {
    Number sum = coefficient(shape.degree, v);
    for (int j = shape.degree - 1; j >= 1; --j) sum = sum * t + coefficient(j, v);
    return sum * t + constant(v);
  }
  /// In [0, 1] for a lobe; t at least 0. Not cut at the right angle.
  double value(double t, double v) const;
  /// With the coefficients as literals, as a function of s and n.
  std::string formula() const;
  /// The function `name`(float s, float n) in GLSL.
  std::string code(const std::string& name) const;
};

double outer_value(const Shape& shape, double y);
/// The y with M(y)^(2^m) = value > 0.
double outer_inverse(const Shape& shape, double value);

/// cos^n = (1 - t v)^(1/v), e^-t for v = 0; 0 beyond the right angle, t v >= 1.
double cosine_power(double t, double v);

/// All shapes with at most `most` operations, cheapest first; with a free peak or without.
std::vector<Shape> shapes(int most, bool free_peak = false);

}  // namespace lobelia::search
