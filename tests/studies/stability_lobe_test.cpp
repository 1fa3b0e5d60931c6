// The float32 arithmetic that each lobe's file states. Every lobe of the catalogue is met here without a
// line written; stability_baseline.cpp runs the same on the oldest processor.
#include <cfenv>

#include "reference_scenes/engines/analytic/formulas/truth.hpp"
#include "renderer/kernels/kernels.hpp"
#include "studies/stability/cases.hpp"
#include "tests/test.hpp"

namespace lobelia::stability {
namespace {

constexpr std::size_t kPoints = 200 * kChunk;

/// s from next to 0 to past the lobe's end, by decades and evenly, and crowded where a family's lobe meets 0.
std::vector<float> many_abscissae(LobeId lobe, double n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform;
  const double end = lobe.order > 0 ? n * s_of_value(lobe, n, 0, 60) : 0;
  std::vector<float> s(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    double x = 90 * uniform(random);
    if (i % 4 == 1) x = 10 * uniform(random);
    if (i % 4 == 2) x = std::pow(10, -8 * uniform(random));
    if (i % 4 == 3 && lobe.order > 0) x = end * -std::expm1(-15 * uniform(random));
    s[i] = float(std::min(2.0, x / n));
  }
  return s;
}

std::vector<float> in_float32(LobeId lobe, double n, const std::vector<float>& s) {
  std::vector<float> value(s.size());
  const Highlight highlight{{}, lobe, Normalisation::kExact, n};
  for (std::size_t i = 0; i < s.size(); i += kChunk)
    kernels().lobe32(lobe)(highlight, kChunk, s.data() + i, value.data() + i);
  return value;
}

double stated_ulp(const Float32Error& stated, double truth) {
  return stated.ulp - (truth > 0 ? stated.ulp_per_nat * std::log(truth) : 0);
}

TEST(EveryLobeInFloat32, IsWithinItsStatedBoundInTheHardCases) {
  std::size_t rows = 0;
  for (const LobeId& lobe : lobes_under_test())
    for (const Row& row : lobe_rows(lobe)) {
      ++rows;
      EXPECT_EQ(row.outcome, "within") << row.lobe << " n = " << row.exponent << ", " << row.name
                                       << ": " << row.ours.value << " for " << row.truth;
    }
  EXPECT_EQ(rows, lobes_under_test().size() * kExponents.size() * 15);
}

TEST(EveryLobeInFloat32, IsWithinItsTightBoundEverywhere) {
  for (const LobeId& lobe : lobes_under_test()) {
    double of_peak_used = 0, ulp_used = 0;
    for (const double n : kExponents) {
      const std::vector<float> s = many_abscissae(lobe, n, 1), value = in_float32(lobe, n, s);
      const Float32Error stated = lobe_float32_error(lobe, n);
      // Our own double precision finds the worst of many; the reference judges it.
      std::size_t worst_of_peak = 0, worst_ulp = 0;
      double of_peak = -1, ulp = -1;
      for (std::size_t i = 0; i < s.size(); ++i) {
        const double truth = lobe_value(lobe, s[i], n);
        const Answer answer = judge(value[i], truth, 1);
        if (answer.of_peak > of_peak) of_peak = answer.of_peak, worst_of_peak = i;
        const double used = answer.ulp / stated_ulp(stated, truth);
        if (used > ulp) ulp = used, worst_ulp = i;
        ASSERT_TRUE(value[i] == 0 || std::isnormal(value[i])) << info(lobe).name << " " << s[i];
      }
      const auto judged = [&](std::size_t i) {
        return judge(value[i], truth::lobe(lobe, s[i], n), 1);
      };
      of_peak = judged(worst_of_peak).of_peak / stated.of_peak;
      ulp = judged(worst_ulp).ulp / stated_ulp(stated, truth::lobe(lobe, s[worst_ulp], n));
      EXPECT_LE(of_peak, 1) << info(lobe).name << " n = " << n << " s = " << s[worst_of_peak];
      EXPECT_LE(ulp, 1) << info(lobe).name << " n = " << n << " s = " << s[worst_ulp];
      of_peak_used = std::max(of_peak_used, of_peak);
      ulp_used = std::max(ulp_used, ulp);
    }
    EXPECT_GT(of_peak_used, 0.25) << info(lobe).name;
    // A pk3.m states none: where its cubic meets 0 it keeps no digits.
    if (std::isfinite(lobe_float32_error(lobe, 1).ulp)) {
      EXPECT_GT(ulp_used, 0.25) << info(lobe).name;
    }
  }
}

TEST(EveryLobeInFloat32, MeetsNoDenormalIntermediate) {
  // A processor notes it when a result is below the smallest normal number.
  const auto underflows = [](auto work) {
    std::feclearexcept(FE_ALL_EXCEPT);
    work();
    return std::fetestexcept(FE_UNDERFLOW) != 0;
  };
  volatile float tiny = 1e-30f, product = 0;
  ASSERT_TRUE(underflows([&] { product = tiny * tiny; }));
  int too_small = 0;
  for (const LobeId& lobe : lobes_under_test())
    for (const double n : kExponents) {
      const std::vector<float> s = many_abscissae(lobe, n, 2);
      std::vector<float> value;
      EXPECT_FALSE(underflows([&] { value = in_float32(lobe, n, s); })) << info(lobe).name << n;
      for (std::size_t i = 0; i < s.size(); ++i)
        if (value[i] == 0 && lobe_value(lobe, s[i], n) > 0) ++too_small;
    }
  EXPECT_GT(too_small, 10000);
}

}  // namespace
}  // namespace lobelia::stability
