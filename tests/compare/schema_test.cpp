// The JSON Schemas of comparisons and profiles against the records that the program writes.
#include "base/system/error.hpp"
#include "compare/compare.hpp"
#include "compare/layers.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/set/report.hpp"
#include "farm/profile_scene.hpp"
#include "lobelia_paths.hpp"
#include "profile/blob.hpp"
#include "renderer/render.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/compare/profiled_scene.hpp"
#include "tests/json_schema.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

records::Comparison record(const Image& a, const Image& b, const ComparisonOptions& options) {
  return comparison_record(compare(a, b, options), "a.exr", "b.exr");
}

/// With a change that neither the reader of its kind nor the schema takes.
template <class T>
void expect_refused(const Plain& good, const std::function<void(Plain&)>& change) {
  Plain changed = good;
  change(changed);
  const std::string what = Plain::diff(good, changed).dump();
  EXPECT_NE(schema_of<T>().problems(changed), "") << what;
  EXPECT_THROW(records::parse_record<T>(changed.dump(), "a test"), Error) << what;
}

ComparisonOptions everything(const Image& image) {
  ComparisonOptions options;
  options.viewing.hdr_exposures = HdrExposures{-2, 1.5, 3};
  options.tolerance = Tolerance{1e-3, 1e-6, 3, PixelFlags(image.pixel_count(), 1)};
  options.mask.assign(image.pixel_count(), 1);
  options.limits = {{"rmse", 1e-9}, {"ssim", -1}};
  options.warnings = {{"mae", 0}};
  options.viewing.display = DisplayView::open({kOwnConfig, "sRGB", "", ""});
  return options;
}

ComparisonOptions with_noise(ComparisonOptions options, const Image& image, float error) {
  options.noise = NoiseOptions{.a = fixtures::even_noise(image.width(), image.height(), error),
                               .bootstraps = 4};
  return options;
}

TEST(ComparisonSchema, HoldsForRecordsOfEveryVerdict) {
  const Image a = fixtures::highlight(180, 180, 10, 1), b = fixtures::highlight(180, 180, 11, 1.1);
  Image broken = a;
  broken.pixel(3, 3)[0] = std::numeric_limits<float>::quiet_NaN();
  std::set<std::string> verdicts;
  const auto expect_valid = [&](const records::Comparison& made) {
    EXPECT_EQ(schema_problems(made), "");
    verdicts.insert(made.verdict);
  };
  for (const ComparisonOptions& options : {ComparisonOptions(), everything(a)}) {
    for (const auto& [left, right] : {std::pair{&a, &b}, {&a, &a}, {&broken, &a}, {&a, &broken}})
      expect_valid(record(*left, *right, options));
    for (const auto& [picture, error] :
         {std::pair(&a, 1e-4f), {&b, 1e-4f}, {&a, 1.0f}, {&a, 0.0f}, {&broken, 1.0f}})
      expect_valid(record(*picture, a, with_noise(options, a, error)));
  }
  EXPECT_EQ(verdicts, (std::set<std::string>{"different", "differs", "non-finite", "pass", "same",
                                             "undecided"}));
  EXPECT_FALSE(record(a, b, everything(a)).disagreement.empty())
      << "a record in which little is missing";
}

/// With what two files add to it: layers that pass, differ, are broken and have two sizes.
records::Comparison record_of_files() {
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
  source.has_gain_map = true;
  source.chromaticities = {0.7347, 0.2653, 0, 1, 0.0001, -0.077, 0.32168, 0.33767};
  const Comparison picture = compare(good, good, {});
  records::Comparison made = comparison_record(picture, "a.exr", "b.exr");
  made.pictures = pictures_record(source, source);
  add_layers(made, worst_verdict(picture.verdict, others), others);
  return made;
}

TEST(ComparisonSchema, HoldsForFilesAndTheirLayers) {
  EXPECT_EQ(schema_problems(record_of_files()), "");
  const Plain good = as_written(record_of_files());
  EXPECT_EQ(good["verdict"], "non-finite") << "the worst";
  EXPECT_EQ(good["metrics"]["max_abs"], 0) << "the picture's own";
  ASSERT_EQ(good["layers"].size(), 5u);
  EXPECT_EQ(good["layers"][3]["verdict"], "differs");
  EXPECT_EQ(good["layers"][4]["verdict"], "pass");
}

/// A pair that is compared, and one that cannot be.
records::ComparisonSet record_of_set() {
  const Image a = fixtures::highlight(32, 32, 10, 1), b = fixtures::highlight(32, 32, 11, 1);
  SetReport set{"one", "other", "", {}, {"gone.exr"}, {"new.exr"}, 2, {"one/out"}};
  set.pairs.push_back({"x.exr", "one/x.exr", "other/x.exr", "", compare(a, b, {}), "", 0.1});
  set.pairs.push_back({"y.exr", "one/y.exr", "other/y.exr", "", {}, "not a picture", 0});
  return set_record(set);
}

