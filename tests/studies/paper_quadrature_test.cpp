// The instruments, before what they find: quadratures against closed forms, searches against extremes
// that are known, verdicts against figures that are just in or just out.
#include "studies/paper/claim.hpp"
#include "studies/paper/energy.hpp"
#include "studies/paper/search.hpp"
#include "tests/test.hpp"

namespace lobelia::paper {
namespace {

TEST(PaperEnergy, IsForCs16ItsClosedFormToFifteenDigits) {
  // With u = 1 - n s/16: the integral of cs16 s^j ds is (16/n)^(j+1) B(17, j+1).
  const auto moment = [](int j, Real n) {
    Real beta = 1.0L / 17;
    for (int i = 1; i <= j; ++i) beta *= Real(i) / Real(17 + i);
    return std::pow(16 / n, Real(j + 1)) * beta;
  };
  // From 55 on the half-angle lobe ends before a right angle.
  for (const Real n : {55.0L, 100.0L, 333.3L, 1024.0L}) {
    const Real m0 = moment(0, n), m1 = moment(1, n), m2 = moment(2, n), m3 = moment(3, n);
    const Real expected[] = {m0, m0 - m1, 4 * (m0 - m1), 4 * (m0 - 5 * m1 + 6 * m2 - 2 * m3),
                             m0, m0 - m1};
    for (std::size_t i = 0; i < kRows.size(); ++i)
      EXPECT_NEAR(double(hemisphere_integral(kRows[i], Lobe::kCs16, n) / (2 * kPi * expected[i])),
                  1, 1e-15)
          << kRows[i].title << " n = " << double(n);
  }
}

TEST(PaperEnergy, LosesEnergyIfCutAsPrinted) {
  const Row& row = kRows[kBlinn];
  const Real whole = hemisphere_integral(row, Lobe::kCs16, 1024),
             cut = hemisphere_integral(row, Lobe::kCs16, 1024, Cut::kPrinted);
  // The cut is at s = 2 sin^2(x/4) of the half angle: (1 - n s/16)^17 of the integral of s^0.
  const Real lost = std::pow(1 - 64 * versine(printed_theta_cr(1024) / 2), Real(17));
  EXPECT_NEAR(double(1 - cut / whole), double(lost), 0.01 * double(lost));
}

TEST(PaperSearch, FindsAMaximumBetweenTwoPointsAndAtAnEnd) {
  const auto parabola = [](Real x) { return 5 - (x - 0.37L) * (x - 0.37L); };
  EXPECT_NEAR(double(largest(parabola, 0, 1, 4).at), 0.37, 1e-6);
  EXPECT_NEAR(double(largest(parabola, 0, 1, 4).value), 5, 1e-12);
  EXPECT_EQ(double(largest([](Real x) { return x; }, 0, 1, 4).at), 1);
}

TEST(PaperVerdict, IsConfirmedWhereTheMeasurementRoundsToThePrint) {
  EXPECT_TRUE(rounds_to(4.706e-4L, 4.7e-4, 1e-5));
  EXPECT_TRUE(rounds_to(1.275e-3L, 1.3e-3, 1e-4));
  EXPECT_FALSE(rounds_to(1.2e-3L, 1.3e-3, 1e-4));
  EXPECT_FALSE(rounds_to(0, -9.7e-3, 1e-4));
}

TEST(PaperFigureText, HasTheDigitsAskedFor) {
  EXPECT_EQ(figure_text(0.0170125, 3), "1.70e-2");
  EXPECT_EQ(figure_text(0.9996, 3), "1.00");
  EXPECT_EQ(figure_text(36.75, 3), "36.8");
  EXPECT_EQ(figure_text(-4.706e-4, 2), "-4.7e-4");
  EXPECT_EQ(figure_text(0, 3), "0");
  EXPECT_EQ(vanishing("", 3e-16L, 1e-15).text, "below 1e-15");
  EXPECT_EQ(vanishing("", 0.5L, 1e-15).text, "0.500");
}

}  // namespace
}  // namespace lobelia::paper
