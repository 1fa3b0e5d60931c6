// Compiled without vectorisation (CMakeLists.txt), so that scalar variants stay scalar.
#include "studies/cost/lobe_variants.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <type_traits>

#include "renderer/lobes/catalogue.hpp"
#include "studies/cost/binary_power.hpp"

namespace lobelia::cost {
namespace {

using HWY_NAMESPACE::binary_power;
using HWY_NAMESPACE::CosineLobe;
using HWY_NAMESPACE::CsLobe;
using HWY_NAMESPACE::Lobes;

constexpr double kRounding32 = 0x1p-24, kRounding64 = 0x1p-53;

/// The largest rounding of a number that is at most 1.
template <class T>
constexpr double kHalfUnit = std::is_same_v<T, double> ? 0x1p-54 : 0x1p-25;

/// f of one number after another.
template <class T, class F>
auto scalar(F f) {
  return [f](std::size_t count, const T* s, T* value) {
    for (std::size_t i = 0; i < count; ++i) value[i] = f(s[i]);
  };
}

using Variants = std::vector<LobeVariant>;

/// `over` is a function of arrays of T.
template <class T, class Over>
LobeVariant& add(Variants& all, LobeId lobe, std::string method, bool simd,
                 OperationCount operations, double allowed, Over over) {
  constexpr bool kWide = std::is_same_v<T, double>;
  LobeVariant& variant = all.emplace_back(
      LobeVariant{lobe, std::move(method), kWide, simd, operations, allowed, false, {}, {}});
  if constexpr (kWide)
    variant.over64 = over;
  else
    variant.over32 = over;
  return variant;
}

template <class T, class F>
LobeVariant& add_scalar(Variants& all, LobeId lobe, std::string method, OperationCount operations,
                        double allowed, F f) {
  return add<T>(all, lobe, std::move(method), false, operations, allowed, scalar<T>(f));
}

/// The operations of a formula of the cosine, with 1 - s and the cut.
OperationCount textbook_from_s(LobeId lobe) {
  OperationCount count = textbook_operations(lobe);
  ++count.add, ++count.compare;
  return count;
}

constexpr auto kTimes = [](auto a, auto b) { return a * b; };

/// The rounding of 1 - s, n times as large; std::pow is within a unit in the last place, and n may be rounded.
template <class T>
double power_allowed(double exponent) {
  return (exponent + 3) * kHalfUnit<T>;
}

/// Our stable form, scalar and by registers, and the textbook's in float32.
template <class L>
void add_catalogued(LobeId id, double exponent, Variants& all) {
  const L lobe(LobeParameters{exponent, id});
  constexpr bool kCosine = std::is_same_v<L, CosineLobe>;
  const std::string stable = kCosine ? "exp(n log1p(-s))" : "stable";
  // Scaled by the formats' roundings. In float64 the slope of a cs_k is rounded too, and the angle of Gauss comes from
  // an inverse sine.
  const double of_peak32 = lobe_float32_error(id, exponent).of_peak;
  const double of_peak64 = (kCosine ? 1 : 2) * of_peak32 * kRounding64 / kRounding32;
  const auto lanes = [=](std::size_t count, const auto* s, auto* value) {
    lobe_lanes(id, exponent, count, s, value);
  };
  add_scalar<double>(all, id, stable, operations(id), of_peak64,
                     [lobe](double s) { return lobe.value(s); });
  add<double>(all, id, stable, true, operations(id), of_peak64, lanes);
  std::string stable32 = stable;
  OperationCount count32 = operations(id);
  if constexpr (kCosine)
    if (lobe.whole_n > 0) {
      stable32 = "squaring in float64";
      count32 = {};
      count32.add = count32.compare = 1;
      binary_power(0, unsigned(lobe.whole_n), [&](int, int) { return ++count32.multiply; });
    }
  add<float>(all, id, stable32, true, count32, of_peak32, lanes);
  // A textbook's power, arc cosine or difference makes the rounding of 1 - s n times as large.
  const double textbook =
      kCosine ? power_allowed<float>(exponent) : 2 * (exponent + id.order + 8) * kRounding32;
  add_scalar<float>(all, id, kCosine ? "std::pow" : "textbook", textbook_from_s(id), textbook,
                    [lobe](float s) {
                      const float cosine = 1 - s;
                      return cosine > 0 ? lobe.definition(cosine) : 0.0f;
                    })
      .of_cosine = true;
}

template <class T>
void add_powered(LobeId cosine, unsigned n, Variants& all) {
  // The rounding of 1 - s becomes n times as large, that of its square n/2 times and so on; each bit of n that is set
  // adds a product.
  const double allowed = (2.0 * n + std::bit_width(n)) * kHalfUnit<T>;
  constexpr bool kOfCosine = std::is_same_v<T, float>;
  OperationCount count;
  count.add = count.compare = 1;
  binary_power(0, n, [&](int, int) { return ++count.multiply; });
  const auto power = [n](T s) {
    const T c = 1 - s;
    return c > 0 ? binary_power(c, n, kTimes) : T(0);
  };
  const auto lanes = [n](std::size_t points, const T* s, T* value) {
    squaring_lanes(n, points, s, value);
  };
  add_scalar<T>(all, cosine, "squaring", count, allowed, power).of_cosine = kOfCosine;
  add<T>(all, cosine, "squaring", true, count, allowed, lanes).of_cosine = kOfCosine;
}

/// The other variants of cos^n.
void add_cosine(LobeId id, double exponent, Variants& all) {
  add_scalar<double>(all, id, "std::pow", textbook_from_s(id), power_allowed<double>(exponent),
                     [exponent](double s) { return s < 1 ? std::pow(1 - s, exponent) : 0.0; });
  add_scalar<float>(
      all, id, "exp(n log1p(-s))", operations(id), 8 * kRounding32,
      [n = float(exponent)](float s) { return s < 1 ? std::exp(n * std::log1p(-s)) : 0.0f; });
  if (exponent != std::floor(exponent) || exponent < 1 || exponent > 0x1p31) return;
  add_powered<double>(id, unsigned(exponent), all);
  add_powered<float>(id, unsigned(exponent), all);
}

/// A cs_k written without care: one multiply-add in float32, and the squarings.
void add_cs(LobeId id, double exponent, Variants& all) {
  const unsigned k = id.order;
  const auto power = [k, slope = float(exponent / k)](float s) {
    const float base = 1 - slope * s;
    return base > 0 && s < 1 ? binary_power(base, k, kTimes) : 0.0f;
  };
  add_scalar<float>(all, id, "squaring", operations(id), 3.0 * k * kRounding32, power).of_cosine =
      exponent == k;
}

}  // namespace

std::string LobeVariant::name() const {
  return fmt::format("{}, {}, {}{}", info(lobe).name, method, wide ? "float64" : "float32",
                     simd ? " SIMD" : "");
}

std::vector<double> LobeVariant::values(const std::vector<float>& s) const {
  if (wide) {
    const std::vector<double> wide_s(s.begin(), s.end());
    std::vector<double> value(s.size());
    over64(s.size(), wide_s.data(), value.data());
    return value;
  }
  std::vector<float> value(s.size());
  over32(s.size(), s.data(), value.data());
  return {value.begin(), value.end()};
}

std::vector<LobeVariant> lobe_variants(double exponent) {
  using Add = void (*)(LobeId, double, Variants&);
  static constexpr auto kAdd = map_types<Add>(Lobes{}, []<class L>() -> Add {
    return [](LobeId id, double n, Variants& all) {
      add_catalogued<L>(id, n, all);
      if constexpr (std::is_same_v<L, CosineLobe>) add_cosine(id, n, all);
      if constexpr (std::is_same_v<L, CsLobe>) add_cs(id, n, all);
    };
  });
  Variants all;
  for (const LobeId& id : all_lobes()) kAdd.at(id.index)(id, exponent, all);
  return all;
}

}  // namespace lobelia::cost
