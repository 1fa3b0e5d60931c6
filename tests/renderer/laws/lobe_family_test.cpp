// What cs_k, the cosine lobe and the spherical Gaussian are to each other.
#include "tests/renderer/laws/cases.hpp"

namespace lobelia {
namespace {

LobeId cs(int k) { return *find_lobe("cs" + std::to_string(k)); }
const LobeId kCosine = *find_lobe("cosine"), kGaussian = *find_lobe("spherical_gaussian");

/// Values of s in [0, 1), dense where a lobe of exponent n falls.
std::vector<double> abscissae_below_1(double n) {
  std::vector<double> s;
  for (double x = 1e-6; x < 40; x *= 1.05)
    if (x < n) s.push_back(x / n);
  for (double x = 0; x < 1; x += 0.01) s.push_back(x);
  return s;
}

TEST(Cs, OfOrderNIsTheCosineLobe) {
  for (const int k : {2, 4, 6, 12, 16, 50, 64, 1000, 1024})
    for (const double s : abscissae_below_1(k))
      EXPECT_NEAR(lobe_value(cs(k), s, k), lobe_value(kCosine, s, k), 1e-15 * k) << k << " " << s;
}

TEST(Cs, OfOrderNHasTheCoefficientsAndTheSamplesOfTheCosineLobe) {
  for (const int k : {2, 12, 16, 64, 1024}) {
    for (const ModelId model : every_model())
      EXPECT_NEAR(radiance_coefficient({model, cs(k), Normalisation::kExact, double(k)}) /
                      radiance_coefficient({model, kCosine, Normalisation::kExact, double(k)}),
                  1, 1e-13)
          << info(model).name << " " << k;
    for (const double xi : {0.0, 1e-6, 0.25, 0.75, 0.999})
      EXPECT_NEAR(prepare(cs(k), k).sample(xi), prepare(kCosine, k).sample(xi), 1e-13);
  }
}

TEST(Cs, IsNeverAboveTheCosineLobeWhereNIsAtLeastK) {
  // Bernoulli's inequality; 1e-15 for the rounding of each of k factors.
  for (const int k : {2, 16, 64, 1024})
    for (const double n : {1.0, 4.0, 64.0, 1e4})
      for (const double s : abscissae_below_1(n * k))
        EXPECT_LE(lobe_value(cs(k), s, n * k), lobe_value(kCosine, s, n * k) + 1e-15 * k)
            << k << " " << n * k << " " << s;
}

TEST(Cs, GrowsIntoTheSphericalGaussianAsKGrows) {
  for (const double n : {16.0, 1024.0, 1e6}) {
    double previous = 1;
    for (const int k : {16, 64, 256, 1024}) {
      double largest = 0;
      for (const double s : abscissae_below_1(n))
        largest =
            std::max(largest, std::abs(lobe_value(cs(k), s, n) - lobe_value(kGaussian, s, n)));
      // (1 - x/k)^k = e^-x (1 - x^2/(2k) + ...), and x^2 e^-x / 2 is at most 2/e^2 = 0.27.
      EXPECT_LE(largest, 0.28 / k) << n << " " << k;
      EXPECT_LT(largest, previous / 3) << n << " " << k;
      previous = largest;
    }
  }
}

TEST(ClosedForms, DrawEachAngleAsOftenAsTheLobeIsHigh) {
  std::vector<LobeId> closed{kCosine, kGaussian};
  for (const int k : {2, 4, 8, 12, 16, 32, 64, 1024}) closed.push_back(cs(k));
  for (const LobeId& lobe : closed)
    for (const double n : kExponents) {
      const PreparedLobe prepared = prepare(lobe, n);
      for (const double s : abscissae_below_1(n))
        EXPECT_NEAR(prepared.density(s), prepared.density(0) * prepared.value(s),
                    1e-14 * prepared.density(0))
            << info(lobe).name << " " << n << " " << s;
    }
}

TEST(Cs, HasAnyEvenOrderUpTo1024ByNameAndNoOther) {
  EXPECT_EQ(info(*find_lobe("cs12")).formula, "max(0, 1 - n s / 12)^12");
  for (const char* name : {"cs", "cs0", "cs1", "cs15", "cs1026", "cs-2", "cs016", "cs2 "})
    EXPECT_FALSE(find_lobe(name)) << name;
}

}  // namespace
}  // namespace lobelia
