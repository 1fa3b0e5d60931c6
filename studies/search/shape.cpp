#include "studies/search/shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/words/numbers.hpp"

namespace lobelia::search {
namespace {

constexpr double kLeastBits = -126;  ///< the exponent of the least normal float32
constexpr double kBitsBias = 127;    ///< of the exponent in a float32

double to_power(double base, int squarings) {
  for (int i = 0; i < squarings; ++i) base *= base;
  return base;
}

}  // namespace

double Shape::start() const {
  return outer == Outer::kClamp ? 1 : outer == Outer::kReciprocal ? -1 : 0;
}

std::string name(const Shape& shape) {
  const char outer = shape.outer == Outer::kClamp        ? 'p'
                     : shape.outer == Outer::kReciprocal ? 'r'
                                                         : 'b';
  return fmt::format("{}{}{}.{}", outer, shape.free_peak ? 'f' : 'k', shape.degree,
                     shape.squarings);
}

OperationCount operations(const Shape& shape) {
  OperationCount count;
  count.multiply_add = shape.degree;
  count.multiply = shape.squarings;
  count.divide = shape.outer == Outer::kReciprocal;
  // The clamp; of bits a clamp and the conversion to an integer.
  count.compare = shape.outer == Outer::kClamp ? 1 : shape.outer == Outer::kBits ? 2 : 0;
  return count;
}

double outer_value(const Shape& shape, double y) {
  switch (shape.outer) {
    case Outer::kClamp:
      return to_power(std::max(0.0, y), shape.squarings);
    case Outer::kReciprocal:
      return to_power(-1 / y, shape.squarings);
    case Outer::kBits:
      break;
  }
  const double bits = std::max(kLeastBits, y), whole = std::floor(bits);
  return to_power(std::ldexp(1 + (bits - whole), int(whole)), shape.squarings);
}

double outer_inverse(const Shape& shape, double value) {
  double root = value;
  for (int i = 0; i < shape.squarings; ++i) root = std::sqrt(root);
  if (shape.outer == Outer::kClamp) return root;
  if (shape.outer == Outer::kReciprocal) return -1 / root;
  int exponent = 0;
  const double mantissa = std::frexp(root, &exponent);  // in [0.5, 1)
  return exponent - 1 + (2 * mantissa - 1);
}

double Lobe::value(double t, double v) const { return outer_value(shape, polynomial(t, v)); }

std::string Lobe::formula() const {
  // That of -1/y with the sign in the polynomial.
  const double sign = shape.outer == Outer::kReciprocal ? -1 : 1;
  std::string text, start = shape.start() != 0 ? fmt::format("{}", sign * shape.start()) : "";
  for (int j = shape.first(); j <= shape.degree; ++j) {
    std::string coefficient;
    for (int r = 0; r <= shape.by_n; ++r) {
      const double factor = sign * (this->factor(j, r) + (j == 0 && r == 0 ? shape.start() : 0));
      if (r > 0 && factor == 0) continue;
      const std::string power = r == 0 ? "" : r == 1 ? "/n" : fmt::format("/n^{}", r);
      coefficient +=
          r == 0 ? fmt::format("{:.10g}", factor)
                 : fmt::format(" {} {:.10g}{}", factor < 0 ? '-' : '+', std::abs(factor), power);
    }
    if (shape.by_n > 0) coefficient = "(" + coefficient + ")";
    if (j == 0) {
      start = coefficient;
      continue;
    }
    const std::string power = j == 1 ? " t" : fmt::format(" t^{}", j);
    if (shape.by_n == 0 && coefficient[0] == '-')
      text += (text.empty() ? "-" : " - ") + coefficient.substr(1) + power;
    else
      text += (text.empty() ? "" : " + ") + coefficient + power;
  }
  const bool negative = text[0] == '-';
  if (!start.empty())
    text = fmt::format("{}{}{}", start, negative ? " - " : " + ", negative ? text.substr(1) : text);
  const std::string base = shape.outer == Outer::kClamp        ? "max(0, " + text + ")"
                           : shape.outer == Outer::kReciprocal ? "1/(" + text + ")"
                                                               : "bits(" + text + ")";
  return shape.squarings == 0 ? base : fmt::format("{}^{}", base, shape.power());
}

std::string Lobe::code(const std::string& name) const {
  std::string text = fmt::format("float {}(float s, float n) {{\n", name);
  if (shape.by_n > 0) text += "    float v = 1.0 / n;\n";
  const double added = shape.start() + (shape.outer == Outer::kBits ? kBitsBias : 0);
  // Horner's rule in t = n s, and in v for each coefficient.
  std::string sum;
  for (int j = shape.degree; j >= 0; --j) {
    std::string coefficient = float32_text(added);
    if (j >= shape.first()) {
      coefficient.clear();
      for (int r = shape.by_n; r >= 0; --r) {
        const std::string one = float32_text(factor(j, r) + (j == 0 && r == 0 ? added : 0));
        coefficient = coefficient.empty() ? one : fmt::format("({} * v + {})", coefficient, one);
      }
    }
    sum = sum.empty() ? coefficient : fmt::format("({} * (n * s) + {})", sum, coefficient);
  }
  text += "    float y = " + sum + ";\n";
  switch (shape.outer) {
    case Outer::kClamp:
      text += "    y = max(0.0, y);\n";
      break;
    case Outer::kReciprocal:
      text += "    y = -1.0 / y;\n";
      break;
    case Outer::kBits:
      text += "    y = intBitsToFloat(int(8388608.0 * max(1.0, y)));\n";
      break;
  }
  for (int i = 0; i < shape.squarings; ++i) text += "    y = y * y;\n";
  return text + "    return s < 1.0 ? y : 0.0;\n}\n";
}

double cosine_power(double t, double v) {
  if (v == 0) return std::exp(-t);
  return t * v < 1 ? std::exp(std::log1p(-t * v) / v) : 0;
}

std::vector<Shape> shapes(int most, bool free_peak) {
  std::vector<Shape> all;
  const auto add = [&](Outer outer, std::initializer_list<int> degrees) {
    for (const int degree : degrees)
      for (int squarings = 0;; ++squarings) {
        const Shape shape{outer, degree, squarings, 0, free_peak};
        if (price(operations(shape)) > most) break;
        all.push_back(shape);
      }
  };
  // An even polynomial rises again behind its minimum, where a clamp does not help.
  add(Outer::kClamp, {1, 3, 5});
  add(Outer::kReciprocal, {1, 2, 3});
  add(Outer::kBits, {1, 2, 3});
  std::ranges::stable_sort(all, {}, [](const Shape& s) { return price(operations(s)); });
  return all;
}

}  // namespace lobelia::search
