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
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    const Number &a = value[node.left], &b = value[node.right];
    switch (node.operation) {
      case Operation::kNumber:
        value[i] = Number(node.number);
        break;
      case Operation::kVersine:
        value[i] = s;
        break;
      case Operation::kExponent:
        value[i] = Number(n);
        break;
      case Operation::kCosine:
        value[i] = Number(1) - s;
        break;
      case Operation::kAngle:
        value[i] = Number(2) * asin(Number(sqrt(Number(s / Number(2)))));
        break;
      case Operation::kAdd:
        value[i] = a + b;
        break;
      case Operation::kSubtract:
        value[i] = a - b;
        break;
      case Operation::kMultiply:
        value[i] = a * b;
        break;
      case Operation::kDivide:
        value[i] = a / b;
        break;
      case Operation::kPower:
        value[i] = pow(a, b);
        break;
      // A NaN stays one: it must not hide behind a comparison.
      case Operation::kMin:
        value[i] = a != a || a < b ? a : b;
        break;
      case Operation::kMax:
        value[i] = a != a || a > b ? a : b;
        break;
      case Operation::kNegate:
        value[i] = -a;
        break;
      case Operation::kExp:
        value[i] = exp(a);
        break;
      case Operation::kLog:
        value[i] = log(a);
        break;
      case Operation::kSqrt:
        value[i] = sqrt(a);
        break;
      case Operation::kAbs:
        value[i] = abs(a);
        break;
      case Operation::kSin:
        value[i] = sin(a);
        break;
      case Operation::kCos:
        value[i] = cos(a);
        break;
      case Operation::kTan:
        value[i] = tan(a);
        break;
      case Operation::kAsin:
        value[i] = asin(a);
        break;
      case Operation::kAcos:
        value[i] = acos(a);
        break;
      case Operation::kAtan:
        value[i] = atan(a);
        break;
    }
  }
  return value[nodes_.size() - 1];
}

}  // namespace lobelia
