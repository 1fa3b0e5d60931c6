// The JSON Schemas of comparisons and docs/metrics.md against the program.
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "compare/compare.hpp"
#include "compare/layers.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/set/report.hpp"
#include "tests/compare/json_schema.hpp"
#include "tests/compare/pictures.hpp"

namespace lobelia {
namespace {

Plain schema() { return Plain::parse(document_text("comparison.schema.json")); }

std::string problems(const Plain& record) {
  return schema_problems("comparison.schema.json", record);
}

Plain record(const Image& a, const Image& b, const ComparisonOptions& options) {
  return as_written(comparison_record(compare(a, b, options), "a.exr", "b.exr"));
}

ComparisonOptions everything(const Image& image) {
  ComparisonOptions options;
  options.viewing.hdr_exposures = HdrExposures{-2, 1.5, 3};
  options.tolerance = Tolerance{1e-3, 1e-6, 3, std::vector<std::uint8_t>(image.pixel_count(), 1)};
  options.mask.assign(image.pixel_count(), 1);
  options.limits = {{"rmse", 1e-9}, {"ssim", -1}};
  options.warnings = {{"mae", 0}};
  options.viewing.display = DisplayView::open({kOwnConfig, "sRGB", "", ""});
  return options;
}

TEST(ComparisonSchema, HoldsForRecordsOfEveryVerdict) {
  const Image a = fixtures::highlight(180, 180, 10, 1), b = fixtures::highlight(180, 180, 11, 1.1);
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
  options.noise = NoiseOptions{.a = fixtures::even_noise(image.width(), image.height(), error),
                               .bootstraps = 4};
  return options;
}

TEST(ComparisonSchema, HoldsForRecordsOfEveryVerdictOnNoise) {
  const Image a = fixtures::highlight(180, 180, 10, 1), b = fixtures::highlight(180, 180, 11, 1.1);
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
  const Image image = fixtures::highlight(32, 32, 10, 1);
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
  const Image grey = fixtures::flat(16, 16, 1, 1, 1), black = fixtures::flat(16, 16, 0, 0, 0);
  const Plain made = record(grey, black, {});
  EXPECT_EQ(made["metrics"]["max_rel_peak"], "inf");
  EXPECT_EQ(made["metrics"]["psnr"], "-inf");
  EXPECT_EQ(problems(made), "");
}

/// With what two files add to it: layers that pass, differ, are broken and have two sizes.
Plain record_of_files() {
  const Image good = fixtures::flat(16, 16, 1, 1, 1), other = fixtures::flat(16, 16, 2, 2, 2);
  Image broken = good;
  broken.pixel(3, 3)[0] = std::numeric_limits<float>::quiet_NaN();
  PictureSource source;
  source.format = "openexr";
  source.channels = {"R", "G", "B"};
  source.value_type = "half";
  source.transfer = "linear";
  source.data = {-1, 2, 3, 4};
  source.display = {0, 0, 16, 16};
  OtherLayers others;
  std::vector<LayerComparison>& layers = others.compared;
  for (const Image* image : std::initializer_list<const Image*>{&good, &other, &broken}) {
    source.layer = "layer" + std::to_string(layers.size());
    layers.push_back({source.layer, source, source, compare(*image, good, {}), ""});
  }
  layers.push_back({"two sizes", source, source, {}, "the sizes differ"});
  layers.push_back({"", source, source, {}, "", true, PixelWindow{-1, 0, 17, 16}});
  others.not_compared = {{"Z"}, true, 5, 2};
  others.common = {{}, {"Z"}, {}};
  source.icc_profile = "sRGB";
  source.chromaticities = {0.7347, 0.2653, 0, 1, 0.0001, -0.077, 0.32168, 0.33767};
  const Comparison picture = compare(good, good, {});
  Json made = comparison_record(picture, "a.exr", "b.exr");
  add_pictures(made, source, source);
  add_layers(made, worst_verdict(picture.verdict, others), others);
  return Plain::parse(record_text(made));
}

TEST(ComparisonSchema, HoldsForFilesAndTheirLayers) {
  const Plain good = record_of_files();
  EXPECT_EQ(problems(good), "");
  EXPECT_EQ(good["verdict"], "non-finite") << "the worst";
  EXPECT_EQ(good["metrics"]["max_abs"], 0) << "the picture's own";
  ASSERT_EQ(good["layers"].size(), 5u);
  EXPECT_EQ(good["layers"][3]["verdict"], "differs");
  EXPECT_EQ(good["layers"][4]["verdict"], "pass");
  const auto broken = [&](auto change) {
    Plain changed = good;
    change(changed);
    EXPECT_NE(problems(changed), "") << Plain::diff(good, changed);
  };
  for (const auto& [key, value] : good["pictures"]["a"].items())
    if (!key.starts_with("iccProfile") && key != "chromaticities")
      broken([&](Plain& r) { r["pictures"]["a"].erase(key); });
  for (const char* key : {"layer", "verdict", "pictures", "metrics"})
    broken([&](Plain& r) { r["layers"][0].erase(key); });
  broken([](Plain& r) { r["layers"][3].erase("problem"); });
  broken([](Plain& r) { r["layers"][1]["metrics"]["rmse"] = -1; });
  broken([](Plain& r) { r["layers"][4].erase("identical"); });
  broken([](Plain& r) { r["layers"][4]["overscan"].erase("width"); });
  for (const char* key : {"layers", "alpha", "overscanPixels", "mipLevels"})
    broken([&](Plain& r) { r["notCompared"].erase(key); });
  broken([](Plain& r) { r["pictures"]["a"]["chromaticities"].erase(0); });
  broken([](Plain& r) { r["layersInOne"].erase("a"); });
  broken([](Plain& r) { r["pictures"]["b"]["displayWindow"]["width"] = 0; });
  broken([](Plain& r) { r["pictures"]["b"]["channels"] = Plain::array(); });
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
  const Image image = fixtures::highlight(32, 32, 10, 1);
  const Plain good = record(image, image, everything(image));
  ASSERT_EQ(problems(good), "");
  const auto broken = [&](auto change) {
    Plain changed = good;
    change(changed);
    EXPECT_NE(problems(changed), "") << Plain::diff(good, changed);
  };
  for (const auto& [key, value] : good.items())
    if (key != "tolerance" && key != "mask" && key != "disagreement" && key != "warnings" &&
        key != "notMeasured")
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
  broken([](Plain& r) { r["viewing"]["display"].erase("view"); });
  broken([](Plain& r) { r["viewing"]["display"]["decodedBy"] = "guess"; });
  broken([](Plain& r) { r["disagreement"] = "none"; });
  broken([](Plain& r) { r["tolerance"].erase("ofPeak"); });
  broken([](Plain& r) { r["notMeasured"][0].erase("because"); });
  broken([](Plain& r) { r["notMeasured"][0]["metric"] = 3; });
}

TEST(ComparisonSchema, HoldsForValuesThatAreNotFiniteAndTheirPlaces) {
  Image a = fixtures::highlight(32, 32, 10, 1), b = a;
  a.pixel(3, 4)[1] = std::numeric_limits<float>::infinity();
  b.pixel(5, 6)[2] = std::numeric_limits<float>::quiet_NaN();
  Comparison comparison = compare(a, b, {});
  comparison.equal_nonfinite = 7;
  const Plain good = as_written(comparison_record(comparison, "a", "b"));
  EXPECT_EQ(problems(good), "");
  EXPECT_EQ(good["nonfinite"]["first"]["a"],
            Plain({{"x", 3}, {"y", 4}, {"channel", "G"}, {"value", "inf"}}));
  EXPECT_EQ(good["nonfinite"]["first"]["b"],
            Plain({{"x", 5}, {"y", 6}, {"channel", "B"}, {"value", "nan"}}));
  EXPECT_EQ(good["nonfinite"]["equalAllowed"], 7);
  const auto broken = [&](auto change) {
    Plain changed = good;
    change(changed);
    EXPECT_NE(problems(changed), "") << Plain::diff(good, changed);
  };
  broken([](Plain& r) { r["nonfinite"]["first"]["a"].erase("channel"); });
  broken([](Plain& r) { r["nonfinite"]["first"]["b"]["value"] = 1; });
  broken([](Plain& r) { r["nonfinite"]["equalAllowed"] = -1; });
}

TEST(ComparisonSchema, HoldsForARecordWithASecondReference) {
  const Image a = fixtures::highlight(32, 32, 10, 1), c = fixtures::highlight(32, 32, 11, 1);
  Image broken = c;
  broken.pixel(3, 3)[0] = std::numeric_limits<float>::quiet_NaN();
  for (const Image* second : {&a, &c, static_cast<const Image*>(&broken)}) {
    Comparison comparison = compare(a, c, {});
    comparison.reference_floor = measure_reference_floor(*second, c, {});
    Plain made = as_written(comparison_record(comparison, "a", "b", "c.exr"));
    EXPECT_EQ(problems(made), "");
    EXPECT_EQ(made["referenceFloor"]["c"], "c.exr");
    made["referenceFloor"].erase("metrics");
    EXPECT_NE(problems(made), "");
  }
}

TEST(ComparisonSetSchema, HoldsForASetAndNotForABrokenOne) {
  const Image a = fixtures::highlight(32, 32, 10, 1), b = fixtures::highlight(32, 32, 11, 1);
  SetReport set{"one", "other", "", {}, {"gone.exr"}, {"new.exr"}, 2, {"one/out"}};
  set.pairs.push_back({"x.exr", "one/x.exr", "other/x.exr", "", compare(a, b, {}), "", 0.1});
  set.pairs.push_back({"y.exr", "one/y.exr", "other/y.exr", "", {}, "not a picture", 0});
  const Plain good = as_written(set_record(set));
  const auto problems_of = [](const Plain& record) {
    return schema_problems("comparison_set.schema.json", record);
  };
  EXPECT_EQ(problems_of(good), "");
  for (const auto& [key, value] : good.items()) {
    Plain changed = good;
    changed.erase(key);
    EXPECT_NE(problems_of(changed), "") << key;
  }
  Plain changed = good;
  changed["pairs"][0]["comparison"].erase("metrics");
  EXPECT_NE(problems_of(changed), "") << "a pair is held to the schema of a comparison";
  changed = good;
  changed["pairs"][1].erase("error");
  EXPECT_NE(problems_of(changed), "");
}

TEST(MetricsDocument, IsWhatTheProgramPrints) {
  EXPECT_EQ(document_text("metrics.md"), metrics_document())
      << "run: lobelia compare --list-metrics > docs/metrics.md";
}

}  // namespace
}  // namespace lobelia
