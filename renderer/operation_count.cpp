#include "renderer/operation_count.hpp"

#include "renderer/lobes/catalogue.hpp"
#include "renderer/models/catalogue.hpp"
#include "renderer/models/lobe_angle.hpp"
#include "renderer/models/smith.hpp"

namespace lobelia {
namespace {

thread_local OperationCount g_count;

/// From `lobelia cost --level picture reference_scenes/scenes/head_on.xml` with AVX-512, where a multiplication is some
/// 0.015 ms a megapixel (docs/cost.md). Exponentials and logarithms in float64 take more terms on half as many lanes; the
/// rest of a kernel hides part of the simple operations. float16 is emulated, one half float after another.
struct Prices {
  double simple, divide_or_root, transcendental;
};
constexpr Prices kPrices[] = {{1, 6, 28}, {1, 6, 28}, {1.5, 10, 70}, {170, 170, 2700}};
static_assert(std::size(kPrices) == kPrecisionCount);
/// Costs of a formula, evaluated node by node and one value at a time: 27 ns for c^n, 53 ns for
/// max(0, 1 - n s / 16)^16, 70 ns for exp(-n x^2 / 2), with 0.015 ns a multiplication.
constexpr double kOfANode = 250, kOfItsTranscendentals = 1000;

/// A number that counts its operations.
struct Counted {
  using Scalar = double;
  double x = 0;
  Counted() = default;
  Counted(double value) : x(value) {}

