// How near the family pk3.m is to cos^n: what its file says, measured.
#include "tests/renderer/laws/cases.hpp"

namespace lobelia {
namespace {

/// The largest error against cos^n, of the peak.
double error(const LobeId& lobe, double n) {
  const PreparedLobe prepared = prepare(lobe, n), cosine = prepare(*find_lobe("cosine"), n);
  constexpr int kPoints = 4000;
  double largest = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double s = std::min(1.0, 30 / n) * i / kPoints;
    largest = std::max(largest, std::abs(prepared.value(s) - cosine.value(s)));
  }
  return largest;
}

/// Over n = 16 to 1e8, in steps of 2 %.
double largest_error(std::string_view name) {
  double largest = 0;
  for (double n = 16; n < 1e8; n *= 1.02) largest = std::max(largest, error(*find_lobe(name), n));
  return std::max(largest, error(*find_lobe(name), 1e8));
}

TEST(Pk, IsAsNearToTheCosineLobeAsItsFileSaysForEveryExponentFrom16On) {
  // Measured 3.489e-3, 4.774e-4, 5.36e-5, 1.22e-5.
  constexpr std::pair<const char*, double> kStated[] = {
      {"pk3.1", 3.5e-3}, {"pk3.2", 4.8e-4}, {"pk3.3", 5.4e-5}, {"pk3.4", 1.23e-5}};
  for (const auto& [name, stated] : kStated) {
    const double largest = largest_error(name);
    EXPECT_LE(largest, stated) << name;
    EXPECT_GE(largest, 0.98 * stated) << name;
  }
}

TEST(Pk, FallsAndEndsAtEveryExponent) {
  // Some of its cubics rise again behind the right angle.
  for (const char* name : {"pk3.1", "pk3.2", "pk3.3", "pk3.4"})
    for (double n = 1; n < 1000; n *= 1.01) {
      const PreparedLobe lobe = prepare(*find_lobe(name), n);
      double previous = 1;
      for (int i = 0; i <= 1000; ++i) {
        const double s = 2 * i / 1000.0, value = lobe.value(s);
        EXPECT_LE(value, previous * (1 + 1e-12)) << name << " n = " << n << " s = " << s;
        EXPECT_TRUE(s < 1 || value == 0) << name << " n = " << n << " s = " << s;
        previous = value;
      }
    }
}

TEST(Pk, HasFourMembersByName) {
  EXPECT_EQ(find_lobe("pk3.2")->order, 4);
  EXPECT_EQ(identifier(*find_lobe("pk3.2")), "pk3_2");
  for (const char* name : {"pk", "pk3", "pk3.0", "pk3.5", "pk3.9", "pk4", "pk3_2", "pk3.20"})
    EXPECT_FALSE(find_lobe(name)) << name;
}

}  // namespace
}  // namespace lobelia
