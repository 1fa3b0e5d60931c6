#include "studies/cost/lobe_errors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "core/error.hpp"
#include "tests/more_samples.hpp"

namespace lobelia::cost {
namespace {

constexpr std::uint64_t kAll = ~std::uint64_t(0), kFew = 1 << 18;

LobeVariant variant_named(double exponent, const std::string& name) {
  for (const LobeVariant& variant : lobe_variants(exponent))
    if (variant.name() == name) return variant;
  throw std::runtime_error("no variant is called " + name);
}

double cosine(double s, double n) {
  return double(std::exp((long double)n * std::log1p(-(long double)s)));
}

/// The largest of every number from `from` to `to`, one after the other.
double by_force(const LobeVariant& variant, double n, float from, float to) {
  double most = 0;
  for (float s = from; s < to;) {
    std::vector<float> block(1 << 12);
    for (float& one : block) one = s, s = std::nextafter(s, 2.0f);
    const std::vector<double> value = variant.values(block);
    for (std::size_t i = 0; i < block.size(); ++i)
      most = std::max(most, std::abs(value[i] - cosine(block[i], n)));
  }
  return most;
}

TEST(LargestError, OfSquaringARoundedCosineIsThatOfEveryNumber) {
  // 1 - s changes where s is an odd number of 2^-25: those numbers and their neighbours, by plain loops. Three
  // million random numbers find 3.16e-6 at n = 64, and 2560 points find 2.31e-6.
  for (const int squarings : {6, 10}) {
    const double n = std::exp2(squarings);
    double most = 0;
    for (double tie = 0x1p-25; tie < 12 / n; tie += 0x1p-24)
      for (const float s :
           {std::nextafter(float(tie), 0.0f), float(tie), std::nextafter(float(tie), 1.0f)}) {
        volatile float rounded = 1 - s;
        float power = rounded;
        long double truth = 1 - (long double)s;
        for (int i = 0; i < squarings; ++i) power *= power, truth *= truth;
        most = std::max(most, double(std::abs(power - truth)));
      }
    for (const char* name : {"cosine, squaring, float32", "cosine, squaring, float32 SIMD"}) {
      const LargestError e = largest_error(variant_named(n, name), n, 0, kAll);
      EXPECT_NEAR(e.found, most, 1e-13) << n;
      EXPECT_EQ(e.at_most, e.found) << n;
    }
    if (squarings == 6) {
      EXPECT_NEAR(most, 3.24e-6, 5e-9);
    }
  }
}

TEST(LargestError, OfALobeOfAnotherShapeIsThatOfEveryNumberAboutItsPlace) {
  for (const char* name : {"cs16, stable, float32 SIMD", "cs16, squaring, float32",
                           "schlick, stable, float32 SIMD", "cs16, textbook, float32"}) {
    const LobeVariant variant = variant_named(1024, name);
    double s = 0, most = 0;
    for (double x = 0; x < 16 / 1024.0; x += 1e-6) {
      const double here = std::abs(lobe_value(variant.lobe, x, 1024) - cosine(x, 1024));
      if (here > most) most = here, s = x;
    }
    const LargestError e = largest_error(variant, 1024, 0, kAll);
    EXPECT_NEAR(e.found, by_force(variant, 1024, float(0.98 * s), float(1.02 * s)), 1e-14) << name;
    EXPECT_EQ(e.at_most, e.found) << name;
    EXPECT_NEAR(e.found, most, 1e-4) << name;
  }
}

TEST(LargestError, OfOurCosineLiesInItsBracketAndNoNumberIsFartherOff) {
  constexpr double n = 64.5;
  const LobeVariant variant = variant_named(n, "cosine, exp(n log1p(-s)), float32 SIMD");
  const LargestError few = largest_error(variant, n, 0, kFew),
                     all = largest_error(variant, n, 0, kAll);
  EXPECT_LE(few.found, all.found);
  EXPECT_LT(few.found, few.at_most);
  EXPECT_LE(all.found, few.at_most);
  EXPECT_EQ(all.at_most, all.found);
  EXPECT_LE(few.numbers, 2 * kFew);
  // Half a unit in the last place just below 1 is met, and no more than the lobe's file states.
  EXPECT_GT(all.found, 0x1p-25);
  EXPECT_LE(all.found, 2e-7);
  EXPECT_LE(by_force(variant, n, 0.9f / 64, 1.1f / 64), all.found);
  EXPECT_GE(by_force(variant, n, 0.9f / 64, 1.1f / 64), 0.5 * all.found);
}

TEST(LargestError, OfOurCosineToAWholePowerIsTheRoundingOfItsValue) {
  std::size_t number = 0;
  for (const double n : {64.0, 1.0, 2.0, 4096.0, 100.0}) {
    if (is_left_out(number++)) continue;
    const LobeVariant variant = variant_named(n, "cosine, squaring in float64, float32 SIMD");
    EXPECT_LE(largest_error(variant, n, 0, kAll).found, 0x1p-25 + n * 0x1p-52) << n;
  }
}

TEST(LargestError, BoundsEveryVariantAtRandomNumbers) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform;
  for (const double n : {16.0, 64.5, 1e6})
    for (const LobeVariant& variant : lobe_variants(n)) {
      const LargestError e = largest_error(variant, n, 0, kFew);
      EXPECT_LE(e.found, e.at_most) << variant.name() << " " << n;
      std::vector<float> s(1 << 12);
      for (float& one : s) one = float(std::min(1.0, std::pow(10, 9 * uniform(random) - 7) / n));
      const std::vector<double> value = variant.values(s);
      for (std::size_t i = 0; i < s.size(); ++i) {
        const double off = std::abs(value[i] - cosine(s[i], n));
        // At 1 some lobes end in a step.
        if (s[i] < 1) {
          EXPECT_LE(off, e.at_most + 1e-18) << variant.name() << " n = " << n << " s = " << s[i];
        }
      }
    }
}

TEST(LargestError, ThrowsWhereAVariantIsFartherOffThanItMayBe) {
  LobeVariant variant = variant_named(64, "cs16, stable, float32 SIMD");
  variant.over32 = variant_named(64, "cs8, stable, float32 SIMD").over32;
  EXPECT_THROW(largest_error(variant, 64, 0, kAll), Error);
}

TEST(LobeVariants, InFloat32GiveOneWhereTheyAreTooCloseToIt) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform;
  for (const double n : {1.0, 16.0, 64.5, 1024.0, 1e6})
    for (const LobeVariant& variant : lobe_variants(n)) {
      if (variant.wide) continue;
      std::vector<float> s(1 << 12);
      for (float& one : s) one = float(0x1p-26 / n * std::pow(10, -30 * uniform(random)) * 0.999);
      for (const double value : variant.values(s))
        // The textbook's alpha^2 - 1 + 1 is not alpha^2.
        ASSERT_NEAR(value, 1, family(variant.lobe) == "ggx" ? variant.allowed : 0)
            << variant.name() << " " << n;
    }
}

