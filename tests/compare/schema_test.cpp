// docs/comparison.schema.json and docs/metrics.md against the program.
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "compare/compare.hpp"
#include "compare/metrics/catalogue.hpp"
#include "tests/compare/pictures.hpp"

namespace lobelia {
namespace {

// The validator knows the library's default type, not the one that keeps its order.
using Plain = nlohmann::json;

std::string text_of(const std::string& page) {
  std::ifstream file(std::string(LOBELIA_SOURCE_DIR) + "/docs/" + page);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

Plain schema() { return Plain::parse(text_of("comparison.schema.json")); }

/// What is wrong with a record; empty if nothing.
std::string problems(const Plain& record) {
  static const Plain document = schema();
  valijson::Schema parsed;
  valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(document),
                                          parsed);
  valijson::ValidationResults results;
  if (valijson::Validator().validate(parsed, valijson::adapters::NlohmannJsonAdapter(record),
                                     &results))
    return "";
  std::string text = "invalid:";
  valijson::ValidationResults::Error error;
  while (results.popError(error)) text += " " + error.description;
  return text;
}

/// As it stands in a file.
Plain record(const Image& a, const Image& b, const ComparisonOptions& options) {
  return Plain::parse(record_text(comparison_record(compare(a, b, options), "a.exr", "b.exr")));
}

ComparisonOptions everything(const Image& image) {
  ComparisonOptions options;
  options.viewing.hdr_exposures = HdrExposures{-2, 1.5, 3};
  options.tolerance = Tolerance{1e-3, 1e-6, 3, std::vector<std::uint8_t>(image.pixel_count(), 1)};
  options.mask.assign(image.pixel_count(), 1);
  options.limits = {{"rmse", 1e-9}, {"ssim", -1}};
  return options;
}

TEST(ComparisonSchema, HoldsForRecordsOfEveryVerdict) {
  const Image a = testing::highlight(180, 180, 10, 1), b = testing::highlight(180, 180, 11, 1.1);
  Image broken = a;
  broken.pixel(3, 3)[0] = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [left, right] : {std::pair{&a, &b}, {&a, &a}, {&broken, &a}, {&a, &broken}}) {
    EXPECT_EQ(problems(record(*left, *right, {})), "");
    EXPECT_EQ(problems(record(*left, *right, everything(a))), "");
  }
  const Plain both = record(a, b, everything(a));
  EXPECT_EQ(both["verdict"], "differs");
  EXPECT_FALSE(both["disagreement"].empty()) << "a record in which little is missing";
}

ComparisonOptions with_noise(ComparisonOptions options, const Image& image, float error) {
  options.noise =
      NoiseOptions{.a = testing::even_noise(image.width(), image.height(), error), .bootstraps = 4};
  return options;
}

TEST(ComparisonSchema, HoldsForRecordsOfEveryVerdictOnNoise) {
  const Image a = testing::highlight(180, 180, 10, 1), b = testing::highlight(180, 180, 11, 1.1);
  Image broken = a;
  broken.pixel(3, 3)[0] = std::numeric_limits<float>::quiet_NaN();
  std::set<std::string> verdicts;
  for (const auto& [picture, error] :
       {std::pair(&a, 1e-4f), {&b, 1e-4f}, {&a, 1.0f}, {&a, 0.0f}, {&broken, 1.0f}})
    for (const ComparisonOptions& options : {ComparisonOptions(), everything(a)}) {
      const Plain made = record(*picture, a, with_noise(options, a, error));
      EXPECT_EQ(problems(made), "");
      verdicts.insert(made["verdict"]);
    }
  EXPECT_EQ(verdicts, (std::set<std::string>{"different", "non-finite", "same", "undecided"}));
}

TEST(ComparisonSchema, DoesNotHoldForABrokenRecordOfNoise) {
  const Image image = testing::highlight(32, 32, 10, 1);
  const Plain good = record(image, image, with_noise({}, image, 0.1f));
  ASSERT_EQ(problems(good), "");
  const auto broken = [&](auto change) {
    Plain changed = good;
    change(changed);
    EXPECT_NE(problems(changed), "") << Plain::diff(good, changed);
  };
  broken([](Plain& r) { r["uncertainty"].erase("each"); });
  broken([](Plain& r) { r["uncertainty"]["a"].erase("shared"); });
  broken([](Plain& r) { r["uncertainty"]["significance"] = 1; });
  broken([](Plain& r) { r["errorBars"]["rmse"].erase("low"); });
  broken([](Plain& r) { r["errorBars"]["rmse"]["standardError"] = -1; });
  broken([](Plain& r) { r["limits"][0]["standing"] = "maybe"; });
}

TEST(ComparisonSchema, HoldsForNumbersThatAreNotFinite) {
  const Image grey = testing::flat(16, 16, 1, 1, 1), black = testing::flat(16, 16, 0, 0, 0);
  const Plain made = record(grey, black, {});
  EXPECT_EQ(made["metrics"]["max_rel_peak"], "inf");
  EXPECT_EQ(made["metrics"]["psnr"], "-inf");
  EXPECT_EQ(problems(made), "");
}

TEST(ComparisonSchema, KnowsEveryMetricAndNoOther) {
  const Plain known = schema()["properties"]["metrics"]["properties"];
  std::size_t ids = 0;
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs) {
      EXPECT_TRUE(known.contains(std::string(output.id))) << output.id;
      ++ids;
    }
  EXPECT_EQ(known.size(), ids);
}

TEST(ComparisonSchema, DoesNotHoldForABrokenRecord) {
  const Image image = testing::highlight(32, 32, 10, 1);
  const Plain good = record(image, image, everything(image));
  ASSERT_EQ(problems(good), "");
  const auto broken = [&](auto change) {
    Plain changed = good;
    change(changed);
    EXPECT_NE(problems(changed), "") << Plain::diff(good, changed);
  };
  for (const auto& [key, value] : good.items())
    if (key != "tolerance" && key != "mask" && key != "disagreement")
      broken([&](Plain& r) { r.erase(key); });
  broken([](Plain& r) { r["verdict"] = "fine"; });
  broken([](Plain& r) { r["kind"] = "render"; });
  broken([](Plain& r) { r["schemaVersion"] = 2; });
  broken([](Plain& r) { r["metrics"]["rmse"] = "small"; });
  broken([](Plain& r) { r["metrics"]["rmse"] = -1; });
  broken([](Plain& r) { r["metrics"]["ssim"] = 1.5; });
  broken([](Plain& r) { r["metrics"]["max_abs.x"] = 1.5; });
  broken([](Plain& r) { r["metrics"]["new"] = nullptr; });
  broken([](Plain& r) { r["limits"] = Plain::array(); });
  broken([](Plain& r) { r["limits"][0].erase("pass"); });
  broken([](Plain& r) { r["viewing"]["hdrExposures"]["count"] = 1; });
  broken([](Plain& r) { r["disagreement"] = "none"; });
  broken([](Plain& r) { r["tolerance"].erase("ofPeak"); });
}

TEST(MetricsDocument, IsWhatTheProgramPrints) {
  EXPECT_EQ(text_of("metrics.md"), metrics_document())
      << "run: lobelia compare --list-metrics > docs/metrics.md";
}

}  // namespace
}  // namespace lobelia
