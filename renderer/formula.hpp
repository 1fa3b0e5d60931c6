// The formula of a lobe that a scene gives: a small tree, which can be evaluated for any type of number and printed in
// another language (docs/decisions/0001).
//
//   sum     = product { ("+" | "-") product }
//   product = signed { ("*" | "/") signed }
//   signed  = ["-" | "+"] signed | power
//   power   = atom ["^" signed]                 2^3^2 is 2^9, and -2^2 is -4
//   atom    = NUMBER | NAME | FUNCTION "(" sum { "," sum } ")" | "(" sum ")"
//
// A formula reads and writes nothing and has no loops: its size bounds its time.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/highlight.hpp"

namespace lobelia {

/// One line: "column 5: ...".
struct FormulaError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The operation of one node of a formula. kNumber to kAngle have no operands; kAdd to kMax have two; the others one.
enum class Operation : std::uint8_t {
  kNumber,
  kVersine,   ///< s = 1 - cos x, in [0, 1)
  kExponent,  ///< n
  kCosine,    ///< c = 1 - s
  kAngle,     ///< x in radians, computed from s without losing a small angle
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kPower,
  kMin,
  kMax,
  kNegate,
  kExp,
  kLog,
  kSqrt,
  kAbs,
  kSin,
  kCos,
  kTan,
  kAsin,
  kAcos,
  kAtan,
};

/// More than text() takes for any formula of kMaxFormulaNodes, so that what is written can be read.
inline constexpr std::size_t kMaxFormulaBytes = 4000;
inline constexpr std::size_t kMaxFormulaNodes = 200;
inline constexpr int kMaxFormulaDepth = 40;  ///< of nested parentheses, functions, signs and powers

class Formula {
 public:
  struct Node {
    Operation operation = Operation::kNumber;
    std::uint8_t left = 0, right = 0;  ///< places of the operands, before this node
    double number = 0;                 ///< of kNumber
    friend bool operator==(const Node&, const Node&) = default;
  };

  /// Throws FormulaError.
  explicit Formula(std::string_view text);
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;

  /// Operands before what uses them; the last one is the formula.
  std::span<const Node> nodes() const { return nodes_; }
  /// With no more parentheses than necessary; reads back as the same nodes.
  const std::string& text() const { return text_; }
  /// As a lobe of the catalogue has it; its views are of this object.
  const LobeInfo& info() const { return info_; }

  /// For s in [0, 1]. For double, long double, float and Boost's numbers.
  template <class Number>
  Number evaluate(const Number& s, double n) const;

 private:
  std::string text_;
  LobeInfo info_;
  std::vector<Node> nodes_;
};

/// How a language writes a formula.
struct FormulaLanguage {
  std::string (*number)(double);
  std::string_view versine, exponent, cosine, angle;  ///< of kVersine to kAngle
  std::string_view log = "log";                       ///< the natural logarithm
  /// "^" is an operator; otherwise pow(a, b).
  bool has_power_operator = false;
  /// Writes `base`^`power` for a whole power of 2 to kMaxWholePower; null: as any power.
  std::function<std::string(const std::string& base, int power)> whole_power = {};
};
inline constexpr int kMaxWholePower = 64;
std::string formula_text(std::span<const Formula::Node> nodes, const FormulaLanguage& language);

/// The body of a float32 function of `s` and `n` in the languages of shaders, as LobeText has it (renderer/lobes/lobe.hpp).
std::string formula_body(const Formula& formula);

/// "pow": the name of an operation in a formula; the sign of an operator.
std::string_view symbol(Operation operation);
constexpr int operand_count(Operation operation) {
  if (operation <= Operation::kAngle) return 0;
  return operation <= Operation::kMax ? 2 : 1;
}

template <class Number>
Number Formula::evaluate(const Number& s, double n) const {
  using std::exp, std::log, std::sqrt, std::abs, std::sin, std::cos, std::tan, std::asin, std::acos,
      std::atan, std::pow;
  Number value[kMaxFormulaNodes];
  const auto value_of = [&](const Node& node) -> Number {
    const Number &a = value[node.left], &b = value[node.right];
    switch (node.operation) {
      case Operation::kNumber:
        return Number(node.number);
      case Operation::kVersine:
        return s;
      case Operation::kExponent:
        return Number(n);
      case Operation::kCosine:
        return Number(1) - s;
      case Operation::kAngle:
        return Number(2) * asin(Number(sqrt(Number(s / Number(2)))));
      case Operation::kAdd:
        return a + b;
      case Operation::kSubtract:
        return a - b;
      case Operation::kMultiply:
        return a * b;
      case Operation::kDivide:
        return a / b;
      case Operation::kPower:
        return pow(a, b);
      // A NaN stays one: it must not hide behind a comparison.
      case Operation::kMin:
        return a != a || a < b ? a : b;
      case Operation::kMax:
        return a != a || a > b ? a : b;
      case Operation::kNegate:
        return -a;
      case Operation::kExp:
        return exp(a);
      case Operation::kLog:
        return log(a);
      case Operation::kSqrt:
        return sqrt(a);
      case Operation::kAbs:
        return abs(a);
      case Operation::kSin:
        return sin(a);
      case Operation::kCos:
        return cos(a);
      case Operation::kTan:
        return tan(a);
      case Operation::kAsin:
        return asin(a);
      case Operation::kAcos:
        return acos(a);
      case Operation::kAtan:
        return atan(a);
    }
    return value[0];
  };
  for (std::size_t i = 0; i < nodes_.size(); ++i) value[i] = value_of(nodes_[i]);
  return value[nodes_.size() - 1];
}

}  // namespace lobelia