TEST(LobeVariants, ThatSeeTheRoundedCosineAloneAreSteps) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform;
  int of_cosine = 0;
  for (const double n : {16.0, 64.5, 1024.0})
    for (const LobeVariant& variant : lobe_variants(n)) {
      if (!variant.of_cosine) continue;
      ++of_cosine;
      std::vector<float> given(1 << 12), same(1 << 12);
      for (std::size_t i = 0; i < given.size(); ++i) {
        given[i] = float(20 / n * uniform(random));
        same[i] = 1 - (1 - given[i]);
      }
      EXPECT_EQ(variant.values(given), variant.values(same)) << variant.name();
    }
  EXPECT_GT(of_cosine, 30);
}

TEST(Lobes, OfTheCatalogueBendNoMoreThanTheSearchTakesThemTo) {
  for (const LobeId& lobe : all_lobes())
    for (const double n : {2.0, 16.0, 64.5, 1e6}) {
      const auto difference = [&](double s) {
        return lobe_value(lobe, s, n) - lobe_value(*find_lobe("cosine"), s, n);
      };
      const double step = 1e-3 / n;
      for (double s = step; s + step < std::min(1.0, 30 / n); s += step) {
        const double bend = difference(s - step) - 2 * difference(s) + difference(s + step);
        ASSERT_LE(std::abs(bend) / (step * step),
                  most_bend(lobe) * n * n * (1 + 1e-6) + 1e-2 * n * n)
            << info(lobe).name << " " << n << " " << s;
      }
    }
}

}  // namespace
}  // namespace lobelia::cost
