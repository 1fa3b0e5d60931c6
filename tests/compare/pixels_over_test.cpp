// Metrics on request: 8-bit code values, pixels over a threshold, and lists of metrics.
#include "compare/compare.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/metrics/code_values.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// Random 8-bit code values, and the picture of them.
struct Coded {
  std::vector<std::uint8_t> codes;
  Image image;
};

/// Mostly within `step` of `near`, if that is not empty.
Coded random_codes(int width, int height, unsigned seed, const std::vector<std::uint8_t>& near = {},
                   int step = 0) {
  std::mt19937 random(seed);
  Coded result{std::vector<std::uint8_t>(std::size_t(3 * width * height)), Image(width, height)};
  for (std::size_t i = 0; i < result.codes.size(); ++i) {
    const int code = near.empty() ? int(random() % 256)
                                  : int(near[i]) + int(random() % unsigned(2 * step + 1)) - step;
    result.codes[i] = std::uint8_t(std::clamp(code, 0, 255));
    result.image.values()[i] = srgb_decoded(float(result.codes[i]) / 255);
  }
  return result;
}

TEST(CodeValues, AreItsOwnForADecodedEightBitPicture) {
  const Coded picture = random_codes(64, 64, 1);
  EXPECT_TRUE(std::ranges::equal(code_values(DisplayLight(picture.image, 0)), picture.codes));
  EXPECT_EQ(code_values(DisplayLight(fixtures::flat(1, 1, -1, 0, 9), 0)), (CodeValues{0, 0, 255}));
}

TEST(CodeValues, AreThoseOfTheDisplayToHalfAStep) {
  const Image image = fixtures::noise(64, 64, 3, 1.1f);
  const CodeValues codes = code_values(DisplayLight(image, 0));
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const double light = std::min(double(image.values()[i]), 1.0);
    const double encoded =
        light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    EXPECT_NEAR(double(codes[i]), 255 * encoded, 0.5 + 1e-4);
  }
}

TEST(PixelsOver, AThresholdAreThoseOfAPlainLoopOverTheCodes) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Coded b = random_codes(31, 23, seed), a = random_codes(31, 23, seed + 5, b.codes, 20);
    ComparisonOptions options;
    for (std::size_t i = 0; i < a.image.pixel_count(); ++i) options.mask.push_back(i % 5 == seed);
    options.metrics = {"code",
                       "code.mask",
                       "share_over.code=7",
                       "pixels_over.yiq=0.05",
                       "share_over.yiq=0.05.mask",
                       "share_over.abs=0.01",
                       "pixels_over.code=7.outside"};
    const Comparison comparison = compare(a.image, b.image, options);
    double largest = 0, sum = 0, over_7 = 0, over_yiq = 0, over_abs = 0, masked = 0, masked_yiq = 0,
           outside_7 = 0, masked_sum = 0;
    std::size_t first = 0;
    for (std::size_t pixel = 0; pixel < a.image.pixel_count(); ++pixel) {
      double d[3], most = 0, most_abs = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t i = 3 * pixel + c;
        d[c] = double(a.codes[i]) - double(b.codes[i]);
        most = std::max(most, std::abs(d[c]));
        sum += std::abs(d[c]);
        masked_sum += options.mask[pixel] ? std::abs(d[c]) : 0;
        most_abs =
            std::max(most_abs, std::abs(double(a.image.values()[i]) - double(b.image.values()[i])));
      }
      // As pixelmatch 5.3 has it: colorDelta, and maxDelta = 35215 * threshold * threshold.
      const double y = d[0] * 0.29889531 + d[1] * 0.58662247 + d[2] * 0.11448223;
      const double i = d[0] * 0.59597799 - d[1] * 0.27417610 - d[2] * 0.32180189;
      const double q = d[0] * 0.21147017 - d[1] * 0.52261711 + d[2] * 0.31114694;
      const bool differs = 0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q > 35215 * 0.05 * 0.05;
      if (most > largest) largest = most, first = pixel;
      over_7 += most > 7, over_yiq += differs, over_abs += most_abs > 0.01;
      masked += options.mask[pixel] != 0;
      masked_yiq += options.mask[pixel] != 0 && differs;
      outside_7 += options.mask[pixel] == 0 && most > 7;
    }
    const double pixels = double(a.image.pixel_count());
    EXPECT_EQ(comparison.value("code.max"), largest);
    EXPECT_EQ(comparison.value("code.max.x"), double(first % 31));
    EXPECT_EQ(comparison.value("code.max.y"), double(first / 31));
    EXPECT_NEAR(comparison.value("code.mean"), sum / pixels / 3, 1e-12);
    EXPECT_NEAR(comparison.value("code.mean.mask"), masked_sum / masked / 3, 1e-12);
    EXPECT_NEAR(comparison.value("share_over.code=7"), over_7 / pixels, 1e-12);
    EXPECT_EQ(comparison.value("pixels_over.code=7"), over_7);
    EXPECT_EQ(comparison.value("pixels_over.code=7.outside"), outside_7);
    EXPECT_EQ(comparison.value("pixels_over.yiq=0.05"), over_yiq);
    EXPECT_NEAR(comparison.value("share_over.yiq=0.05.mask"), masked_yiq / masked, 1e-12);
    EXPECT_EQ(comparison.value("pixels_over.abs=0.01"), over_abs);
    EXPECT_GT(over_yiq, 0);
    EXPECT_LT(over_yiq, pixels);
  }
}

