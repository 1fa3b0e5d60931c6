#include "renderer/formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/words/numbers.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace {

/// Kept within float32, which the languages of shaders have.
constexpr double kSmallestNumber = 1e-30, kLargestNumber = 1e30;

constexpr std::string_view kSymbols[] = {"",    "s",   "n",   "c",   "x",    "+",    "-",   "*",
                                         "/",   "^",   "min", "max", "-",    "exp",  "log", "sqrt",
                                         "abs", "sin", "cos", "tan", "asin", "acos", "atan"};
static_assert(std::size(kSymbols) == std::size_t(Operation::kAtan) + 1);

/// How tightly a text holds together: it needs parentheses where something tighter is called for.
enum Tightness { kSum = 1, kProduct, kSigned, kPowerOf, kAtom };

Tightness tightness(Operation operation, const FormulaLanguage& language) {
  switch (operation) {
    case Operation::kAdd:
    case Operation::kSubtract:
      return kSum;
    case Operation::kMultiply:
    case Operation::kDivide:
      return kProduct;
    case Operation::kNegate:
      return kSigned;
    case Operation::kPower:
      return language.has_power_operator ? kPowerOf : kAtom;
    default:
      return kAtom;
  }
}

std::string shortest(double number) { return fmt::format("{}", number); }