TEST(ComparisonSetSchema, HoldsForASet) { EXPECT_EQ(schema_problems(record_of_set()), ""); }

Image broken(int width, int height) {
  Image image(width, height);
  for (float& value : image.values()) value = std::numeric_limits<float>::quiet_NaN();
  return image;
}

TEST(ProfileSchema, HoldsForProfilesOfEveryKindOfPicture) {
  const Scene scene = scene_with("phong_rdf", 64);
  Scene away = scene, dull = scene;
  away.spheres[0].center = {1000, 0, 0};
  dull.materials[0].specular_reflectance = {0, 0, 0};
  const Image good = render(scene, RenderOptions{}).image;
  const int width = scene.film.width, height = scene.film.height;
  Image clipped = good;
  for (float& value : clipped.values()) value = std::min(value, 1.0f);
  clipped.pixel(5, 5)[0] = 1e4f;
  for (const Scene& each : {scene, away, dull})
    for (const Image& picture : {good, clipped, Image(width, height), broken(width, height)})
      for (const bool thorough : {false, true})
        EXPECT_EQ(schema_problems(profile_scene(each, 0, 0, {{"a", &picture}}, thorough)), "");
  const records::Profile profile = profile_scene(scene, 0, 0, {{"a", &good}});
  EXPECT_TRUE(records::find(profile.images, "a")->highlight->cosine_lobe.exponent)
      << "a record in which little is missing";
  EXPECT_EQ(schema_problems(records::Profiles{{profile}}), "");
}

TEST(MetricsDocument, MatchesTheOutputOfTheProgram) {
  EXPECT_EQ(read_file(std::string(LOBELIA_SOURCE_DIR) + "/docs/metrics.md", 1 << 20),
            metrics_document())
      << "run: lobelia compare --list-metrics > docs/metrics.md";
}

// The laws over random records do not spoil these: nested keys, keys that need each other, and values.

TEST(BrokenRecords, AreRefusedWhereTheyAreComparisons) {
  const Image image = fixtures::highlight(32, 32, 10, 1);
  const Plain plain = as_written(record(image, image, everything(image))),
              noisy = as_written(record(image, image, with_noise({}, image, 0.1f))),
              files = as_written(record_of_files());
  const auto broken = [](const Plain& good, const auto& change) {
    expect_refused<records::Comparison>(good, change);
  };
  broken(plain, [](Plain& r) { r["verdict"] = "fine"; });
  broken(plain, [](Plain& r) { r["limits"] = Plain::array(); });
  broken(plain, [](Plain& r) { r["limits"][0].erase("pass"); });
  broken(plain, [](Plain& r) { r["viewing"]["hdrExposures"]["count"] = 1; });
  broken(noisy, [](Plain& r) { r["uncertainty"]["significance"] = 1; });
  broken(noisy, [](Plain& r) { r["errorBars"]["rmse"]["standardError"] = -1; });
  broken(noisy, [](Plain& r) { r["limits"][0]["standing"] = "maybe"; });
  broken(files, [](Plain& r) { r["layers"][0].erase("metrics"); });
  broken(files, [](Plain& r) { r["layers"][3].erase("problem"); });
  broken(files, [](Plain& r) { r["layers"][4].erase("identical"); });
  broken(files, [](Plain& r) { r["pictures"]["a"]["chromaticities"].erase(0); });
  broken(files, [](Plain& r) { r["pictures"]["b"]["channels"] = Plain::array(); });
  const Plain set = as_written(record_of_set());
  expect_refused<records::ComparisonSet>(set, [](Plain& r) { r["pairs"][1].erase("error"); });
  expect_refused<records::ComparisonSet>(
      set, [](Plain& r) { r["pairs"][0]["comparison"].erase("metrics"); });
}

TEST(BrokenRecords, AreRefusedWhereTheirPlacesAreFinite) {
  Image image = fixtures::highlight(32, 32, 10, 1);
  image.pixel(3, 4)[1] = std::numeric_limits<float>::infinity();
  Plain finite = as_written(record(image, image, {}));
  finite["nonfinite"]["first"]["b"]["value"] = 1;
  EXPECT_THROW(records::parse_record<records::Comparison>(finite.dump(), "a test"), Error);
}

TEST(BrokenRecords, AreRefusedForProfiles) {
  const Scene scene = scene_with("phong_rdf", 64);
  const Image picture = render(scene, RenderOptions{}).image;
  const Plain good = as_written(profile_scene(scene, 0, 0, {{"a", &picture}}));
  const auto broken = [&](const auto& change) { expect_refused<records::Profile>(good, change); };
  broken([](Plain& r) { r["images"]["a"]["highlight"].erase("peak"); });
  broken([](Plain& r) { r["images"]["a"]["highlight"]["peak"]["found"] = "guessed"; });
  broken([](Plain& r) { r["images"]["a"]["highlight"]["cosineLobe"]["exponent"] = "nan"; });
  broken([](Plain& r) { r["zones"]["flankDegrees"].push_back(3); });
}

}  // namespace
}  // namespace lobelia
