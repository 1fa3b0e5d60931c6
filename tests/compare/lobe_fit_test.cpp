#include "profile/lobe_fit.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr double kCoefficient = 2.5;

double cosine_lobe(double angle, double n) {
  return std::exp(n * std::log1p(-2 * std::pow(std::sin(angle / 2), 2)));
}

/// Pixels of a plane of angles around a middle that lies on none of them, down to 1/1000 of the lobe; about
/// `across` of them over the half-width. The scale falls to one side as a cosine of incidence does.
std::vector<LobeSample> lobe(double n, double across,
                             const std::function<double(double angle)>& value) {
  const double half = std::acos(std::pow(0.5, 1 / n)), end = std::acos(std::pow(1e-3, 1 / n));
  const double step = half / across;
  const int reach = int(end / step) + 1;
  std::vector<LobeSample> samples;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      const double dx = (x + 0.137) * step, dy = (y - 0.291) * step, angle = std::hypot(dx, dy);
      if (angle >= end) continue;
      const double scale = 0.7 + 0.2 * dx / end;
      samples.push_back({angle, scale, scale * kCoefficient * value(angle)});
    }
  return samples;
}

std::vector<LobeSample> cosine(double n, double across) {
  return lobe(n, across, [n](double angle) { return cosine_lobe(angle, n); });
}

TEST(CosineFit, RecoversTheExponentWithinItsErrorFromFloats) {
  for (const double n : {8.0, 16.0, 128.0, 1024.0, 8192.0, 65536.0, 1e7})
    for (const double across : {2.0, 8.0, 30.0}) {
      std::vector<LobeSample> samples = cosine(n, across);
      for (LobeSample& sample : samples) sample.radiance = double(float(sample.radiance));
      const LobeFit fit = fit_cosine_lobe(samples);
      ASSERT_EQ(fit.why_not, "") << n;
      EXPECT_NEAR(fit.width, n, 4 * fit.standard_error) << n << ' ' << across;
      EXPECT_LT(fit.standard_error, 1e-7 * n) << n << ' ' << across;
      EXPECT_GT(fit.standard_error, 0);
      EXPECT_NEAR(fit.coefficient, kCoefficient, 1e-6);
      EXPECT_EQ(fit.pixels, samples.size());
    }
}

TEST(CosineFit, SaysHowFarAnotherLobeIsFromItsCosine) {
  const auto cs16 = [](double angle) {
    const double s = 2 * std::pow(std::sin(angle / 2), 2);
    return std::pow(std::max(0.0, 1 - 256 * s / 16), 16);
  };
  const LobeFit fit = fit_cosine_lobe(lobe(256, 8, cs16));
  ASSERT_EQ(fit.why_not, "");
  // Narrower than cos^n, as it is 0 from a finite angle on.
  EXPECT_GT(fit.width, 258);
  EXPECT_LT(fit.width, 290);
  EXPECT_GT(fit.residual, 1e-3);
  EXPECT_LT(fit.residual, 1.7e-2) << "the paper's bound of the whole difference";
  EXPECT_GT(std::abs(fit.width - 256), 10 * fit.standard_error);
}

TEST(CosineFit, SaysWhyThereIsNone) {
  const std::vector<LobeSample> good = cosine(64, 6);
  const auto why = [](std::vector<LobeSample> samples) {
    const LobeFit fit = fit_cosine_lobe(samples);
    EXPECT_TRUE(std::isnan(fit.width) && std::isnan(fit.standard_error)) << fit.why_not;
    return fit.why_not;
  };
  const auto changed = [&](auto change) {
    std::vector<LobeSample> samples = good;
    for (LobeSample& sample : samples) change(sample);
    return samples;
  };
  EXPECT_EQ(why({}), "it has 0 pixels, too few: 9 are needed");
  EXPECT_EQ(why({good.begin(), good.begin() + 8}), "it has 8 pixels, too few: 9 are needed");
  EXPECT_EQ(why(changed([](LobeSample& s) { s.radiance = 0; })), "it holds no light");
  EXPECT_EQ(why(changed([](LobeSample& s) { s.radiance = -1; })), "it holds no light");
  EXPECT_EQ(why(changed([](LobeSample& s) { s.scale = 0; })), "it holds no light");
  EXPECT_EQ(why(cosine(64, 1)),
            "not resolved: 3 of its pixels are above half of its peak, 9 are needed");
  // Darkest in the middle.
  EXPECT_EQ(why(changed([](LobeSample& s) { s.radiance = s.scale * (0.1 + s.angle); })),
            "no power of a cosine fits it better than its neighbours do");
  std::vector<LobeSample> broken = good;
  broken[7].radiance = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(why(broken), "a pixel of it is not finite");
  broken[7].radiance = std::numeric_limits<double>::infinity();
  EXPECT_EQ(why(broken), "a pixel of it is not finite");
}

TEST(CosineFit, TakesAnglesUpToTheHorizonAndBeyond) {
  std::vector<LobeSample> samples = cosine(1, 12);
  samples.push_back({std::numbers::pi / 2, 1, 0});
  samples.push_back({std::numbers::pi, 1, 0});
  EXPECT_NEAR(fit_cosine_lobe(samples).width, 1, 1e-9);
}

}  // namespace
}  // namespace lobelia