/// The power if it is a whole one from 2 to kMaxWholePower; otherwise 0.
int whole_power(const Formula::Node& power) {
  const double k = power.number;
  return power.operation == Operation::kNumber && k >= 2 && k <= kMaxWholePower &&
                 k == std::floor(k)
             ? int(k)
             : 0;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {
    if (text.size() > kMaxFormulaBytes)
      throw FormulaError(
          fmt::format("the formula has {} bytes; allowed: {}", text.size(), kMaxFormulaBytes));
  }

  std::vector<Formula::Node> parse() {
    sum();
    if (!rest().empty()) fail("expected an operator or the end");
    return std::move(nodes_);
  }

 private:
  /// Counts how deep the parser is in itself.
  struct Level {
    explicit Level(Parser& parser) : depth(parser.depth_) {
      if (++depth > kMaxFormulaDepth)
        parser.fail(fmt::format("nested too deeply; allowed: {} levels", kMaxFormulaDepth));
    }
    ~Level() { --depth; }
    Level(const Level&) = delete;
    int& depth;
  };

  std::uint8_t sum() {
    std::uint8_t left = product();
    for (;;)
      if (take('+'))
        left = add(Operation::kAdd, left, product());
      else if (take('-'))
        left = add(Operation::kSubtract, left, product());
      else
        return left;
  }

  std::uint8_t product() {
    std::uint8_t left = with_sign();
    for (;;)
      if (take('*'))
        left = add(Operation::kMultiply, left, with_sign());
      else if (take('/'))
        left = add(Operation::kDivide, left, with_sign());
      else
        return left;
  }

  std::uint8_t with_sign() {
    const Level level(*this);
    if (take('-')) return add(Operation::kNegate, with_sign());
    if (take('+')) return with_sign();
    const std::uint8_t base = atom();
    return take('^') ? add(Operation::kPower, base, with_sign()) : base;
  }

  std::uint8_t atom() {
    const std::string_view here = rest();
    if (here.empty()) fail("the formula ends where a value is expected");
    if (take('(')) return closed(sum());
    if (is_digit(here.front()) || here.front() == '.') return number();
    std::size_t length = 0;
    while (length < here.size() && (is_letter(here[length]) || is_digit(here[length]))) ++length;
    if (length == 0)
      fail(fmt::format("'{}' where a value is expected", printable(here.substr(0, 1))));
    return named(here.substr(0, length));
  }

  std::uint8_t number() {
    std::size_t length = 0;
    const std::string_view here = rest();
    const auto digits = [&] {
      while (length < here.size() && is_digit(here[length])) ++length;
    };
    digits();
    if (length < here.size() && here[length] == '.') ++length, digits();
    // "2exp(s)" is not 2e and xp.
    if (length < here.size() && (here[length] == 'e' || here[length] == 'E')) {
      const std::size_t sign =
          length + 1 < here.size() && (here[length + 1] == '-' || here[length + 1] == '+');
      if (length + 1 + sign < here.size() && is_digit(here[length + 1 + sign]))
        length += 1 + sign, digits();
    }
    double value = 0;
    if (!parse_number(here.substr(0, length), value) ||
        (value != 0 && (value < kSmallestNumber || value > kLargestNumber)))
      fail(fmt::format("number '{}'; allowed: 0, or {:g} to {:g}",
                       printable(here.substr(0, length)), kSmallestNumber, kLargestNumber));
    at_ += length;
    return constant(value);
  }

  std::uint8_t named(std::string_view name) {
    if (name == "pi") {
      at_ += name.size();
      return constant(std::numbers::pi);
    }
    if (name == "pow") return function(name, Operation::kPower);
    for (std::size_t i = std::size_t(Operation::kVersine); i < std::size(kSymbols); ++i) {
      const auto operation = Operation(i);
      if (kSymbols[i] != name || !is_letter(name.front())) continue;
      if (operation > Operation::kAngle) return function(name, operation);
      at_ += name.size();
      return add(operation);
    }
    std::vector<std::string_view> known{"pi", "pow"};
    for (const std::string_view symbol : kSymbols)
      if (!symbol.empty() && is_letter(symbol.front())) known.push_back(symbol);
    fail(
        fmt::format("unknown name '{}'; allowed: s, n, c, x, pi and the functions exp, log, sqrt, "
                    "abs, sin, cos, tan, asin, acos, atan, pow, min, max{}",
                    printable(name), name.size() > 1 ? did_you_mean(name, known) : ""));
  }

  std::uint8_t function(std::string_view name, Operation operation) {
    const Level level(*this);
    const std::size_t begin = at_;
    at_ += name.size();
    if (!take('(')) fail(fmt::format("expected '(' after {}", name));
    const int count = operand_count(operation);
    const std::uint8_t first = sum();
    if (count == 1) {
      if (!rest().empty() && rest().front() == ',') fail(fmt::format("{} takes one value", name));
      return closed(add(operation, first));
    }
    if (!take(',')) {
      if (!rest().empty() && rest().front() != ')') fail("expected an operator, ',' or ')'");
      at_ = begin;
      fail(fmt::format("{} takes two values", name));
    }
    const std::uint8_t second = sum();
    if (!rest().empty() && rest().front() == ',') fail(fmt::format("{} takes two values", name));
    return closed(add(operation, first, second));
  }

  std::uint8_t closed(std::uint8_t inside) {
    if (!take(')'))
      fail(rest().empty() ? "the formula ends before a ')'" : "expected an operator or ')'");
    return inside;
  }

  std::uint8_t constant(double value) {
    const std::uint8_t place = add(Operation::kNumber);
    nodes_[place].number = value;
    return place;
  }

  std::uint8_t add(Operation operation, std::uint8_t left = 0, std::uint8_t right = 0) {
    if (nodes_.size() == kMaxFormulaNodes)
      fail(fmt::format("more than {} numbers, names and operations", kMaxFormulaNodes));
    nodes_.push_back({operation, left, right});
    return std::uint8_t(nodes_.size() - 1);
  }

  /// From the next byte on that is no white space.
  std::string_view rest() {
    while (at_ < text_.size() &&
           std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
      ++at_;
    return text_.substr(at_);
  }

  bool take(char c) {
    if (rest().empty() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  [[noreturn]] void fail(const std::string& what) {
    throw FormulaError(fmt::format("formula, column {}: {}", at_ + 1, what));
  }

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::vector<Formula::Node> nodes_;
};
static_assert(kMaxFormulaNodes <= 256, "places of nodes are bytes");

}  // namespace

std::string_view symbol(Operation operation) { return kSymbols[std::size_t(operation)]; }

std::string formula_text(std::span<const Formula::Node> nodes, const FormulaLanguage& language) {
  struct Part {
    std::string text;
    Tightness tightness;
  };
  // A loop, because a long sum is a deep tree.
  std::vector<Part> parts;
  for (const Formula::Node& node : nodes) {
    const Operation operation = node.operation;
    const auto operand = [&](std::uint8_t place, Tightness needed) {
      const Part& part = parts[place];
      return part.tightness < needed ? "(" + part.text + ")" : part.text;
    };
    Part part{std::string(symbol(operation)), tightness(operation, language)};
    switch (operation) {
      case Operation::kNumber:
        part.text = language.number(node.number);
        break;
      case Operation::kVersine:
        part.text = language.versine;
        break;
      case Operation::kExponent:
        part.text = language.exponent;
        break;
      case Operation::kCosine:
        part.text = language.cosine;
        break;
      case Operation::kAngle:
        part.text = language.angle;
        break;
      case Operation::kAdd:
      case Operation::kSubtract:
        part.text = fmt::format("{} {} {}", operand(node.left, kSum), part.text,
                                operand(node.right, kProduct));
        break;
      case Operation::kMultiply:
      case Operation::kDivide:
        part.text = fmt::format("{} {} {}", operand(node.left, kProduct), part.text,
                                operand(node.right, kSigned));
        break;
      case Operation::kPower: {
        const int whole = whole_power(nodes[node.right]);
        if (whole != 0 && language.whole_power)
          part.text = language.whole_power(parts[node.left].text, whole);
        else if (language.has_power_operator)
          part.text = operand(node.left, kAtom) + "^" + operand(node.right, kSigned);
        else
          part.text = fmt::format("pow({}, {})", parts[node.left].text, parts[node.right].text);
        break;
      }
      case Operation::kMin:
      case Operation::kMax:
        part.text =
            fmt::format("{}({}, {})", part.text, parts[node.left].text, parts[node.right].text);
        break;
      case Operation::kNegate: {
        // Two signs in a row are C's decrement. In our language they must not become parentheses, which are deeper.
        const std::string inner = operand(node.left, kSigned);
        const bool decrements = inner.starts_with('-') && !language.has_power_operator;
        part.text = decrements ? "-(" + inner + ")" : "-" + inner;
        break;
      }
      default:
        part.text = fmt::format("{}({})", operation == Operation::kLog ? language.log : part.text,
                                parts[node.left].text);
        break;
    }
    parts.push_back(std::move(part));
  }
  return parts.back().text;
}

std::string formula_body(const Formula& formula) {
  std::string body;
  const auto uses = [&](Operation name) {
    return std::ranges::find(formula.nodes(), name, &Formula::Node::operation) !=
           formula.nodes().end();
  };
  if (uses(Operation::kCosine)) body += "    float c = 1.0 - s;\n";
  if (uses(Operation::kAngle)) body += "    float x = 2.0 * asin(sqrt(0.5 * s));\n";
  int count = 0;
  const auto declare = [&](const std::string& value) {
    const std::string name = fmt::format("t{}", ++count);
    body += fmt::format("    float {} = {};\n", name, value);
    return name;
  };
  // By squarings: not every pow takes a base that a rounding has made negative, and many are rough.
  const auto by_squarings = [&](const std::string& base, int power) {
    std::string square = declare(base), product;
    for (int rest = power; rest > 0; rest /= 2) {
      if (rest % 2 == 1) product = product.empty() ? square : declare(product + " * " + square);
      if (rest > 1) square = declare(square + " * " + square);
    }
    return product;
  };
  const std::string value = formula_text(formula.nodes(), {.number = float32_text,
                                                           .versine = "s",
                                                           .exponent = "n",
                                                           .cosine = "c",
                                                           .angle = "x",
                                                           .whole_power = by_squarings});
  return body + fmt::format("    return min(1.0, max(0.0, {}));\n", value);
}

Formula::Formula(std::string_view text) : nodes_(Parser(text).parse()) {
  text_ = formula_text(nodes_, {.number = shortest,
                                .versine = "s",
                                .exponent = "n",
                                .cosine = "c",
                                .angle = "x",
                                .has_power_operator = true});
  info_ = {kFormulaLobe, kFormulaLobe, text_, "by quadrature", "given as a formula"};
}

}  // namespace lobelia
