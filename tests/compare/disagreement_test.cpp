#include "compare/disagreement.hpp"

#include "compare/metrics/catalogue.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

double share(const char* id, double value, double limit) {
  return share_of_limit(*find_metric_output(id), value, limit);
}

LimitResult result(const char* id, double value, double limit) {
  return {id, limit, value, is_within(*find_metric_output(id), value, limit), {}, {}};
}

std::vector<std::string> of(const LimitResult& a, const LimitResult& b) {
  return disagreements(std::vector<LimitResult>{a, b});
}

TEST(ShareOfLimit, IsOneAtTheLimitAndNothingForEqualPictures) {
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs) {
      if (output.better == Better::kNeither) continue;
      EXPECT_DOUBLE_EQ(share_of_limit(output, 0.5, 0.5), 1) << output.id;
      EXPECT_EQ(share_of_limit(output, output.best, 0.5), 0) << output.id;
    }
}

TEST(ShareOfLimit, GrowsWithTheErrorInTheDirectionOfTheMetric) {
  EXPECT_DOUBLE_EQ(share("rmse", 0.3, 0.1), 3);
  EXPECT_DOUBLE_EQ(share("drift", -0.3, 0.1), 3);
  EXPECT_DOUBLE_EQ(share("ssim", 0.7, 0.9), 3);
  EXPECT_DOUBLE_EQ(share("psnr", 20, 40), 10);
  EXPECT_EQ(share("rmse", 1e-9, 0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(share("rmse", 0, 0), 0);
}

TEST(Disagreement, IsFlaggedIfOnlyOneFamilyFails) {
  EXPECT_THAT(of(result("max_rel_peak", 0.11, 0.01), result("flip.ldr.mean", 0.009, 0.01)),
              ElementsAre("max_rel_peak takes up 11 of its limit (0.11, limit 0.01), but "
                          "flip.ldr.mean takes up 0.9 of its limit (0.009, limit 0.01)"));
  EXPECT_THAT(of(result("max_rel_peak", 0.09, 0.01), result("flip.ldr.mean", 0.009, 0.01)),
              IsEmpty())
      << "neither is wide of its limit";
}

TEST(Disagreement, IsFlaggedIfOnlyOneFamilyPasses) {
  EXPECT_EQ(of(result("flip.ldr.mean", 0.0009, 0.01), result("max_rel_peak", 0.011, 0.01)).size(),
            1u);
  EXPECT_EQ(of(result("ssim", 0.9995, 0.99), result("ciede2000.max", 1.1, 1)).size(), 1u);
}

TEST(Disagreement, IsOnlyFlaggedBetweenFamilies) {
  EXPECT_THAT(of(result("rmse", 1, 0.01), result("max_abs", 1, 2)), IsEmpty());
  EXPECT_THAT(of(result("rmse", 1, 0.01), result("flip.ldr.mean", 1, 0.01)), IsEmpty());
  EXPECT_THAT(of(result("rmse", 0, 0.01), result("flip.ldr.mean", 0, 0.01)), IsEmpty());
}

TEST(Disagreement, IgnoresUnmeasuredMetrics) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(of(result("ssim", nan, 0.99), result("rmse", 0, 0.01)), IsEmpty());
}

}  // namespace
}  // namespace lobelia
