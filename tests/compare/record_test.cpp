#include "compare/compare.hpp"
#include "compare/metrics/catalogue.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

TEST(ComparisonRecord, HasEveryDefaultMetricWithItsTolerance) {
  const Image a = fixtures::highlight(180, 180, 10, 1.0),
              b = fixtures::highlight(180, 180, 10, 1.1);
  ComparisonOptions options;
  options.viewing.exposure_stops = -1;
  options.viewing.hdr_exposures = HdrExposures{-2, 1.5, 3};
  options.mask.assign(a.pixel_count(), 0);
  options.mask[180 * 90 + 90] = options.mask[180 * 90 + 91] = 1;
  options.highlight = true;
  options.tolerance = Tolerance{0.5, 0.25, 7};
  const Json record = as_json(comparison_record(compare(a, b, options), "a.exr", "b.exr"));
  EXPECT_EQ(record["viewing"]["exposureStops"], -1.0);
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs)
      EXPECT_EQ(record["metrics"].value(std::string(output.id), Json()).is_number(),
                metric->needs != Needs::kNoise && !metric->on_request && !metric->layer)
          << output.id;
  EXPECT_EQ(
      record["tolerance"],
      (Json{{"relative", 0.5}, {"ofPeak", 0.25}, {"allowedOutliers", 7}, {"onEdgesOnly", false}}));
}

TEST(ComparisonRecord, SaysHowNoiseWasTakenIntoAccount) {
  const Image a = fixtures::highlight(48, 48, 10, 1.0), b = fixtures::highlight(48, 48, 10, 1.01);
  ComparisonOptions options;
  options.limits = {{"rmse", 1}, {"drift", 0.003}};
  options.noise = NoiseOptions{.a = fixtures::even_noise(48, 48, 0.01f, 7, true),
                               .significance = 0.02,
                               .bootstraps = 8,
                               .seed = 5};
  const Json record = as_json(comparison_record(compare(a, b, options), "a.exr", "b.exr"));
  EXPECT_EQ(record["verdict"], "undecided");
  const double values = 3 * 48 * 48, regions = 3 * (24 * 24 + 12 * 12 + 6 * 6 + 3 * 3 + 2 * 2 + 1),
               patterns = 4;
  EXPECT_EQ(record["uncertainty"]["a"],
            (Json{{"freedom", 7.0}, {"shared", true}, {"fireflies", 0.0}, {"heavyTails", false}}));
  EXPECT_FALSE(record["uncertainty"].contains("b"));
  EXPECT_EQ(record["uncertainty"]["significance"], 0.02);
  EXPECT_EQ(record["uncertainty"]["tests"], values + regions + patterns);
  const double judges = 2 + double(default_limits().size()) + (options.limits.empty() ? 1 : 0);
  EXPECT_EQ(record["uncertainty"]["judges"], judges);
  EXPECT_NEAR(record["uncertainty"]["each"].get<double>(),
              1 - std::pow(1 - 0.02, 1 / (7 + patterns) / values), 1e-12)
      << "seven sizes and four patterns share it; no limit of this comparison is on them";
  EXPECT_EQ(record["uncertainty"]["bootstraps"], 8);
  EXPECT_EQ(record["uncertainty"]["seed"], 5);
  EXPECT_TRUE(record["metrics"]["z.max"].is_number());
  EXPECT_EQ(record["limits"][0]["standing"], "holds");
  EXPECT_EQ(record["limits"][1]["standing"], "open");
  EXPECT_EQ(record["limits"][1]["pass"], false);
  EXPECT_GT(record["limits"][1]["moreSamples"].get<double>(), 1);
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs) {
      const std::string id(output.id);
      EXPECT_EQ(record["errorBars"].contains(id), record["metrics"].contains(id) &&
                                                      output.better != Better::kNeither &&
                                                      metric->needs != Needs::kNoise)
          << id;
    }
  const Json& bar = record["errorBars"]["drift"];
  EXPECT_GT(bar["standardError"].get<double>(), 0);
  EXPECT_LT(bar["low"], record["metrics"]["drift"]);
  EXPECT_GT(bar["high"], record["metrics"]["drift"]);
}

}  // namespace
}  // namespace lobelia