TEST(PixelsOver, TakesAnyThresholdInItsShortestForm) {
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs) {
      const std::size_t any = output.id.find("=0");
      if (!metric->on_request || metric->threshold != 0 || any == output.id.npos) continue;
      std::string id(output.id);
      id.replace(any, 2, "=00.2500");
      const MetricOutput* found = find_metric_output(id);
      ASSERT_NE(found, nullptr) << id;
      std::string expected(output.id);
      expected.replace(any, 2, "=0.25");
      EXPECT_EQ(found->id, expected);
      EXPECT_EQ(find_metric(expected)->threshold, 0.25);
      EXPECT_EQ(find_metric(expected)->region, metric->region);
      EXPECT_EQ(find_metric_output(expected), found);
    }
  for (const char* id :
       {"share_over.abs", "share_over.abs=", "share_over.abs=x", "share_over.abs=-1",
        "share_over.abs=nan", "share_over.abs=1.masks", "share_over.nothing=1", "relmse.eps=0.02",
        "rmse=1", "=", "=0", "share_over.abs=1=2"})
    EXPECT_EQ(find_metric(id), nullptr) << id;
}

std::vector<std::string> ids(const Comparison& comparison) {
  std::vector<std::string> ids;
  for (const auto& [id, value] : comparison.metrics) ids.push_back(id);
  return ids;
}

TEST(MetricList, MeasuresListedMetricsPlusThoseOfTheLimits) {
  const Image a = fixtures::highlight(48, 40, 20, 3.0), b = fixtures::highlight(48, 40, 22, 3.1);
  ComparisonOptions options;
  options.viewing.automatic = options.highlight = true;
  const Comparison all = compare(a, b, options);
  for (const char* name :
       {"rmse", "flip", "colour", "highlight", "ciede2000.highlight", "relmse"}) {
    ComparisonOptions few = options;
    few.metrics = {name};
    few.default_limits = false;
    few.limits = {{"psnr", 20}};
    const Comparison comparison = compare(a, b, few);
    EXPECT_LT(comparison.metrics.size(), all.metrics.size() / 2 + 8) << name;
    EXPECT_GT(comparison.metrics.size(), 1u) << name;
    EXPECT_FALSE(std::isnan(comparison.value("psnr"))) << "its limit needs it";
    for (const auto& [id, value] : comparison.metrics)
      EXPECT_EQ(value, all.value(id)) << id << " by " << name;
    few.default_limits = true;
    few.limits.clear();
    const Comparison judged = compare(a, b, few);
    EXPECT_EQ(judged.verdict, all.verdict);
    ASSERT_EQ(judged.limits.size(), all.limits.size());
    for (std::size_t i = 0; i < judged.limits.size(); ++i)
      EXPECT_EQ(judged.limits[i].value, all.limits[i].value) << judged.limits[i].metric;
  }
  options.metrics = {"default"};
  EXPECT_EQ(ids(compare(a, b, options)), ids(all));
  options.metrics = {"all"};
  const Comparison everything = compare(a, b, options);
  EXPECT_GT(everything.metrics.size(), all.metrics.size());
  EXPECT_FALSE(std::isnan(everything.value("code.max.highlight")));
}

TEST(MetricList, LacksTheThresholdsOfOtherComparisons) {
  const Image a = fixtures::highlight(48, 40, 20, 3.0), b = fixtures::highlight(48, 40, 22, 3.1);
  ComparisonOptions options;
  options.metrics = {"share_over.code=00.1875"};
  EXPECT_FALSE(std::isnan(compare(a, b, options).value("share_over.code=0.1875")));
  for (const char* name : {"all", "share_over.code", "share_over.code=0", "default"}) {
    options.metrics = {name};
    EXPECT_TRUE(std::isnan(compare(a, b, options).value("share_over.code=0.1875"))) << name;
  }
}

}  // namespace
}  // namespace lobelia
