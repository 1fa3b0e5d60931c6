// The highlight is judged by itself: what the black around it hides, and what it must not be blamed for.
#include "base/pictures/image_values.hpp"
#include "compare/highlight_region.hpp"
#include "compare/maps/difference_map.hpp"
#include "compare/metrics/catalogue.hpp"
#include "compare/sensitivity.hpp"
#include "compare/set/report.hpp"
#include "renderer/render.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/compare/profiled_scene.hpp"
#include "tests/more_samples.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// As `lobelia compare` has it.
ComparisonOptions as_by_default() {
  ComparisonOptions options;
  options.highlight = true;
  options.viewing.automatic = true;
  return options;
}

Image picture_of(double exponent, int width = 256, const char* model = "blinn_phong_ndf") {
  Scene scene = scene_with(model, exponent);
  scene.film = {width, width * 3 / 4};
  return render(scene, {}).image;
}

Image scaled(const Image& image, float factor) {
  Image result = image;
  for (float& value : result.values()) value *= factor;
  return result;
}

Image moved(const Image& image, int columns) {
  Image result(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y)
    for (int x = columns; x < image.width(); ++x)
      std::ranges::copy(image.pixel(x - columns, y), result.pixel(x, y).begin());
  return result;
}

TEST(Highlight, DefaultLimitsFindEveryPlantedChange) {
  std::size_t number = 0;
  for (const char* model : {"modified_phong", "blinn_phong_ndf"})
    for (const double exponent : {16.0, 50.0, 100.0, 500.0, 1000.0, 2e4, 1e5})
      for (const int width : {96, 256}) {
        if (is_left_out(number++)) continue;
        const Image reference = picture_of(exponent, width, model);
        for (const Change& change : sensitivity(reference, as_by_default()))
          EXPECT_TRUE(change.is_as_expected())
              << model << ", n = " << exponent << ", " << width << " pixels: " << change.name
              << " has the verdict " << verdict_name(change.verdict) << " by " << change.found_by;
      }
}

/// A limit on the metric that a user would sensibly set: far above rounding, or a usual figure.
double loose_limit(const MetricOutput& output, double peak) {
  switch (output.better) {
    case Better::kHigher:
      return output.id.starts_with("psnr") ? 20 : 0.9;
    case Better::kNearZero:
      return output.unit == Unit::kShare ? 0.5 : 0.1 * peak;
    default:
      return output.unit == Unit::kRadiance                                     ? 0.5 * peak
             : output.unit == Unit::kShare                                      ? 0.9
             : output.unit == Unit::kCount                                      ? 1000
             : output.id.starts_with("shift")                                   ? 5
             : output.id.starts_with("ciede") || output.id.starts_with("delta") ? 10
                                                                                : 0.5;
  }
}

TEST(Highlight, DiffersUnderAnySingleLimitIfBlackShiftedOrDimmer) {
  for (const double exponent : some_of(std::vector{100.0, 1000.0, 2e4})) {
    const Image reference = picture_of(exponent);
    const Image black(reference.width(), reference.height());
    const std::vector<std::pair<const char*, Image>> changed{
        {"black", black}, {"shifted", moved(reference, 1)}, {"dimmer", scaled(reference, 0.9f)}};
    for (const std::string_view id : limit_names(true)) {
      ComparisonOptions options = as_by_default();
      options.limits = {
          {std::string(id), loose_limit(*find_metric_output(id), peak_value(reference))}};
      options.metrics = {std::string(id)};
      const Metric& metric = *find_metric(id);
      if (metric.needs == Needs::kNoise || id == "outliers.off_edge" ||
          metric.region == Region::kMask || metric.region == Region::kOutside)
        continue;
      if (metric.needs == Needs::kTolerance) {
        options.tolerance = Tolerance{0.5, 0.5, 100000};
        if (id.find("off_edge") != std::string_view::npos) continue;
      }
      if (metric.needs == Needs::kHdrExposures)
        options.viewing.hdr_exposures = HdrExposures{-4, 4, 3};
      for (const auto& [name, picture] : changed)
        EXPECT_EQ(compare(picture, reference, options).verdict, Verdict::kDiffers)
            << name << ", n = " << exponent << ", with a limit on " << id << " alone";
    }
  }
}

