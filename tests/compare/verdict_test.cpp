#include <type_traits>

#include "base/system/error.hpp"
#include "base/system/files.hpp"
#include "compare/compare.hpp"
#include "compare/maps/difference_map.hpp"
#include "compare/metrics/catalogue.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/json.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

constexpr float kFloatNaN = std::numeric_limits<float>::quiet_NaN();

TEST(Verdict, AgainstABlackReferenceIsDiffers) {
  EXPECT_EQ(compare(fixtures::flat(4, 4, 1e-6f, 0, 0), fixtures::flat(4, 4, 0, 0, 0), {}).verdict,
            Verdict::kDiffers);
}

TEST(Tolerance, CountsPixelsAndAllowsSoMany) {
  const Image b = fixtures::flat(10, 10, 1, 0.001f, 0);
  Image a = b;
  a.pixel(1, 1)[0] = 9;     // the peak is the reference's
  a.pixel(1, 1)[1] = 0.5f;  // the same pixel again
  a.pixel(2, 2)[2] = 0.5f;
  a.pixel(3, 3)[0] = 1.0005f;           // within the relative part
  a.pixel(4, 4)[1] = 0.001f + 0.5e-4f;  // within the share of the peak alone
  a.pixel(5, 5)[1] = 0.001f + 2e-4f;    // not
  ComparisonOptions options;
  options.default_limits = false;
  options.tolerance = Tolerance{1e-3, 1e-4, 3};
  Comparison comparison = compare(a, b, options);
  EXPECT_EQ(comparison.value("outliers"), 3);
  EXPECT_EQ(comparison.verdict, Verdict::kPass);
  options.tolerance->allowed_outliers = 2;
  comparison = compare(a, b, options);
  EXPECT_EQ(comparison.verdict, Verdict::kDiffers);
  ASSERT_EQ(comparison.limits.size(), 1u);
  EXPECT_EQ(comparison.limits[0].metric, "outliers");
}

TEST(Comparison, RefusesPicturesWithoutPixels) {
  EXPECT_EQ(thrown_by([] { compare(Image(), Image(), {}); }).code(), ExitCode::kInput);
}

TEST(Comparison, SuggestsTheMetricThatWasMeant) {
  ComparisonOptions limited, measured;
  limited.limits = {{"ciede2000.p96", 1}};
  measured.metrics = {"ciede2000.p96"};
  for (const ComparisonOptions& options : {limited, measured}) {
    const Error error = thrown_by([&] { check_options(options); });
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'ciede2000.p95'?"));
  }
}

TEST(Comparison, RefusesOptionsOutOfRange) {
  const auto refused = [](auto change) {
    ComparisonOptions options;
    change(options);
    EXPECT_EQ(thrown_by([&] { check_options(options); }).code(), ExitCode::kUsage);
  };
  const double nan = kFloatNaN;
  refused([&](ComparisonOptions& o) { o.viewing.exposure_stops = nan; });
  refused([](ComparisonOptions& o) { o.viewing.exposure_stops = 1e6; });
  refused([](ComparisonOptions& o) { o.viewing.pixels_per_degree = 0; });
  refused([](ComparisonOptions& o) { o.viewing.pixels_per_degree = 1e9; });
  refused([](ComparisonOptions& o) { o.limits = {{"rmse", -1}}; });
  refused([&](ComparisonOptions& o) { o.limits = {{"rmse", nan}}; });
  refused([](ComparisonOptions& o) { o.limits = {{"outliers", 1}}; });
  refused([](ComparisonOptions& o) { o.limits = {{"flip.hdr.mean", 1}}; });
  refused([](ComparisonOptions& o) { o.limits = {{"rmse.mask", 1}}; });
  refused([](ComparisonOptions& o) { o.viewing.hdr_exposures = HdrExposures{1, 0, 2}; });
  refused([](ComparisonOptions& o) { o.viewing.hdr_exposures = HdrExposures{0, 1, 1}; });
  refused([](ComparisonOptions& o) { o.viewing.hdr_exposures = HdrExposures{0, 1, 101}; });
  refused([&](ComparisonOptions& o) { o.viewing.hdr_exposures = HdrExposures{nan, 1, 3}; });
  refused([](ComparisonOptions& o) { o.tolerance = Tolerance{-1, 0, 0}; });
  refused([](ComparisonOptions& o) { o.tolerance = Tolerance{0, 0, -1}; });
  for (const char* fact : {"max_abs.x", "peak"})
    refused([&](ComparisonOptions& o) { o.limits = {{fact, 1}}; });
  ComparisonOptions of_noise;
  of_noise.limits = {{"z.max", 5}};
  refused([&](ComparisonOptions& o) { o = of_noise; });
  of_noise.noise = NoiseOptions{};
  for (const double significance : {0.0, 1.0, -1.0, nan})
    refused([&](ComparisonOptions& o) { o.noise = NoiseOptions{.significance = significance}; });
  refused([](ComparisonOptions& o) { o.noise = NoiseOptions{.bootstraps = 3}; });
  check_options(of_noise);
  check_options({});
}

