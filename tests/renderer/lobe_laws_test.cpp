// Laws that every lobe of the catalogue obeys. A new lobe is tested here without a line written.
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "renderer/lobes/catalogue.hpp"

namespace lobelia {
namespace {

using HWY_NAMESPACE::Lobes;
constexpr double kExponents[] = {0.1, 1, 2, 15.9, 16, 128, 1024, 1e4, 1e6, 1e8};

template <class... L, class F>
void for_each_lobe(TypeList<L...>, F f) {
  (f.template operator()<L>(), ...);
}

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
  for_each_lobe(Lobes{}, [&]<class L>() {
    ++lobes_tested;
    for (const double n : kExponents) {
      EXPECT_EQ(L::value(0.0, n), 1) << L::kInfo.name << " n = " << n;
      double previous = 1;
      for (const double s : abscissae(n)) {
        const double value = L::value(s, n);
        EXPECT_TRUE(value >= 0 && value <= previous * (1 + 1e-14))
            << L::kInfo.name << " n = " << n << " s = " << s << " value " << value;
        previous = value;
      }
    }
  });
  EXPECT_EQ(lobes_tested, int(Lobes::kSize));
  EXPECT_GE(lobes_tested, 2);
}

TEST(EveryLobe, IsZeroBehindARightAngle) {
  for_each_lobe(Lobes{}, [&]<class L>() {
    for (const double n : kExponents)
      for (const double s : {1.0, 1.5, 2.0}) EXPECT_EQ(L::value(s, n), 0) << L::kInfo.name;
  });
}

TEST(EveryLobe, HasTheMomentsThatAQuadratureFinds) {
  using Quadrature = boost::math::quadrature::gauss_kronrod<double, 61>;
  for_each_lobe(Lobes{}, [&]<class L>() {
    for (const double n : {1.0, 15.9, 16.0, 50.0, 128.0, 1024.0})
      for (const double s_max : {1.0, 1 - std::numbers::sqrt2 / 2})
        for (int j = 0; j < 4; ++j) {
          const auto f = [&](double s) { return L::value(s, n) * std::pow(s, j); };
          // The corner of a lobe of finite support is an end of an interval, not inside one.
          const double corner = std::min(s_max, 16 / n);
          const double expected = Quadrature::integrate(f, 0.0, corner, 12, 1e-13) +
                                  Quadrature::integrate(f, corner, s_max, 12, 1e-13);
          // Of the size of the moment of order 0, to which it is added (renderer/real.hpp).
          EXPECT_NEAR(L::moment(j, n, s_max), expected, 1e-13 * L::moment(0, n, s_max))
              << L::kInfo.name << " n = " << n << " j = " << j;
        }
  });
}

TEST(Cs16, IsTheCosineLobeAtExponent16AndNeverAboveIt) {
  using HWY_NAMESPACE::CosineLobe;
  using HWY_NAMESPACE::Cs16Lobe;
  for (const double s : abscissae(16))
    EXPECT_NEAR(Cs16Lobe::value(s, 16.0), CosineLobe::value(s, 16.0), 1e-14) << s;
  for (const double n : {16.0, 128.0, 1024.0})
    for (const double s :
         abscissae(n))  // Bernoulli's inequality; 4e-15 for the rounding of 16 factors
      EXPECT_LE(Cs16Lobe::value(s, n), CosineLobe::value(s, n) + 4e-15) << n << " " << s;
}

TEST(Cs16, DiffersFromTheCosineLobeByWhatThePaperSaysAtMost) {
  using HWY_NAMESPACE::CosineLobe;
  using HWY_NAMESPACE::Cs16Lobe;
  double largest = 0;
  for (double n = 16; n <= 1024; n *= 1.02)
    for (double x = 0; x < 1.5; x += 1e-3) {
      const double s = 2 * std::pow(std::sin(x / 2), 2);
      largest = std::max(largest, CosineLobe::value(s, n) - Cs16Lobe::value(s, n));
    }
  EXPECT_NEAR(largest, 1.7e-2, 5e-4);
}

}  // namespace
}  // namespace lobelia
