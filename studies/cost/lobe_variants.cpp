// Compiled without vectorisation (CMakeLists.txt): what is called scalar is that.
#include "studies/cost/lobe_variants.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <type_traits>

#include "renderer/lobes/catalogue.hpp"
#include "studies/cost/binary_power.hpp"
#include "studies/cost/lobe_lanes.hpp"

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

/// One whose function is of arrays of T.
template <class T, class Over>
LobeVariant way_over(LobeId lobe, std::string method, bool simd, OperationCount operations,
                     double allowed, Over over) {
  constexpr bool kWide = std::is_same_v<T, double>;
  LobeVariant way{lobe, std::move(method), kWide, simd, operations, allowed, false, {}, {}};
  if constexpr (kWide)
    way.over64 = over;
  else
    way.over32 = over;
  return way;
}

template <class T, class F>
LobeVariant scalar_way(LobeId lobe, std::string method, OperationCount operations, double allowed,
                       F f) {
  return way_over<T>(lobe, std::move(method), false, operations, allowed, scalar<T>(f));
}

/// The catalogue's own form by registers of T.
template <class T>
LobeVariant stable_way(LobeId lobe, std::string method, double exponent, double allowed) {
  return way_over<T>(lobe, std::move(method), true, operations(lobe), allowed,
                     [=](std::size_t count, const T* s, T* value) {
                       lobe_lanes(lobe, exponent, count, s, value);
                     });
}

/// Of a formula of the cosine, with 1 - s and the cut.
OperationCount textbook_from_s(LobeId lobe) {
  OperationCount count = textbook_operations(lobe);
  ++count.add, ++count.compare;
  return count;
}

void add_of_cosine(LobeVariant way, std::vector<LobeVariant>& ways) {
  way.of_cosine = !way.wide;
  ways.push_back(std::move(way));
}

constexpr auto kTimes = [](auto a, auto b) { return a * b; };

/// That of 1 - s is made n times as large; std::pow is within a unit in the last place, and n may be rounded.
template <class T>
double power_allowed(double exponent) {
  return (exponent + 3) * kHalfUnit<T>;
}

/// What a catalogued lobe has: our stable form, scalar and by registers, and the textbook's in float32.
template <class L>
void add_catalogued(LobeId id, double exponent, std::vector<LobeVariant>& ways) {
  const L lobe({exponent, id.order});
  constexpr bool kCosine = std::is_same_v<L, CosineLobe>;
  const std::string stable = kCosine ? "exp(n log1p(-s))" : "stable";
  // The rounding of float64 is as much smaller than float32's as its numbers are longer. The slope of a cs_k is then
  // rounded too, and the angle of Gauss comes from an inverse sine.
  const double of_peak32 = lobe_float32_error(id, exponent).of_peak;
  const double of_peak64 = (kCosine ? 1 : 2) * of_peak32 * kRounding64 / kRounding32;
  ways.push_back(scalar_way<double>(id, stable, operations(id), of_peak64,
                                    [lobe](double s) { return lobe.value(s); }));
  ways.push_back(stable_way<double>(id, stable, exponent, of_peak64));
  ways.push_back(stable_way<float>(id, stable, exponent, of_peak32));
  // 1 - s is rounded, which a textbook's power, arc cosine or difference makes n times as large.
  const double textbook =
      kCosine ? power_allowed<float>(exponent) : 2 * (exponent + id.order + 8) * kRounding32;
  add_of_cosine(
      scalar_way<float>(id, kCosine ? "std::pow" : "textbook", textbook_from_s(id), textbook,
                        [lobe](float s) {
                          const float cosine = 1 - s;
                          return cosine > 0 ? lobe.definition(cosine) : 0.0f;
                        }),
      ways);
}

template <class T>
void add_powered(LobeId cosine, unsigned n, std::vector<LobeVariant>& ways) {
  // That of 1 - s is made n times as large, that of its square half as many times and so on; and each bit of n that is
  // set has a product.
  const double allowed = (2.0 * n + std::bit_width(n)) * kHalfUnit<T>;
  OperationCount count;
  count.add = count.compare = 1;
  binary_power(0, n, [&](int, int) { return ++count.multiply; });
  add_of_cosine(scalar_way<T>(cosine, "squaring", count, allowed,
                              [n](T s) {
                                const T c = 1 - s;
                                return c > 0 ? binary_power(c, n, kTimes) : T(0);
                              }),
                ways);
  add_of_cosine(way_over<T>(cosine, "squaring", true, count, allowed,
                            [n](std::size_t points, const T* s, T* value) {
                              squaring_lanes(n, points, s, value);
                            }),
                ways);
}

/// The ways of cos^n that are not one of our lobe's.
void add_cosine(LobeId id, double exponent, std::vector<LobeVariant>& ways) {
  ways.push_back(
      scalar_way<double>(id, "std::pow", textbook_from_s(id), power_allowed<double>(exponent),
                         [exponent](double s) { return s < 1 ? std::pow(1 - s, exponent) : 0.0; }));
  ways.push_back(scalar_way<float>(
      id, "exp(n log1p(-s))", operations(id), 8 * kRounding32,
      [n = float(exponent)](float s) { return s < 1 ? std::exp(n * std::log1p(-s)) : 0.0f; }));
  if (exponent != std::floor(exponent) || exponent < 1 || exponent > 0x1p31) return;
  const auto n = unsigned(exponent);
  add_powered<double>(id, n, ways);
  add_powered<float>(id, n, ways);
}

/// A cs_k as one would write it without care: one multiply-add in float32, and the squarings.
void add_cs(LobeId id, double exponent, std::vector<LobeVariant>& ways) {
  const unsigned k = id.order;
  ways.push_back(scalar_way<float>(id, "squaring", operations(id), 3.0 * k * kRounding32,
                                   [k, slope = float(exponent / k)](float s) {
                                     const float base = 1 - slope * s;
                                     return base > 0 && s < 1 ? binary_power(base, k, kTimes)
                                                              : 0.0f;
                                   }));
  ways.back().of_cosine = exponent == k;
}

}  // namespace

std::string LobeVariant::name() const {
  return fmt::format("{}, {}, {}{}", info(lobe).name, method, wide ? "float64" : "float32",
                     simd ? " SIMD" : "");
}

std::vector<LobeVariant> lobe_variants(double exponent) {
  using Add = void (*)(LobeId, double, std::vector<LobeVariant>&);
  static constexpr auto kAdd = map_types<Add>(Lobes{}, []<class L>() -> Add {
    return [](LobeId id, double n, std::vector<LobeVariant>& ways) {
      add_catalogued<L>(id, n, ways);
      if constexpr (std::is_same_v<L, CosineLobe>) add_cosine(id, n, ways);
      if constexpr (std::is_same_v<L, CsLobe>) add_cs(id, n, ways);
    };
  });
  std::vector<LobeVariant> ways;
  for (const LobeId id : all_lobes()) kAdd.at(id.index)(id, exponent, ways);
  return ways;
}

}  // namespace lobelia::cost
