// Laws that every metric of the catalogue keeps: a newly listed metric is tested by these.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <set>

#include "compare/metrics/catalogue.hpp"
#include "tests/compare/pictures.hpp"

namespace lobelia {
namespace {

using ::testing::DoubleEq;
using ::testing::Pointwise;

const Tolerance kTolerance{1e-3, 1e-4, 3};

std::vector<std::pair<Image, Image>> pairs() {
  std::vector<std::pair<Image, Image>> list;
  list.emplace_back(testing::flat(16, 16, 0, 0, 0), testing::flat(16, 16, 1, 1, 1));
  list.emplace_back(testing::noise(40, 33, 1, 1.0f), testing::noise(40, 33, 2, 1.0f));
  list.emplace_back(testing::highlight(64, 48, 20, 3.0), testing::highlight(64, 48, 22, 3.1));
  list.emplace_back(testing::noise(1, 1, 3, 0.1f), testing::noise(1, 1, 4, 0.1f));
  list.emplace_back(testing::noise(70, 1, 5, 30.0f), testing::noise(70, 1, 6, 30.0f));
  list.emplace_back(testing::flat(3, 50, -1, 0.2f, 0), testing::flat(3, 50, 0.1f, 0.2f, 0.3f));
  return list;
}

std::vector<double> measure(const Metric& metric, const Image& a, const Image& b) {
  std::vector<double> values(metric.outputs.size(), -7.0);
  metric.measure(testing::input(a, b, &kTolerance), values);
  return values;
}

TEST(MetricCatalogue, IsNotEmptyAndHasUniqueIdsWithMeanings) {
  std::set<std::string_view> ids;
  for (const Metric* metric : metrics()) {
    ASSERT_FALSE(metric->outputs.empty());
    for (const MetricOutput& output : metric->outputs) {
      EXPECT_TRUE(ids.insert(output.id).second) << output.id << " is listed twice";
      EXPECT_FALSE(output.meaning.empty()) << output.id;
      EXPECT_EQ(find_metric_output(output.id), &output);
    }
  }
  for (const char* id :
       {"rmse", "max_abs", "max_abs.x", "max_abs.y", "peak", "max_rel_peak", "ciede2000.mean",
        "ciede2000.p95", "ciede2000.max", "flip.ldr.mean", "outliers"})
    EXPECT_TRUE(ids.count(id)) << id << " is promised by docs/records.md";
  EXPECT_EQ(find_metric_output("no such metric"), nullptr);
}

TEST(MetricLaws, APictureHasNoErrorAgainstItself) {
  int checked = 0;
  for (const auto& [a, b] : pairs())
    for (const Image* image : {&a, &b})
      for (const Metric* metric : metrics()) {
        const std::vector<double> values = measure(*metric, *image, *image);
        for (std::size_t i = 0; i < values.size(); ++i)
          if (metric->outputs[i].kind == OutputKind::kError) {
            EXPECT_EQ(values[i], 0) << metric->outputs[i].id;
            ++checked;
          }
      }
  EXPECT_GT(checked, 60);
}

TEST(MetricLaws, DifferentPicturesHaveAPositiveError) {
  // Of each metric at least one output sees the difference of each pair; none is negative or NaN.
  for (const auto& [a, b] : pairs())
    for (const Metric* metric : metrics()) {
      double largest = 0;
      const std::vector<double> values = measure(*metric, a, b);
      for (std::size_t i = 0; i < values.size(); ++i)
        if (metric->outputs[i].kind == OutputKind::kError) {
          EXPECT_GE(values[i], 0) << metric->outputs[i].id;
          largest = std::max(largest, values[i]);
        }
      EXPECT_GT(largest, 0) << metric->outputs[0].id << ", " << a.width() << " x " << a.height();
    }
}

TEST(MetricLaws, AMetricThatIsCalledSymmetricDoesNotChangeWhenThePicturesAreExchanged) {
  for (const auto& [a, b] : pairs())
    for (const Metric* metric : metrics()) {
      const std::vector<double> forth = measure(*metric, a, b), back = measure(*metric, b, a);
      for (std::size_t i = 0; i < forth.size(); ++i)
        if (metric->outputs[i].symmetric) {
          // Not bit for bit: CIEDE2000's means of angles round differently.
          EXPECT_NEAR(forth[i], back[i], 1e-12 * std::abs(forth[i])) << metric->outputs[i].id;
        }
    }
}

TEST(MetricLaws, AMetricThatIsNotCalledSymmetricIsNot) {
  for (const Metric* metric : metrics())
    for (std::size_t i = 0; i < metric->outputs.size(); ++i) {
      if (metric->outputs[i].symmetric) continue;
      bool changed = false;
      const Image dim = testing::flat(8, 8, 0.0015f, 0, 0), bright = testing::flat(8, 8, 1, 0, 0);
      const Tolerance half{0.9985, 0, 0, std::vector<std::uint8_t>(8 * 8, 0)};
      std::vector<double> forth(metric->outputs.size()), back(forth);
      metric->measure(testing::input(dim, bright, &half), forth);
      metric->measure(testing::input(bright, dim, &half), back);
      changed = forth[i] != back[i];
      EXPECT_TRUE(changed) << metric->outputs[i].id;
    }
}

TEST(MetricLaws, ALargerErrorIsNeverRatedLower) {
  const Image reference = testing::highlight(64, 64, 20, 1.0);
  std::vector<std::vector<double>> before(metrics().size());
  for (const double peak : {0.999, 0.99, 0.95, 0.8}) {
    const Image picture = testing::highlight(64, 64, 20, peak);
    for (std::size_t k = 0; k < metrics().size(); ++k) {
      const Metric& metric = *metrics()[k];
      const std::vector<double> values = measure(metric, picture, reference);
      for (std::size_t i = 0; i < values.size() && !before[k].empty(); ++i)
        if (metric.outputs[i].kind == OutputKind::kError) {
          EXPECT_GE(values[i], before[k][i]) << metric.outputs[i].id << " at peak " << peak;
        }
      before[k] = values;
    }
  }
}

TEST(MetricLaws, TheNumberOfThreadsDoesNotChangeABit) {
  const Image a = testing::noise(300, 200, 8, 1.0f), b = testing::highlight(300, 200, 5, 1.0);
  for (const Metric* metric : metrics()) {
    const std::vector<double> many = measure(*metric, a, b);
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_THAT(measure(*metric, a, b), Pointwise(DoubleEq(), many)) << metric->outputs[0].id;
  }
}

TEST(Rmse, IsTheRootOfTheMeanSquareOverAllChannels) {
  const Image a = testing::flat(5, 4, 1, 2, 3), b = testing::flat(5, 4, 1, 2, 6);
  EXPECT_DOUBLE_EQ(measure(*metrics()[0], a, b)[0], std::sqrt(9.0 / 3));
}

TEST(Rmse, KeepsItsDigitsOnAPictureWhereAFloatSumWouldStall) {
  // Each square is 2^-26: a float32 sum of more than 2^24 of them no longer grows.
  const Image a = testing::flat(4096, 2048, 0, 0, 0);
  const float step = 1.0f / 8192;
  const Image b = testing::flat(4096, 2048, step, step, step);
  EXPECT_DOUBLE_EQ(measure(*metrics()[0], a, b)[0], step);
}

TEST(MaxAbs, SaysWhichPixel) {
  const Image a = testing::flat(9, 7, 0.5f, 0.5f, 0.5f);
  Image b = a;
  b.pixel(6, 2)[1] = 0.75f;
  EXPECT_THAT(measure(*metrics()[1], a, b), ::testing::ElementsAre(0.25, 6, 2));
}

TEST(MaxRelPeak, IsInfiniteAgainstABlackReference) {
  const Image black = testing::flat(4, 4, 0, 0, 0), grey = testing::flat(4, 4, 0.1f, 0.1f, 0.1f);
  EXPECT_TRUE(std::isinf(measure(*metrics()[2], grey, black)[1]));
  EXPECT_FLOAT_EQ(float(measure(*metrics()[2], black, grey)[1]), 1.0f);
}

TEST(DisplayLight, IsExposedAndClipped) {
  Image image(3, 1);
  image.pixel(0, 0)[0] = 0.25f;
  image.pixel(1, 0)[1] = -1.0f;
  image.pixel(2, 0)[2] = 1e30f;
  const DisplayLight shown(image, 1);
  EXPECT_EQ(shown.at(0), (Rgb{0.5, 0, 0}));
  EXPECT_EQ(shown.at(1), (Rgb{0, 0, 0}));
  EXPECT_EQ(shown.at(2), (Rgb{0, 0, 1}));
}

}  // namespace
}  // namespace lobelia
