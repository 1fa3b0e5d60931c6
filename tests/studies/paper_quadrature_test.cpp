// The instruments, before what they find: quadratures against closed forms, searches against extremes
// that are known, verdicts against figures that are just in or just out.
#include "studies/paper/claim.hpp"
#include "studies/paper/energy.hpp"
#include "studies/paper/search.hpp"
#include "tests/test.hpp"

namespace lobelia::paper {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

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

/// The same integral over the hemisphere of the other direction itself, by midpoints.
double albedo_by_brute_force(const Row& row, Real n, double coefficient, double theta, Held held) {
  constexpr int kElevations = 500, kAzimuths = 500;
  const double step = std::numbers::pi / 2 / kElevations, turn = std::numbers::pi / kAzimuths;
  double sum = 0;
  for (int i = 0; i < kElevations; ++i)
    for (int j = 0; j < kAzimuths; ++j) {
      const double other = (i + 0.5) * step, azimuth = (j + 0.5) * turn;
      const double x = std::sin(other) * std::cos(azimuth), y = std::sin(other) * std::sin(azimuth),
                   z = std::cos(other), held_x = std::sin(theta), held_z = std::cos(theta);
      const double cosine = row.half_angle || row.distribution
                                ? (z + held_z) / std::hypot(x + held_x, y, z + held_z)
                                : z * held_z - x * held_x;
      if (cosine <= 0) continue;
      const bool weighted = !row.is_rdf() || held == Held::kBeam;
      sum += std::pow(cosine, double(n)) * (weighted ? z : 1) * std::sin(other);
    }
  sum *= 2 * step * turn * coefficient;
  if (row.distribution) sum /= 4;
  return row.is_rdf() && held == Held::kBeam ? sum / std::cos(theta) : sum;
}

TEST(PaperAlbedo, IsTheSumOverAllDirections) {
  for (const Row& row : kRows)
    for (const Held held : {Held::kBeam, Held::kEye})
      for (const double degrees : {0.0, 30.0, 75.0, 88.0}) {
        const double coefficient = double(row.cosine_column(16));
        const double ours = albedo(row, Lobe::kCosine, 16, coefficient, degrees * kRadian, held);
        const double sum = albedo_by_brute_force(row, 16, coefficient, degrees * kRadian, held);
        EXPECT_NEAR(ours / sum, 1, 1e-4) << row.title << " at " << degrees;  // measured 3e-5
      }
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
