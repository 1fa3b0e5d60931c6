// Pictures of differences against the metrics that they spread out, and their colours against the published
// tables.
#include "base/pictures/image_io.hpp"
#include "base/pictures/image_values.hpp"
#include "base/system/error.hpp"
#include "compare/compare.hpp"
#include "compare/maps/difference_map.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using ::testing::Each;

double mean(std::span<const float> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

std::array<int, 3> pixel(const DisplayImage& picture, std::size_t i) {
  return {picture.rgb[3 * i], picture.rgb[3 * i + 1], picture.rgb[3 * i + 2]};
}

class EveryDifferenceMap : public ::testing::TestWithParam<const DifferenceMap*> {};

std::vector<const DifferenceMap*> all_maps() {
  std::vector<const DifferenceMap*> all;
  for (const DifferenceMap& map : difference_maps()) all.push_back(&map);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Maps, EveryDifferenceMap, ::testing::ValuesIn(all_maps()),
                         [](const auto& map) {
                           std::string name(map.param->id);
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

/// With exposures, of which the first is 0.
const Viewing kViewing = [] {
  Viewing viewing;
  viewing.hdr_exposures = HdrExposures{0, 2, 3};
  return viewing;
}();

TEST_P(EveryDifferenceMap, IsZeroEverywhereForEqualPictures) {
  const Image image = fixtures::highlight(70, 67, 20, 3);
  EXPECT_THAT(measure_difference_map(*GetParam(), image, image, kViewing), Each(0.0f));
}

TEST_P(EveryDifferenceMap, SaysSomethingWhereTheTwoDiffer) {
  const Image a = fixtures::highlight(70, 67, 20, 0.9), b = fixtures::highlight(70, 67, 24, 0.9);
  const auto map = measure_difference_map(*GetParam(), a, b, kViewing);
  ASSERT_EQ(map.size(), a.pixel_count());
  EXPECT_GT(largest_magnitude(map), 0.01);
}

TEST_P(EveryDifferenceMap, ExchangesItsSignOrNothingWhenThePicturesAre) {
  if (GetParam()->id == "relative") return;  // a share of the second picture
  const Image a = fixtures::noise(40, 30, 1, 0.7f), b = fixtures::noise(40, 30, 2, 0.7f);
  const auto one = measure_difference_map(*GetParam(), a, b, kViewing);
  const auto other = measure_difference_map(*GetParam(), b, a, kViewing);
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_FLOAT_EQ(one[i], GetParam()->is_signed ? -other[i] : other[i]);
}

TEST_P(EveryDifferenceMap, IsNanWhereAPictureIsNotFiniteAndNowhereElse) {
  Image a = fixtures::noise(40, 30, 1, 0.7f), b = fixtures::noise(40, 30, 2, 0.7f);
  a.pixel(3, 0)[1] = std::numeric_limits<float>::quiet_NaN();
  b.pixel(5, 0)[2] = -std::numeric_limits<float>::infinity();
  const auto map = measure_difference_map(*GetParam(), a, b, kViewing);
  for (std::size_t i = 0; i < map.size(); ++i) EXPECT_EQ(std::isnan(map[i]), i == 3 || i == 5) << i;
}

TEST(DifferenceMaps, AddUpToTheMetricsOfTheirNameAtTheSameExposure) {
  const Image a = fixtures::noise(90, 70, 1, 0.12f), b = fixtures::noise(90, 70, 2, 0.11f);
  ComparisonOptions options;
  options.viewing.exposure_stops = 3;
  const Comparison measured = compare(a, b, options);
  const auto map = [&](std::string_view id) {
    return measure_difference_map(*find_difference_map(id), a, b, options.viewing);
  };
  EXPECT_FLOAT_EQ(float(largest_magnitude(map("abs"))), float(measured.value("max_abs")));
  EXPECT_NEAR(mean(map("signed")), measured.value("drift"), 1e-7);
  EXPECT_NEAR(mean(map("ciede2000")), measured.value("ciede2000.mean"), 1e-5);
  EXPECT_FLOAT_EQ(float(largest_magnitude(map("ciede2000"))),
                  float(measured.value("ciede2000.max")));
  EXPECT_NEAR(mean(map("delta_e_itp")), measured.value("delta_e_itp.mean"), 1e-5);
  EXPECT_FLOAT_EQ(float(largest_magnitude(map("delta_e_itp"))),
                  float(measured.value("delta_e_itp.max")));
  EXPECT_NEAR(mean(map("flip.ldr")), measured.value("flip.ldr.mean"), 1e-7);
  EXPECT_FLOAT_EQ(float(largest_magnitude(map("flip.ldr"))), float(measured.value("flip.ldr.max")));
  // Percentiles are the nearest rank of the sorted pixels.
  for (const auto& [id, percent] :
       {std::pair("ciede2000", 50), {"ciede2000", 95}, {"ciede2000", 99}, {"delta_e_itp", 95}}) {
    auto sorted = map(id);
    std::ranges::sort(sorted);
    const std::size_t rank = (sorted.size() * std::size_t(percent) + 99) / 100 - 1;
    const std::string percentile = std::string(id) + ".p" + std::to_string(percent);
    EXPECT_EQ(measured.value(percentile), double(sorted[rank])) << percentile;
  }
}

TEST(DifferenceMaps, DivideRelativeErrorsByTheReference) {
  Image a = fixtures::flat(3, 1, 1.5f, 1, 1), b = fixtures::flat(3, 1, 1, 1, 1);
  b.pixel(1, 0)[0] = 0;
  b.pixel(2, 0)[0] = -3;
  const auto map = measure_difference_map(*find_difference_map("relative"), a, b, {});
  EXPECT_THAT(map, ElementsAre(0.5f, std::numeric_limits<float>::max(), 1.5f));
}

TEST(DifferenceMaps, AreRefusedForDifferentSizes) {
  EXPECT_THROW(measure_difference_map(*find_difference_map("abs"), Image(2, 3), Image(3, 2), {}),
               Error);
}

TEST(ColourMaps, HaveTheColoursThatMatplotlibPublished) {
  // _cm_listed.py: magma, inferno, plasma and viridis at 0, 0.5 and 1. OpenImageIO keeps 17 of their 256
  // entries, of which these are some.
  const std::vector<float> values{0, 0.5f, 1};
  using Colour = std::array<int, 3>;
  const std::tuple<const char*, Colour, Colour, Colour> published[] = {
      {"magma", {0, 0, 4}, {183, 55, 121}, {252, 253, 191}},
      {"inferno", {0, 0, 4}, {188, 55, 84}, {252, 255, 164}},
      {"plasma", {13, 8, 135}, {204, 71, 120}, {240, 249, 33}},
      {"viridis", {68, 1, 84}, {33, 145, 140}, {253, 231, 37}}};
  for (const auto& [name, low, middle, high] : published) {
    const DisplayImage picture = colour_picture(values, 3, 1, 1, name);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(pixel(picture, 0)[c], low[c], 1) << name;
      EXPECT_NEAR(pixel(picture, 1)[c], middle[c], 2) << name;
      EXPECT_NEAR(pixel(picture, 2)[c], high[c], 1) << name;
    }
  }
}

TEST(ColourMaps, AreBlueWhiteAndRedForSignedValues) {
  const DisplayImage picture =
      colour_picture(std::vector<float>{-2, 0, 2, 5}, 4, 1, 2, kSignedColourMap);
  EXPECT_THAT(pixel(picture, 0), ElementsAre(0, 0, 255));
  EXPECT_THAT(pixel(picture, 1), ElementsAre(255, 255, 255));
  EXPECT_THAT(pixel(picture, 2), ElementsAre(255, 0, 0));
  EXPECT_THAT(pixel(picture, 3), ElementsAre(255, 0, 0)) << "what is beyond the scale is clipped";
}

TEST(ColourMaps, ShowNansInTheirOwnColour) {
  const std::vector<float> values{std::numeric_limits<float>::quiet_NaN()};
  for (const std::string_view name : colour_map_names())
    EXPECT_THAT(pixel(colour_picture(values, 1, 1, 1, name), 0), ElementsAre(0, 255, 0)) << name;
}

}  // namespace
}  // namespace lobelia
