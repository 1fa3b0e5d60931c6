// The integrals that each lobe states, against quadrature: moments, density, samples.
#include "renderer/lobes/catalogue.hpp"
#include "renderer/models/model.hpp"
#include "renderer/type_list.hpp"
#include "tests/renderer/laws/cases.hpp"
#include "tests/renderer/laws/quadrature.hpp"

namespace lobelia {
namespace {

constexpr double kAllExponents[] = {kMinExponent, 0.1, 0.9, 1,   1.1, 2,           15.9,
                                    16,           54,  128, 1e3, 1e4, kMaxExponent};
constexpr double kLast = 1 - 0x1p-53;  ///< the largest of the numbers in [0, 1)

void for_every_lobe(double n, auto&& f) {
  int count = 0;
  map_types<int>(HWY_NAMESPACE::Lobes{}, [&]<class L>() {
    std::vector<int> orders(L::kOrders.begin(), L::kOrders.end());
    if constexpr (LobeFamily<L>) {
      for (const int unlisted : {12, 1000, kMaxOrder})
        if (L::has(unlisted)) orders.push_back(unlisted);
    } else {
      orders = {0};
    }
    for (const int order : orders) {
      f(fmt::format("{} order {} n = {:g}", L::kInfo.name, order, n), L({n, order}));
      ++count;
    }
    return 0;
  });
  EXPECT_GT(count, 0);
}

TEST(EveryLobe, HasTheMomentsThatItSays) {
  for (const double n : kAllExponents)
    for_every_lobe(n, [&](const std::string& name, const auto& lobe) {
      for (const double s_max : {0.01, kHalfOfRightAngle, 1.0})
        for (int j = 0; j < 4; ++j) {
          const double truth =
              integrate([&](double s) { return lobe.value(s) * std::pow(s, j); }, 0.5 / n, s_max);
          EXPECT_NEAR(lobe.moment(j, s_max), truth, 1e-12 * truth)
              << name << " moment " << j << " to " << s_max;
        }
    });
}

TEST(EveryLobe, HasADensityThatIntegratesToOne) {
  for (const double n : kAllExponents)
    for_every_lobe(n, [&](const std::string& name, const auto& lobe) {
      EXPECT_NEAR(integrate([&](double s) { return lobe.density(s); }, 0.5 / n, 1), 1, 1e-11)
          << name;
    });
}

TEST(EveryLobe, DrawsItsSamplesFromItsDensity) {
  for (const double n : kAllExponents)
    for_every_lobe(n, [&](const std::string& name, const auto& lobe) {
      double previous = 0;
      for (const double xi : {0.0, 1e-12, 1e-3, 0.2, 0.5, 0.9, 0.999, 1 - 1e-9, kLast}) {
        const double s = lobe.sample(xi);
        ASSERT_TRUE(s >= previous && s <= 1) << name << " from " << xi << ": " << s;
        previous = s;
        const double below =
            s > 0 ? integrate([&](double x) { return lobe.density(x); }, 0.5 / n, s) : 0;
        EXPECT_NEAR(below, xi, 1e-11) << name;
      }
      EXPECT_EQ(lobe.sample(0), 0) << name;
    });
}

TEST(EveryLobe, GivesNoSampleMoreWeightThanOneInTheMiddle) {
  for (const double n : kAllExponents)
    for_every_lobe(n, [&](const std::string& name, const auto& lobe) {
      const double middle = lobe.density(0);
      EXPECT_TRUE(std::isfinite(middle) && middle > 0) << name;
      for (double xi = 0; xi < 1; xi += 1.0 / 64) {
        const double s = lobe.sample(xi);
        EXPECT_LE(lobe.value(s) * middle, lobe.density(s) * (1 + 1e-12)) << name << " " << s;
      }
    });
}

}  // namespace
}  // namespace lobelia
