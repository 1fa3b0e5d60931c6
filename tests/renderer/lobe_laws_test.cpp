// Laws that every lobe of the catalogue obeys. A new lobe is tested here without a line written.
#include <gtest/gtest.h>

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/highlight.hpp"

namespace lobelia {
namespace {

constexpr double kExponents[] = {0.1, 1, 2, 15.9, 16, 128, 1024, 1e4, 1e6, 1e8};

/// Values of s from 0 to 2, dense where a lobe of exponent n falls.
std::vector<double> abscissae(double n) {
  std::vector<double> s{0, 2};
  for (double x = 1e-6; x < 40; x *= 1.05) s.push_back(std::min(2.0, x / n));
  for (double x = 0; x <= 2; x += 0.01) s.push_back(x);
  std::sort(s.begin(), s.end());
  return s;
}

TEST(EveryLobe, IsOneInTheMiddleAndFallsToBetweenZeroAndOne) {
  int lobes_tested = 0;
  for (const LobeId lobe : all_lobes()) {
    ++lobes_tested;
    for (const double n : kExponents) {
      EXPECT_EQ(lobe_value(lobe, 0, n), 1) << info(lobe).name << " n = " << n;
      double previous = 1;
      for (const double s : abscissae(n)) {
        const double value = lobe_value(lobe, s, n);
        EXPECT_TRUE(value >= 0 && value <= previous * (1 + 1e-12))
            << info(lobe).name << " n = " << n << " s = " << s << " value " << value;
        previous = value;
      }
    }
  }
  EXPECT_GE(lobes_tested, 10);
}

TEST(EveryLobe, IsZeroBehindARightAngle) {
  for (const LobeId lobe : all_lobes())
    for (const double n : kExponents)
      for (const double s : {1.0, 1.5, 2.0}) EXPECT_EQ(lobe_value(lobe, s, n), 0);
}

TEST(EveryLobe, IsZeroOrANormalNumber) {
  for (const LobeId lobe : all_lobes())
    for (const double n : kExponents)
      for (const double s : abscissae(n)) {
        const double value = lobe_value(lobe, s, n);
        EXPECT_TRUE(value == 0 || std::isnormal(value)) << info(lobe).name << " " << n << " " << s;
      }
}

TEST(Cs, OfOrderNIsTheCosineLobe) {
  const LobeId cosine = *find_lobe("cosine");
  for (const int k : {2, 4, 6, 12, 16, 50, 64, 1000, 1024}) {
    const LobeId cs = *find_lobe("cs" + std::to_string(k));
    for (const double s : abscissae(k))
      EXPECT_NEAR(lobe_value(cs, s, k), lobe_value(cosine, s, k), 1e-15 * k) << k << " " << s;
  }
}

TEST(Cs, IsNeverAboveTheCosineLobeWhereNIsAtLeastK) {
  const LobeId cosine = *find_lobe("cosine"), cs16 = *find_lobe("cs16");
  for (const double n : {16.0, 128.0, 1024.0})
    for (const double s :
         abscissae(n))  // Bernoulli's inequality; 4e-15 for the rounding of 16 factors
      EXPECT_LE(lobe_value(cs16, s, n), lobe_value(cosine, s, n) + 4e-15) << n << " " << s;
}

TEST(Cs, GrowsIntoTheSphericalGaussianAsKGrows) {
  const LobeId gaussian = *find_lobe("spherical_gaussian");
  for (const double n : {16.0, 1024.0, 1e6}) {
    double previous = 1;
    for (const int k : {16, 64, 256, 1024}) {
      const LobeId cs = *find_lobe("cs" + std::to_string(k));
      double largest = 0;
      for (const double s : abscissae(n))
        if (s < 1)
          largest = std::max(largest, std::abs(lobe_value(cs, s, n) - lobe_value(gaussian, s, n)));
      // (1 - x/k)^k = e^-x (1 - x^2/(2k) + ...), and x^2 e^-x / 2 is at most 2/e^2 = 0.27.
      EXPECT_LE(largest, 0.28 / k) << n << " " << k;
      EXPECT_LT(largest, previous / 3) << n << " " << k;
      previous = largest;
    }
  }
}

TEST(Cs, HasAnyEvenOrderUpTo1024ByNameAndNoOther) {
  EXPECT_EQ(info(*find_lobe("cs12")).formula, "max(0, 1 - n s / 12)^12");
  for (const char* name : {"cs", "cs0", "cs1", "cs15", "cs1026", "cs-2", "cs016", "cs2 "})
    EXPECT_FALSE(find_lobe(name)) << name;
}

}  // namespace
}  // namespace lobelia