TEST(Highlight, DiffersFromBlackOrWarnsOfBlindLimits) {
  const Image reference = picture_of(2e4);
  const Image black(reference.width(), reference.height());
  ComparisonOptions options = as_by_default();
  options.limits = {{"ciede2000.p99", 2}};
  const Comparison comparison = compare(black, reference, options);
  EXPECT_EQ(comparison.verdict, Verdict::kDiffers);
  ASSERT_EQ(comparison.blind_limits.size(), 1u);
  EXPECT_THAT(comparison.blind_limits[0], HasSubstr("ciede2000.p99 leaves out 1 % of the pixels"));
  options.default_limits = false;
  EXPECT_EQ(compare(black, reference, options).verdict, Verdict::kPass)
      << "without the default limits it is what was asked for";
  options.limits = {{"max_rel_peak", 0.1}, {"max_rel_peak", 0.2}};
  EXPECT_THAT(compare(black, reference, options).blind_limits.at(0),
              HasSubstr("max_rel_peak has two limits"));
}

// A second computation of what is measured in a region, by plain loops over the whole picture's maps.

std::vector<float> values_in(std::span<const float> map, std::span<const std::uint8_t> region) {
  std::vector<float> values;
  for (std::size_t i = 0; i < map.size(); ++i)
    if (region[i] != 0) values.push_back(map[i]);
  return values;
}

double mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += double(value);
  return sum / double(values.size());
}

/// Within `radius` rows and columns of a pixel of the region.
PixelFlags plainly_grown(std::span<const std::uint8_t> region, int width, int radius) {
  const int height = int(region.size()) / width;
  PixelFlags result(region.size(), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int v = std::max(0, y - radius); v <= std::min(height - 1, y + radius); ++v)
        for (int u = std::max(0, x - radius); u <= std::min(width - 1, x + radius); ++u)
          if (region[std::size_t(v * width + u)] != 0) result[std::size_t(y * width + x)] = 1;
  return result;
}

TEST(Region, GrowsAsThePlainLoopsSayForRandomRegions) {
  std::mt19937 random(20);
  for (int round = 0; round < 50; ++round) {
    const int width = 1 + int(random() % 40), height = 1 + int(random() % 40);
    PixelFlags region(std::size_t(width * height));
    for (std::uint8_t& pixel : region) pixel = random() % 50 == 0;
    const int radius = int(random() % 12);
    EXPECT_EQ(grown(region, width, radius), plainly_grown(region, width, radius));
  }
}

TEST(RegionOfAHighlight, HasTheFiguresOfItsPixelsAndFlipOfThoseAroundThem) {
  const Image b = picture_of(60);
  const Image a = moved(scaled(b, 0.9f), 1);
  ComparisonOptions options;
  options.highlight = true;
  const Comparison comparison = compare(a, b, options);
  const PixelFlags region = highlight_region(a, b, {});
  EXPECT_EQ(comparison.highlight_pixels, std::ranges::count(region, 1));
  const auto map = [&](const char* id) {
    return measure_difference_map(*find_difference_map(id), a, b, options.viewing);
  };
  std::vector<float> colours = values_in(map("ciede2000"), region);
  EXPECT_NEAR(comparison.value("ciede2000.mean.highlight"), mean(colours), 1e-9);
  std::ranges::sort(colours);
  const auto rank = std::size_t(std::ceil(0.95 * double(colours.size()))) - 1;
  EXPECT_EQ(comparison.value("ciede2000.p95.highlight"), double(colours[rank]));
  const Metric& flip = *find_metric("flip.ldr.mean.highlight");
  const auto around = plainly_grown(region, a.width(), flip.footprint(fixtures::input(a, b)));
  EXPECT_NEAR(comparison.value("flip.ldr.mean.highlight"), mean(values_in(map("flip.ldr"), around)),
              1e-9);
}

TEST(Region, HasTheFiguresOfTheWholePictureIfItIsAllOfIt) {
  const Image a = fixtures::highlight(64, 48, 4, 1.0), b = fixtures::highlight(64, 48, 5, 0.9);
  ComparisonOptions options;
  options.mask.assign(a.pixel_count(), 1);
  const Comparison all = compare(a, b, options);
  for (const Metric* metric : metrics())
    for (const MetricOutput& output : metric->outputs) {
      const double value = all.value(output.id);
      if (metric->region != Region::kWhole || !metric->in_regions || std::isnan(value)) continue;
      if (output.better == Better::kNeither) continue;
      EXPECT_DOUBLE_EQ(all.value(std::string(output.id) + ".mask"), value) << output.id;
    }
  EXPECT_EQ(all.why_not_measured("mae.outside"), "no pixel lies outside the mask");
  std::fill_n(options.mask.begin(), 64 * 24, std::uint8_t{0});
  const Comparison half = compare(a, b, options);
  EXPECT_NEAR((half.value("mae.mask") + half.value("mae.outside")) / 2, half.value("mae"), 1e-12);
}