TEST(DifferencePicture, ShowsTheErrorAsAShareOfWhite) {
  const Image b = fixtures::flat(2, 1, 0.5f, 0.5f, 0.5f);
  Image a = b;
  a.pixel(0, 0)[0] = 0.75f;
  a.pixel(0, 0)[1] = 0.25f;
  a.pixel(1, 0)[2] = 9.0f;
  const DisplayImage picture = difference_picture(a, b, 0.5);
  EXPECT_THAT(picture.rgb, ::testing::ElementsAre(128, 128, 0, 0, 0, 255));
  EXPECT_THAT(difference_picture(a, b, 0).rgb, ::testing::ElementsAre(255, 255, 0, 0, 0, 255));
}

TEST(DifferencePicture, IsMagentaWhereAValueIsNotFinite) {
  const Image b = fixtures::flat(2, 1, 0, 0, 0);
  Image a = b;
  a.pixel(1, 0)[1] = kFloatNaN;
  EXPECT_THAT(difference_picture(a, b, 1).rgb, ::testing::ElementsAre(0, 0, 0, 255, 0, 255));
}

TEST(Tolerance, AllowsOutliersOnEdgesAndNowhereElse) {
  const Image b = fixtures::flat(4, 1, 1, 1, 1);
  Image a = b;
  a.pixel(1, 0)[2] = 0.5f;
  ComparisonOptions options;
  options.default_limits = false;
  options.tolerance = Tolerance{1e-3, 0, 1, {0, 1, 0, 0}};
  EXPECT_EQ(compare(a, b, options).verdict, Verdict::kPass);
  options.tolerance->edges = {1, 0, 1, 1};
  const Comparison comparison = compare(a, b, options);
  EXPECT_EQ(comparison.verdict, Verdict::kDiffers);
  EXPECT_EQ(comparison.value("outliers"), 1);
  EXPECT_EQ(comparison.value("outliers.off_edge"), 1);
  options.tolerance->edges = {1, 1};
  EXPECT_THROW(compare(a, b, options), Error);
}

// Values of a scene, of a display's light and encoded ones are types that do not convert by themselves.
static_assert(!std::is_convertible_v<Image, DisplayLight>);
static_assert(!std::is_constructible_v<DisplayLight, Image>, "the exposure has to be said");
static_assert(!std::is_constructible_v<DisplayLight, DisplayImage, double>);
static_assert(!std::is_convertible_v<DisplayImage, Image>);

TEST(Displays, ChangeThePerceptualMetricsAndNoOther) {
  const TemporaryDirectory directory;
  const std::string config = (directory.path() / "dark.ocio").string();
  write_file(config, std::string_view(R"(ocio_profile_version: 2
roles: {default: linear, scene_linear: linear}
displays: {Dim: [!<View> {name: Quarter, colorspace: quarter}]}
colorspaces:
  - !<ColorSpace> {name: linear}
  - !<ColorSpace>
    name: quarter
    from_scene_reference: !<GroupTransform>
      children:
        - !<MatrixTransform> {matrix: [0.25, 0, 0, 0, 0, 0.25, 0, 0, 0, 0, 0.25, 0, 0, 0, 0, 1]}
        - !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, direction: inverse}
)"));
  const Image a = fixtures::highlight(32, 32, 10, 1), b = fixtures::highlight(32, 32, 11, 1);
  ComparisonOptions through, exposed;
  through.viewing.display = DisplayView::open({config, "", "", ""});
  exposed.viewing.exposure_stops = -2;
  const Comparison one = compare(a, b, through), other = compare(a, b, exposed),
                   plain = compare(a, b, {});
  ASSERT_EQ(one.metrics.size(), other.metrics.size());
  for (std::size_t i = 0; i < one.metrics.size(); ++i) {
    const auto& [id, value] = one.metrics[i];
    EXPECT_NEAR(value, other.metrics[i].second, 1e-4 + 1e-3 * std::abs(value)) << id;
    if (find_metric(id)->family == Family::kRadiance)
      EXPECT_EQ(value, plain.metrics[i].second) << id;
    else
      EXPECT_NE(value, plain.metrics[i].second) << id;
  }
  const auto map = [&](const Viewing& viewing) {
    return measure_difference_map(*find_difference_map("ciede2000"), a, b, viewing)[15 * 32 + 9];
  };
  EXPECT_NEAR(map(through.viewing), map(exposed.viewing), 1e-3);
}

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