  friend Counted operator*(Counted a, Counted b) { return ++g_count.multiply, Counted(a.x * b.x); }
  friend Counted operator+(Counted a, Counted b) { return ++g_count.add, Counted(a.x + b.x); }
  friend Counted operator-(Counted a, Counted b) { return ++g_count.add, Counted(a.x - b.x); }
  friend Counted operator/(Counted a, Counted b) { return ++g_count.divide, Counted(a.x / b.x); }
  friend Counted sqrt(Counted a) { return ++g_count.root, Counted(std::sqrt(a.x)); }
  friend Counted where_less(Counted a, Counted b, Counted value) {
    return ++g_count.compare, Counted(where_less(a.x, b.x, value.x));
  }
  friend Counted exp_or_zero(Counted a) {
    return ++g_count.transcendental, ++g_count.compare, Counted(exp_or_zero(a.x));
  }
  friend Counted log_one_minus(Counted s) {
    return ++g_count.transcendental, Counted(log_one_minus(s.x));
  }
  friend Counted half_square_of_angle(Counted s) {
    ++g_count.root, ++g_count.transcendental, g_count.multiply += 3;
    return half_square_of_angle(s.x);
  }
  friend Counted multiply_add(Counted a, Counted b, Counted c) {
    return ++g_count.multiply_add, Counted(a.x * b.x + c.x);
  }
  friend Counted one_minus_product(double q, Counted s) {
    return multiply_add(Counted(-q), s, Counted(1));
  }
};

struct CountedVec3 {
  Counted x, y, z;
  friend CountedVec3 operator+(CountedVec3 a, CountedVec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend CountedVec3 operator-(CountedVec3 a, CountedVec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend CountedVec3 operator*(Counted k, CountedVec3 a) { return {k * a.x, k * a.y, k * a.z}; }
  friend Counted dot(CountedVec3 a, CountedVec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
};

/// The same for textbook formulas, where operations on the constants n and k alone are free.
struct CountedTextbook {
  double x = 0;
  bool varies = false;
  explicit CountedTextbook(double constant) : x(constant) {}
  CountedTextbook(double value, bool is_varying) : x(value), varies(is_varying) {}

  /// Counts one operation if it is done for each point.
  static CountedTextbook did(int OperationCount::*what, double value, bool varying) {
    if (varying) ++(g_count.*what);
    return {value, varying};
  }
  using T = CountedTextbook;
  using C = OperationCount;
  friend T operator*(T a, T b) { return did(&C::multiply, a.x * b.x, a.varies || b.varies); }
  friend T operator+(T a, T b) { return did(&C::add, a.x + b.x, a.varies || b.varies); }
  friend T operator-(T a, T b) { return did(&C::add, a.x - b.x, a.varies || b.varies); }
  friend T operator/(T a, T b) { return did(&C::divide, a.x / b.x, a.varies || b.varies); }
  friend T operator-(T a) { return {-a.x, a.varies}; }
  friend bool operator>(T a, T b) { return did(&C::compare, 0, a.varies || b.varies), a.x > b.x; }
  friend T exp(T a) { return did(&C::transcendental, std::exp(a.x), a.varies); }
  friend T acos(T a) { return did(&C::transcendental, std::acos(a.x), a.varies); }
  friend T pow(T a, T b) {
    return did(&C::transcendental, std::pow(a.x, b.x), a.varies || b.varies);
  }
};

template <class F>
OperationCount counted(F f) {
  g_count = {};
  f();
  return g_count;
}

/// As it is evaluated: nothing of a formula is computed once for all points.
OperationCount counted_formula(const Formula& formula) {
  OperationCount count;
  for (const Formula::Node& node : formula.nodes()) switch (node.operation) {
      case Operation::kNumber:
      case Operation::kVersine:
      case Operation::kExponent:
        break;
      case Operation::kCosine:
      case Operation::kAdd:
      case Operation::kSubtract:
        ++count.add;
        break;
      case Operation::kAngle:
        ++count.root, ++count.transcendental, count.multiply += 2;
        break;
      case Operation::kMultiply:
        ++count.multiply;
        break;
      case Operation::kDivide:
        ++count.divide;
        break;
      case Operation::kMin:
      case Operation::kMax:
      case Operation::kNegate:
      case Operation::kAbs:
        ++count.compare;
        break;
      case Operation::kSqrt:
        ++count.root;
        break;
      default:
        ++count.transcendental;
    }
  return count;
}

/// Counts f(lobe), with n > k, so that a family's lobe ends before the horizon.
template <class F>
OperationCount counted_lobe(LobeId lobe, F) {
  using Count = OperationCount (*)(LobeParameters);
  static constexpr auto kCounts =
      map_types<Count>(HWY_NAMESPACE::LobesById{}, []<class L>() -> Count {
        return [](LobeParameters p) {
          if constexpr (L::kInfo.name == kFormulaLobe)
            return counted_formula(*p.formula);
          else
            return counted([&] { F()(L(p)); });
        };
      });
  return kCounts.at(lobe.index)({2.0 * kMaxOrder, lobe});
}

}  // namespace

OperationCount operations(LobeId lobe) {
  return counted_lobe(lobe, [](const auto& l) { l.value(Counted(1e-3)); });
}

OperationCount textbook_operations(LobeId lobe) {
  return counted_lobe(lobe, [](const auto& l) { l.definition(CountedTextbook(0.999, true)); });
}

OperationCount operations(ModelId model) {
  using Count = OperationCount (*)();
  static constexpr auto kCounts = map_types<Count>(HWY_NAMESPACE::Models{}, []<class M>() -> Count {
    return [] {
      return counted([] {
        const CountedVec3 up{0, 0, 1};
        const Counted s = HWY_NAMESPACE::one_minus_cos<M::kInfo.angle, Counted>(up, up, up);
        // An RDF needs only the sign of N.L.
        const Counted n_dot_l = dot(up, up);
        Counted value = s;
        if constexpr (M::kInfo.has_shadowing)
          value = value * HWY_NAMESPACE::smith_factor(0.5, n_dot_l, dot(up, up));
        if constexpr (M::kInfo.applies_cosine) value = value * n_dot_l;
        where_less(Counted(0), n_dot_l, value);
      });
    };
  });
  return kCounts.at(model.index)();
}

double price(const OperationCount& count, Precision precision) {
  const Prices& p = kPrices[std::size_t(precision)];
  return p.simple * (count.multiply_add + count.multiply + count.add + count.compare) +
         p.divide_or_root * (count.divide + count.root) + p.transcendental * count.transcendental;
}

double price(const LobeId& lobe, Precision precision) {
  const OperationCount count = operations(lobe);
  return lobe.formula ? kOfANode * double(lobe.formula->nodes().size()) +
                            kOfItsTranscendentals * count.transcendental
                      : price(count, precision);
}

}  // namespace lobelia
