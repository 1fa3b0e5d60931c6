// The shape of every lobe: 1 in the middle, falling, 0 behind a right angle.
#include "tests/renderer/laws/cases.hpp"

namespace lobelia {
namespace {

/// Values of s from 0 to 2, dense where a lobe of exponent n falls.
std::vector<double> abscissae(double n) {
  std::vector<double> s{0, 1, 2};
  for (double x = 1e-6; x < 40; x *= 1.05) s.push_back(std::min(2.0, x / n));
  for (double x = 0; x <= 2; x += 0.01) s.push_back(x);
  std::sort(s.begin(), s.end());
  return s;
}

TEST(EveryLobe, FallsFromOneToZeroByNormalNumbers) {
  for (const LobeId& lobe : lobes())
    for (const double n : kExponents) {
      EXPECT_EQ(lobe_value(lobe, 0, n), 1) << info(lobe).name << " n = " << n;
      double previous = 1;
      for (const double s : abscissae(n)) {
        const double value = lobe_value(lobe, s, n);
        EXPECT_TRUE(value >= 0 && value <= previous * (1 + 1e-12) && (s < 1 || value == 0) &&
                    (value == 0 || std::isnormal(value)))
            << info(lobe).name << " n = " << n << " s = " << s << " value " << value;
        previous = value;
      }
    }
}

TEST(EveryLobe, FallsInTheMiddleAsTheSameBellWhateverTheLobe) {
  // 1 - n s + ...: that is what makes an exponent the same thing for all of them. The next term is
  // n^2 s^2 or less, and s^2 n at small n. A pk3.m is fitted to cos^n as a whole, so that it falls in the middle by 2.6 %,
  // 0.41 %, 0.050 % and 0.008 % less, measured for k = 2 to 16. For GGX an exponent stands for the same peak of a
  // heightfield's distribution: with its heavy tail it has to fall twice as fast.
  for (const LobeId& lobe : lobes())
    for (const double n : kExponents) {
      const double s = 1e-4 / std::max(1.0, n);
      const double fitted = family(lobe) == "pk" ? 0.11 / (lobe.order * lobe.order) : 0;
      const double slope = family(lobe) == "ggx" ? 2 : 1;
      EXPECT_NEAR((1 - lobe_value(lobe, s, n)) / (n * s) / slope, 1, slope * 1.1e-4 + fitted)
          << info(lobe).name << " n = " << n;
    }
}

}  // namespace
}  // namespace lobelia
