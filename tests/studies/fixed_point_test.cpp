#include "studies/cost/fixed_point.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>
#include <set>

#include "renderer/lobes/catalogue.hpp"
#include "studies/cost/lobe_errors.hpp"

namespace lobelia::cost {
namespace {

using boost::multiprecision::cpp_int;
using boost::multiprecision::cpp_rational;
using ::testing::Contains;
using ::testing::DoubleNear;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr FixedRounding kRoundings[] = {FixedRounding::kNearest, FixedRounding::kTruncate};
constexpr int kOrders[] = {2, 4, 8, 16, 32, 64};

/// x, not negative, to a whole number of 2^-f, from the definition of rounding.
cpp_rational rounded(const cpp_rational& x, FixedPoint f) {
  cpp_rational scaled = x * f.one();
  if (f.rounding == FixedRounding::kNearest) scaled += cpp_rational(1, 2);
  return cpp_rational(cpp_int(numerator(scaled) / denominator(scaled)), cpp_int(f.one()));
}

/// Not inlined: GCC 12 then warns of numbers of Boost that it takes to be uninitialised.
[[gnu::noinline]] cpp_rational fraction(FixedPoint f, std::uint64_t value) {
  return cpp_rational(cpp_int(value), cpp_int(f.one()));
}

[[gnu::noinline]] cpp_rational cs_by_fractions(FixedPoint f, unsigned n, int k, std::uint64_t s) {
  const cpp_rational base = 1 - cpp_rational(n, k) * cpp_rational(s, f.one());
  if (base <= 0) return 0;
  cpp_rational power = rounded(base, f);
  for (int order = 1; order < k; order *= 2) power = rounded(power * power, f);
  return power;
}

TEST(FixedPoint, IsExactlyWhatFractionsGive) {
  std::mt19937_64 random(1);
  for (const FixedRounding rounding : kRoundings)
    for (int bits = 6; bits <= 32; ++bits)
      for (const unsigned n : {16u, 63u, 64u, 1000u, 65537u, 1000000u})
        for (const int k : kOrders) {
          const FixedPoint f{bits, rounding};
          const auto support = std::min<std::uint64_t>(f.one(), f.one() * k / n + 1);
          for (std::uint64_t s : {std::uint64_t(0), f.one(), support, random() % (support + 1),
                                  random() % (support / 8 + 1)})
            EXPECT_EQ(fraction(f, fixed_cs(f, n, k, s)), cs_by_fractions(f, n, k, s))
                << bits << " bits, n = " << n << ", k = " << k << ", s = " << s;
        }
}

/// x of either sign to a whole number of 2^-f.
[[gnu::noinline]] cpp_rational rounded_of_any_sign(const cpp_rational& x, FixedPoint f) {
  const cpp_int whole = 1 << 10;  // makes what is rounded positive
  return rounded(x + whole, f) - whole;
}

TEST(FixedPoint, IsForPkExactlyWhatFractionsGive) {
  std::mt19937_64 random(1);
  for (const FixedRounding rounding : kRoundings)
    for (int bits = 6; bits <= 32; bits += 2)
      for (const unsigned n : {16u, 63u, 1000u, 1000000u})
        for (const int k : {2, 4, 8, 16}) {
          const FixedPoint f{bits, rounding};
          const PreparedLobe lobe =
              prepare({find_lobe("pk3.1")->index, std::uint16_t(k)}, double(n));
          int range = 0;
          while (lobe.value(std::exp2(range) / n) > 0) ++range;
          const HWY_NAMESPACE::PkLobe pk({double(n), k});
          cpp_rational q[3];
          for (int j = 0; j < 3; ++j)
            q[j] = rounded_of_any_sign(
                cpp_rational(pk.of_t[j]) * cpp_rational(cpp_int(1) << (range * (j + 1))),
                {bits, FixedRounding::kNearest});
          const FixedPk circuit(f, n, k);
          for (int i = 0; i < 20; ++i) {
            const std::uint64_t s =
                i == 0 ? 0 : random() % std::min(f.one() + 1, (f.one() << range) / n + 2);
            const cpp_rational w =
                cpp_rational(n) * fraction(f, s) / cpp_rational(cpp_int(1) << range);
            cpp_rational power = 0;
            for (int j = 3; j-- > 0;) power = rounded_of_any_sign(w * (q[j] + power), f);
            power += 1;
            if (power <= 0 || w >= 1) power = 0;
            for (int order = 1; order < k; order *= 2) power = rounded(power * power, f);
            EXPECT_EQ(fraction(f, circuit.value(s)), power)
                << bits << " bits, n = " << n << ", k = " << k << ", s = " << s;
          }
        }
}

TEST(FixedPoint, RoundsEachProductOfBinaryPowering) {
  // 5 = 0b101: c, then c^4 by two squarings, then their product.
  for (const FixedRounding rounding : kRoundings)
    for (const int bits : {8, 31, 32}) {
      const FixedPoint f{bits, rounding};
      for (const std::uint64_t s : {std::uint64_t(0), f.one() / 3, f.one() / 77, f.one()}) {
        const cpp_rational c = fraction(f, f.one() - s);
        const cpp_rational square = rounded(c * c, f), fourth = rounded(square * square, f);
        EXPECT_EQ(fraction(f, fixed_power(f, 5, s)), rounded(c * fourth, f)) << bits;
      }
    }
}

TEST(FixedPoint, TakesSFromARoundedCosine) {
  const FixedPoint nearest{4, FixedRounding::kNearest}, truncated{4, FixedRounding::kTruncate};
  EXPECT_EQ(nearest.one_minus_cos(0), 0u);
  EXPECT_EQ(nearest.one_minus_cos(1), 16u);
  EXPECT_EQ(nearest.one_minus_cos(0.03), 0u);  // the cosine is 0.97: 15.5 sixteenths, just above
  EXPECT_EQ(truncated.one_minus_cos(0.03), 1u);
  EXPECT_EQ(truncated.one_minus_cos(1.0 / 16), 1u);
}

TEST(FixedTable, IsExactAtItsEntriesAndStraightBetween) {
  const FixedPoint f{16, FixedRounding::kNearest};
  const FixedTable table(f, 64, 4);  // s below 1/4 in sixteen parts: 2^10 steps of 2^-16 each
  const LobeId cosine = *find_lobe("cosine");
  ASSERT_EQ(table.bits_within(), 10);
  for (std::uint64_t i = 0; i < 16; ++i) {
    const double a = f.value(table.value(i << 10)),
                 b = lobe_value(cosine, (double(i) + 1) / 64, 64);
    EXPECT_THAT(a, DoubleNear(lobe_value(cosine, double(i) / 64, 64), 0x1p-17 + 1e-12));
    EXPECT_THAT(f.value(table.value((i << 10) + 512)), DoubleNear((a + b) / 2, 0x1p-16));
  }
  EXPECT_EQ(table.value(1 << 14), 0u);
  EXPECT_EQ(table.value(f.one()), 0u);
  EXPECT_FALSE(FixedTable::fits({6, FixedRounding::kNearest}, 64, 4));
  EXPECT_TRUE(FixedTable::fits({7, FixedRounding::kNearest}, 64, 4));
}

TEST(CircuitErrors, StayBelowWhatTheRoundingsCanAddUpTo) {
  // Each is half a unit or one of the last bit: that of s n/k times, that of the base, both then k times as
  // large; and of each squaring, which the later ones make as large as what is left of k.
  for (const FixedRounding rounding : kRoundings)
    for (const int k : kOrders)
      for (const unsigned n : {64u, 1024u})
        for (int bits = 6; bits <= 32; bits += 2) {
          const FixedPoint f{bits, rounding};
          const double unit = std::exp2(-bits) * (rounding == FixedRounding::kNearest ? 0.5 : 1);
          const CircuitErrors e = circuit_errors(cs_circuit(f, n, k), n);
          const double bound = unit * (n + k + k - 1);
          EXPECT_LE(e.rounding, bound) << k << " " << bits << " " << n;
          if (bound < 0.1) {
            EXPECT_GT(e.rounding, bound / 32) << k << " " << bits << " " << n;
          }
          EXPECT_LE(e.max, e.shape + e.rounding + 1e-12);
        }
}

TEST(CircuitErrors, StayBelowTheirBoundAndEndAtTheShapeForPk) {
  for (const FixedRounding rounding : kRoundings)
    for (const int k : {2, 4, 8, 16})
      for (const unsigned n : {16u, 64u, 1024u})
        for (int bits = 6; bits <= 32; bits += 2) {
          const Circuit circuit = pk_circuit({bits, rounding}, n, k);
          const CircuitErrors e = circuit_errors(circuit, n);
          EXPECT_LE(e.rounding, circuit.most_rounding) << k << " " << bits << " " << n;
          if (circuit.most_rounding < 0.1) {
            EXPECT_GT(e.rounding, circuit.most_rounding / 32) << k << " " << bits << " " << n;
          }
          if (bits == 32) {
            EXPECT_NEAR(e.max, e.shape, 1e-6) << k << " " << n;
          }
        }
}

using Big = boost::multiprecision::cpp_bin_float_50;

/// From the definitions alone, in fractions and 50 digits: the integrals of a step have closed forms. Of cs_k, or of
/// cos^n by squarings where k is 0.
CircuitErrors by_fractions(FixedPoint f, unsigned n, int k) {
  const Big end = n > 16 ? Big(16) / n : Big(1), one = Big(f.one());
  const Big up = f.rounding == FixedRounding::kNearest ? Big(0.5) : Big(0);
  Big drift = 0, square = 0;
  CircuitErrors errors;
  for (std::uint64_t step = 0;; ++step) {
    const Big from = step == 0 ? Big(0) : Big((step - 1 + up) / one);
    if (from >= end) break;
    const Big to = std::min(end, Big((step + up) / one)), width = to - from;
    const cpp_rational exact =
        k > 0 ? cs_by_fractions(f, n, k, step) : fraction(f, fixed_power(f, n, step));
    const Big value = Big(numerator(exact)) / Big(denominator(exact));
    const Big a = pow(1 - from, n), b = pow(1 - to, n);
    const Big integral = (a * (1 - from) - b * (1 - to)) / (n + 1);
    const Big of_squares = (a * a * (1 - from) - b * b * (1 - to)) / (2 * n + 1);
    drift += value * width - integral;
    square += value * value * width - 2 * value * integral + of_squares;
    errors.max = std::max({errors.max, std::abs(double(value - a)), std::abs(double(value - b))});
    ++errors.steps;
  }
  errors.rms = double(sqrt(square / end));
  errors.energy = double(abs(drift)) * (n + 1.0);
  return errors;
}

TEST(CircuitErrors, AreTheSumsOverAllStepsWhateverTheirNumber) {
  // 4096 steps in the highlight, where the middles of 4096 parts of it would all be ties; and no such number.
  struct Of {
    unsigned n;
    int bits;
  };
  for (const auto& [n, bits] : {Of{64, 14}, Of{1024, 18}, Of{16, 12}, Of{64, 13}, Of{1000, 17},
                                Of{64, 6}, Of{65536, 6}, Of{65536, 20}})
    for (const FixedRounding rounding : kRoundings)
      for (const int k : {0, 16}) {
        const FixedPoint f{bits, rounding};
        const CircuitErrors e =
            circuit_errors(k > 0 ? cs_circuit(f, n, k) : power_circuit(f, n), n);
        const CircuitErrors truth = by_fractions(f, n, k);
        SCOPED_TRACE(::testing::Message() << "n = " << n << ", " << bits << " bits, "
                                          << name(rounding) << ", k = " << k);
        EXPECT_EQ(e.steps_looked_at, truth.steps);
        EXPECT_NEAR(e.max, truth.max, 1e-14);
        EXPECT_NEAR(e.rms, truth.rms, 1e-6 * truth.rms + 1e-15);
        EXPECT_NEAR(e.energy, truth.energy, 1e-11);
        EXPECT_EQ(e.max_at_most, e.max);
        EXPECT_EQ(e.energy_spread, 0);
      }
}

TEST(CircuitErrors, AreTheSameOnSomeStepsWithinStandardErrorsAndBounds) {
  // 2^22 steps, all of which long double visits here.
  constexpr unsigned kN = 64;
  for (const FixedRounding rounding : kRoundings) {
    const FixedPoint f{24, rounding};
    const double up = rounding == FixedRounding::kNearest ? 0.5 : 0;
    for (const int k : {0, 16}) {
      const Circuit circuit = k > 0 ? cs_circuit(f, kN, k) : power_circuit(f, kN);
      const CircuitErrors e = circuit_errors(circuit, kN);
      long double drift = 0, square = 0, max = 0;
      const auto cosine = [](long double s) {
        long double power = 1 - s;
        for (int i = 0; i < 6; ++i) power *= power;
        return power;
      };
      long double a = 0, t = 1;
      for (std::uint64_t step = 0; a < 0.25L; ++step) {
        const long double b = std::min(0.25L, ((long double)step + up) / (long double)f.one());
        const long double value = circuit.value(step) / (long double)f.one();
        const long double u = cosine(b), m = cosine((a + b) / 2), width = (b - a) / 6;
        const auto sum = [&](auto g) {
          return width * (g(value - t) + 4 * g(value - m) + g(value - u));
        };
        drift += sum([](long double x) { return x; });
        square += sum([](long double x) { return x * x; });
        max = std::max({max, std::abs(value - t), std::abs(value - u)});
        a = b, t = u;
      }
      const double energy = double(std::abs(drift)) * (kN + 1),
                   rms = double(std::sqrt(square / 0.25L));
      SCOPED_TRACE(::testing::Message() << name(rounding) << ", k = " << k);
      EXPECT_EQ(e.steps_looked_at, 2 * kCells + 2);
      EXPECT_GT(e.energy_spread, 0);
      EXPECT_LT(e.energy_spread, 1e-7);
      EXPECT_NEAR(e.energy, energy, 4 * e.energy_spread);
      EXPECT_NEAR(e.rms, rms, 4 * e.rms_spread + 1e-6 * rms);
      EXPECT_LT(e.rms_spread, 0.01 * e.rms);
      EXPECT_LE(e.max, double(max) + 1e-15);
      EXPECT_GE(e.max_at_most, double(max));
      EXPECT_LT(e.max_at_most, 3 * e.max);
    }
  }
}

TEST(CircuitErrors, ShowAtTheEndsOfStepsForOneBit) {
  // n = 1, k = 2, one bit: s is 0, 1/2 or 1. For s just below 1/4 the value is 1 and cos is 3/4.
  const CircuitErrors e = circuit_errors(power_circuit({1, FixedRounding::kNearest}, 1), 1);
  EXPECT_THAT(e.max, DoubleNear(0.25, 1e-12));
  EXPECT_THAT(circuit_errors(power_circuit({1, FixedRounding::kTruncate}, 1), 1).max,
              DoubleNear(0.5, 1e-12));
}

TEST(FixedPointOperations, AreBitsTimesBits) {
  const FixedPoint f{12, FixedRounding::kNearest};
  // n = 64 has 7 bits and s 13: their product, the cut, and four squarings.
  EXPECT_EQ(fixed_cs_operations(f, 64, 16), 13 * 7 + 12 + 4 * 144);
  EXPECT_EQ(fixed_power_operations(f, 64), 6 * 144);
  EXPECT_EQ(fixed_power_operations(f, 1000), 14 * 144);
  // 16 entries of 12 bits; 6 bits within an interval; a difference, a sum and the cut.
  EXPECT_EQ(fixed_table_operations(f, FixedTable(f, 64, 4), 4), 16 * 12 + 12 * 6 + 24 + 12);
}

TEST(FixedPointTable, CountsBitOperationsAndHasNamesOfItsOwn) {
  const Table table = fixed_point_table(64, {8, 16});
  EXPECT_EQ(table.id, "fixed-point-n64");
  EXPECT_EQ(table.unit, "bit operations");
  std::set<std::string> names;
  for (const Variant& variant : table.variants) {
    EXPECT_TRUE(names.insert(variant.name).second) << variant.name;
    EXPECT_GT(cost_of(variant).median, 0) << variant.name;
    for (const auto& [kind, error] : variant.errors)
      EXPECT_TRUE(std::isfinite(error)) << variant.name << ", " << kind;
  }
  for (const int k : kOrders)
    EXPECT_THAT(names, Contains("cs" + std::to_string(k) + ", 16 bits, truncated"));
  for (int m = 1; m <= 4; ++m)
    EXPECT_THAT(names, Contains("pk3." + std::to_string(m) + ", 16 bits, truncated"));
  EXPECT_THAT(names, Contains("cosine by squaring, 8 bits, rounded"));
  EXPECT_THAT(names, Contains("table of 16, 16 bits, rounded"));
}

TEST(FixedPointTable, SaysHowManyBitsAreWasted) {
  const std::string wasted = "cs16, rounded: more than ";
  // cs16 against cos^64, by their difference: no bit more than it takes to come within 5 % of that.
  double shape = 0;
  for (double s = 0; s < 0.25; s += 1e-5)
    shape = std::max(shape, std::pow(1 - s, 64) - std::pow(1 - 4 * s, 16));
  int enough = 32;
  while (circuit_errors(cs_circuit({enough - 1, FixedRounding::kNearest}, 64, 16), 64).max <
         1.05 * shape)
    --enough;
  EXPECT_THAT(fixed_point_table(64, {8}).remarks,
              Contains(HasSubstr(wasted + std::to_string(enough) + " bits")));
  // At n = 16 cs16 is the cosine: none are.
  EXPECT_THAT(fixed_point_table(16, {8}).remarks, Not(Contains(HasSubstr(wasted))));
  EXPECT_THAT(fixed_point_table(16, {8}).remarks, Contains(HasSubstr("every bit counts")));
}

}  // namespace
}  // namespace lobelia::cost