TEST(HighlightFigures, AreThoseOfTheChangeThatWasMade) {
  const Image reference = picture_of(100);
  const auto of = [&](const Image& a) { return compare(a, reference, as_by_default()); };
  Comparison dimmer = of(scaled(reference, 0.93f));
  EXPECT_NEAR(dimmer.value("energy.highlight"), -0.07, 1e-6);
  EXPECT_NEAR(dimmer.value("brightness.highlight"), -0.07, 1e-6);
  EXPECT_NEAR(dimmer.value("width.highlight"), 0, 1e-6);
  EXPECT_THAT(highlight_sentence(dimmer),
              HasSubstr("a's highlight is 7 % dimmer, its energy 7 % less"));
  EXPECT_THAT(highlight_sentence(of(scaled(reference, 38))),
              HasSubstr("a's highlight is 38 times as bright, its energy 38 times as much"));
  const Comparison shifted = of(moved(reference, 3));
  EXPECT_NEAR(shifted.value("shift.highlight.x"), 3, 1e-3);
  EXPECT_NEAR(shifted.value("shift.highlight"), 3, 1e-3);
  EXPECT_THAT(highlight_sentence(shifted), HasSubstr("pixels to the right"));
  // The area of cos^n is in proportion to 1 / n: a width of 1 / sqrt(1.21).
  const Comparison narrower = of(picture_of(121));
  EXPECT_NEAR(narrower.value("width.highlight"), 1 / 1.1 - 1, 0.01);
  EXPECT_EQ(highlight_sentence(of(Image(reference.width(), reference.height()))),
            "a has no highlight where b has one");
  EXPECT_EQ(highlight_sentence(of(reference)),
            "a's highlight is as wide and as bright as b's, its energy equal");
}

TEST(HighlightFigures, SayHowMuchOfABrightPictureIsHighlight) {
  const Image grey = fixtures::flat(40, 40, 0.5f, 0.5f, 0.5f),
              brighter = fixtures::flat(40, 40, 0.55f, 0.55f, 0.55f);
  EXPECT_THAT(highlight_sentence(compare(brighter, grey, as_by_default())),
              HasSubstr("; 100 % of the picture count as highlight"));
}

TEST(HighlightFigures, AreNotHiddenByAFirefly) {
  const Image reference = picture_of(100);
  Image firefly = scaled(reference, 0.9f);
  firefly.pixel(3, 3)[0] = 1e6f;
  const Comparison comparison = compare(firefly, reference, as_by_default());
  EXPECT_GT(comparison.value("ciede2000.p95.highlight"), 1) << "the exposure is of the highlight";
  EXPECT_EQ(comparison.verdict, Verdict::kDiffers);
}

TEST(AutomaticExposure, IsZeroWithinTheRangeOfADisplay) {
  for (const double peak : {1.0, 0.3, 0.01}) {
    const Image shown = fixtures::highlight(32, 32, 4, peak);
    const Viewing viewing = compare(shown, shown, as_by_default()).viewing;
    EXPECT_EQ(viewing.exposure_stops, 0);
    EXPECT_FALSE(viewing.tail_stops);
  }
  for (const double peak : {157.0, 1e-6}) {
    const Image bright = fixtures::highlight(64, 64, 4, peak);
    const Viewing viewing = compare(bright, bright, as_by_default()).viewing;
    EXPECT_NEAR(viewing.exposure_stops, -std::log2(peak_value(bright)), 1e-9);
    EXPECT_EQ(viewing.tail_stops, viewing.exposure_stops + kTailStops);
  }
}

TEST(AutomaticExposure, SeesTheClippedPeakAndTheTailInTheDark) {
  const Image reference = fixtures::highlight(64, 64, 4, 157);
  ComparisonOptions fixed;
  fixed.highlight = true;
  const auto colour = [&](const Image& a, const ComparisonOptions& options) {
    return compare(a, reference, options).value("ciede2000.max.highlight");
  };
  Image dimmer_peak = reference;
  for (float& value : dimmer_peak.values()) value = std::min(value, 100.0f);
  EXPECT_EQ(colour(dimmer_peak, fixed), 0) << "both are white at exposure 0";
  EXPECT_GT(colour(dimmer_peak, as_by_default()), 5);
  Image no_tail = reference;
  for (float& value : no_tail.values()) value = value < 1 ? 0 : value;
  const Comparison tail = compare(no_tail, reference, as_by_default());
  EXPECT_GT(tail.value("ciede2000.max"), 20);
}

}  // namespace
}  // namespace lobelia
