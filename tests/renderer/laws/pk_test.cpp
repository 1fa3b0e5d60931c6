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

TEST(Pk, IsWithinItsStatedErrorOfTheCosineLobe) {
  // Measured 3.489e-3, 4.774e-4, 5.36e-5, 1.22e-5.
  constexpr std::pair<const char*, double> kStated[] = {
      {"pk3.1", 3.5e-3}, {"pk3.2", 4.8e-4}, {"pk3.3", 5.4e-5}, {"pk3.4", 1.23e-5}};
  for (const auto& [name, stated] : kStated) {
    const double largest = largest_error(name);
    EXPECT_LE(largest, stated) << name;
    EXPECT_GE(largest, 0.98 * stated) << name;
  }
}

}  // namespace
}  // namespace lobelia
