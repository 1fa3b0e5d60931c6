// Parts of pictures: the pixels of shapes, the figures of parts, and what is ignored or cut off.
#include <fmt/format.h>

#include "compare/compare.hpp"
#include "compare/layers.hpp"
#include "compare/maps/difference_map.hpp"
#include "compare/mask.hpp"
#include "compare/nonfinite.hpp"
#include "tests/compare/pictures.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

PixelFlags inside(const std::vector<std::string>& shapes, int width, int height) {
  std::vector<MaskShape> parsed;
  for (const std::string& text : shapes) parsed.push_back(parse_mask_shape("--mask", text));
  return pixels_inside(parsed, width, height);
}

/// Whether a ray to the right crosses an odd number of sides (W. R. Franklin's pnpoly).
bool is_in_polygon(const std::vector<std::array<double, 2>>& corners, double x, double y) {
  bool in = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const double xi = corners[i][0], yi = corners[i][1], xj = corners[j][0], yj = corners[j][1];
    if ((yi > y) != (yj > y) && x < (xj - xi) * (y - yi) / (yj - yi) + xi) in = !in;
  }
  return in;
}

TEST(MaskShapes, HaveThePixelsWithCentresInsideAPolygonByTheEvenOddRule) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-5, 45);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::array<double, 2>> corners;
    std::string text = "polygon:";
    for (int i = 0; i < 3 + round % 6; ++i) {
      // Corners in eighths, but never on the line of a pixel's centre, where rounding decides.
      const auto eighth = [&] { return std::floor(8 * place(random)) / 8 + 1.0 / 32; };
      corners.push_back({eighth(), eighth()});
      text += fmt::format(" {},{}", corners.back()[0], corners.back()[1]);
    }
    const PixelFlags pixels = inside({text}, 40, 30);
    for (int y = 0; y < 30; ++y)
      for (int x = 0; x < 40; ++x)
        EXPECT_EQ(pixels[std::size_t(40 * y + x)] != 0, is_in_polygon(corners, x + 0.5, y + 0.5))
            << text << " at " << x << ", " << y;
  }
}

TEST(MaskShapes, AddUpAndMayReachBeyondThePicture) {
  const auto pixels = inside({"rect:-2,-1,4,3", "rect:3,2,9,9"}, 5, 4);
  const PixelFlags expected{1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 1};
  EXPECT_EQ(pixels, expected);
  EXPECT_EQ(std::ranges::count(inside({"rect:7,7,2,2"}, 5, 4), 1), 0);
}

TEST(MaskShapes, AreRefusedInOneSentenceIfMalformed) {
  std::string corners;
  for (int i = 0; i <= kMaxPolygonCorners; ++i) corners += fmt::format(" {},{}", i, i * i % 7);
  for (const std::string& text :
       {std::string("rect:"), std::string("rect:1,2,3"), std::string("rect:1,2,3,4,5"),
        std::string("rect:0,0,0,1"), std::string("rect:0.5,0,1,1"), std::string("rect:nan,0,1,1"),
        std::string("rect:1e9,0,1,1"), std::string("rect:1,,2,3,4"), std::string("polygon:"),
        std::string("polygon:1,1 2,2"), std::string("polygon:1,1 2,2 3"),
        std::string("polygon:1,1 2,2 inf,3"), "polygon:" + corners})
    EXPECT_THAT(error_words(ExitCode::kUsage, [&] { parse_mask_shape("--mask", text); }),
                HasSubstr("--mask"))
        << text;
}

PixelFlags random_mask(std::size_t pixels, unsigned seed) {
  std::mt19937 random(seed);
  PixelFlags mask(pixels);
  for (std::uint8_t& pixel : mask) pixel = random() % 3 == 0 ? 255 : 0;
  return mask;
}

TEST(MaskedFigures, EqualThoseOfPlainLoops) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Image a = fixtures::noise(37, 29, seed, 1.0f),
                b = fixtures::noise(37, 29, seed + 9, 1.0f);
    ComparisonOptions options;
    options.mask = random_mask(a.pixel_count(), seed);
    const Comparison comparison = compare(a, b, options);
    std::map<std::string, PixelValues> maps;
    for (const char* id : {"ciede2000", "delta_e_itp", "flip.ldr"})
      maps[id] = measure_difference_map(*find_difference_map(id), a, b, options.viewing);
    for (const bool is_inside : {true, false}) {
      const std::string region = is_inside ? ".mask" : ".outside";
      double count = 0, absolute = 0, squares = 0, sum = 0, relative = 0, largest = 0;
      std::size_t where = 0;
      std::map<std::string, double> sums, most;
      for (std::size_t pixel = 0; pixel < a.pixel_count(); ++pixel) {
        if ((options.mask[pixel] != 0) != is_inside) continue;
        ++count;
        for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
          const double vb = b.values()[i], d = double(a.values()[i]) - vb;
          absolute += std::abs(d), squares += d * d, sum += d, relative += d * d / (vb * vb + 0.01);
          if (std::abs(d) > largest) largest = std::abs(d), where = pixel;
        }
        for (const auto& [id, map] : maps) {
          sums[id] += double(map[pixel]);
          most[id] = std::max(most[id], double(map[pixel]));
        }
      }
      const auto value = [&](const char* id) { return comparison.value(id + region); };
      EXPECT_NEAR(value("mae"), absolute / count / 3, 1e-12);
      EXPECT_NEAR(value("mse"), squares / count / 3, 1e-12);
      EXPECT_NEAR(value("rmse"), std::sqrt(squares / count / 3), 1e-12);
      EXPECT_NEAR(value("drift"), sum / count / 3, 1e-12);
      EXPECT_NEAR(value("relmse.eps=0.01"), relative / count / 3, 1e-9);
      EXPECT_EQ(value("max_abs"), largest);
      EXPECT_EQ(comparison.value("max_abs" + region + ".x"), double(where % 37));
      EXPECT_EQ(comparison.value("max_abs" + region + ".y"), double(where / 37));
      EXPECT_EQ(*comparison.mask_pixels, std::ranges::count(options.mask, 255));
      for (const auto& [id, total] : sums) {
        EXPECT_NEAR(value((id + ".mean").c_str()), total / count, 1e-7) << id << region;
        EXPECT_EQ(value((id + ".max").c_str()), most[id]) << id << region;
      }
    }
  }
}

TEST(IgnoredPixels, CountAsEqualInEveryMetricAlsoWhereTheyAreNotFinite) {
  PicturePair pair{{fixtures::noise(40, 30, 1, 1.0f), {}, {}},
                   {fixtures::noise(40, 30, 2, 1.0f), {}, {}}};
  ComparisonOptions options;
  options.ignored = random_mask(1200, 5);
  Image patched = pair.a.image;
  for (std::size_t i = 0; i < patched.values().size(); ++i)
    if (options.ignored[i / 3] != 0) patched.values()[i] = pair.b.image.values()[i];
  const Comparison expected = compare(patched, pair.b.image, {});
  PicturePair broken = pair;
  take_part(pair, "a", "b", options);
  const Comparison comparison = compare(pair.a.image, pair.b.image, options);
  EXPECT_EQ(comparison.metrics, expected.metrics);
  EXPECT_EQ(comparison.ignored->pixels, 1200 - std::ranges::count(options.ignored, 0));
  const auto ignored =
      std::size_t(std::ranges::find(options.ignored, 255) - options.ignored.begin());
  broken.b.image.values()[3 * ignored] = std::numeric_limits<float>::quiet_NaN();
  broken.a.image.values()[3 * ignored + 1] = std::numeric_limits<float>::infinity();
  take_part(broken, "a", "b", options);
  EXPECT_EQ(compare(broken.a.image, broken.b.image, options).nonfinite.b, 0);
  options.ignored.assign(1200, 1);
  take_part(broken, "a", "b", options);
  EXPECT_EQ(compare(broken.a.image, broken.b.image, options).value("max_abs"), 0);
}

TEST(Crop, ComparesThePartAndNothingElse) {
  PicturePair pair{{fixtures::noise(40, 30, 1, 1.0f), {}, {}},
                   {fixtures::noise(40, 30, 2, 1.0f), {}, {}}};
  ComparisonOptions options;
  options.crop = PixelWindow{7, 3, 20, 11};
  Image part(20, 11);
  for (int y = 0; y < 11; ++y)
    for (int x = 0; x < 20; ++x)
      std::ranges::copy(pair.a.image.pixel(x + 7, y + 3), part.pixel(x, y).begin());
  const PixelFlags mask = random_mask(1200, 6);
  const PixelFlags of_part = cut(mask, 40, *options.crop);
  EXPECT_EQ(of_part[20 * 2 + 5], mask[40 * 5 + 12]);
  EXPECT_EQ(of_part.size(), 220u);
  take_part(pair, "a", "b", options);
  EXPECT_TRUE(std::ranges::equal(pair.a.image.values(), part.values()));
  for (const PixelWindow& bad : {PixelWindow{0, 0, 21, 11}, {-1, 0, 2, 2}, {19, 10, 1, 2}})
    EXPECT_THROW(cut(part, bad), Error);
}

// Values that are not finite: where the first is, and which pictures share them.

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// One of a few values, so that two of them are often the same.
float any_value(std::mt19937& random) {
  constexpr float kValues[] = {kNaN, kInfinity, -kInfinity, 0, 1, -0.5f};
  return kValues[random() % 6];
}

bool same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

TEST(EqualNonfinite, IsClearedWhereBothHaveTheSameAndNowhereElse) {
  std::mt19937 random(8);
  for (int round = 0; round < 300; ++round) {
    const int width = 1 + int(random() % 9), height = 1 + int(random() % 9);
    Image a(width, height), b(width, height);
    for (float& value : a.values()) value = any_value(random);
    for (float& value : b.values()) value = any_value(random);
    Image cleared_a = a, cleared_b = b;
    const std::int64_t pixels = clear_equal_nonfinite(cleared_a, cleared_b);
    std::int64_t expected = 0;
    for (std::size_t pixel = 0; pixel < a.pixel_count(); ++pixel) {
      bool any = false;
      for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
        const float va = a.values()[i], vb = b.values()[i];
        const bool equal = !std::isfinite(va) && same(va, vb);
        EXPECT_TRUE(same(cleared_a.values()[i], equal ? 0 : va));
        EXPECT_TRUE(same(cleared_b.values()[i], equal ? 0 : vb));
        any = any || equal;
      }
      expected += any;
    }
    EXPECT_EQ(pixels, expected);
    EXPECT_EQ(clear_equal_nonfinite(cleared_a, cleared_b), 0) << "once is enough";
  }
}

TEST(EqualNonfinite, LetsAPicturePassAgainstItselfOnly) {
  std::mt19937 random(9);
  PictureSource source;
  source.channels = {"R", "G", "B"};
  ComparisonOptions allowed;
  allowed.allow_equal_nonfinite = true;
  int different = 0;
  for (int round = 0; round < 200; ++round) {
    Image a(16, 16);
    for (float& value : a.values()) value = float(random() % 1000) / 1000;
    a.values()[random() % a.values().size()] = any_value(random);
    PicturePair itself{{a, {}, source}, {a, {}, source}};
    EXPECT_EQ(compare_pictures(itself, "a", "b", allowed).verdict, Verdict::kPass);
    Image b = a;
    const std::size_t at = random() % b.values().size();
    const float bad = round % 3 == 0 ? kNaN : round % 3 == 1 ? kInfinity : -kInfinity;
    if (same(b.values()[at], bad)) continue;
    b.values()[at] = bad;
    ++different;
    for (const bool in_a : {true, false}) {
      PicturePair pair{{in_a ? b : a, {}, source}, {in_a ? a : b, {}, source}};
      const Comparison comparison = compare_pictures(pair, "a", "b", allowed);
      EXPECT_EQ(comparison.verdict, Verdict::kNonFinite);
      EXPECT_EQ(in_a ? comparison.nonfinite.a : comparison.nonfinite.b, 1);
      const auto& first = in_a ? comparison.nonfinite.first->a : comparison.nonfinite.first->b;
      ASSERT_TRUE(first.has_value());
      EXPECT_EQ(std::size_t(first->y * 16 + first->x), at / 3);
      EXPECT_EQ(first->channel, std::string(1, "RGB"[at % 3]));
      EXPECT_EQ(compare(in_a ? b : a, in_a ? a : b, {}).verdict, Verdict::kNonFinite);
    }
  }
  EXPECT_GT(different, 150);
}

TEST(EqualNonfinite, IsAllowedByDefaultOnlyInDepth) {
  Image a(16, 16);
  a.pixel(3, 4)[0] = a.pixel(3, 4)[1] = a.pixel(3, 4)[2] = kInfinity;
  const auto verdict = [&](const char* layer, std::vector<std::string> channels) {
    PictureSource source;
    source.layer = layer;
    source.channels = channels;
    PicturePair pair{{a, {}, source}, {a, {}, source}};
    return compare_pictures(pair, "a", "b", {}).verdict;
  };
  EXPECT_EQ(verdict("", {"R", "G", "B"}), Verdict::kNonFinite);
  EXPECT_EQ(verdict("diffuse", {"diffuse.R", "diffuse.G", "diffuse.B"}), Verdict::kNonFinite);
  EXPECT_EQ(verdict("Z", {"Z"}), Verdict::kPass);
  EXPECT_EQ(verdict("", {"Z"}), Verdict::kPass) << "the only channel of the file";
  EXPECT_EQ(verdict("ViewLayer.Depth.Z", {"ViewLayer.Depth.Z"}), Verdict::kPass);
}

TEST(DepthLikeLayers, AreToldByAPartOfTheirName) {
  for (const char* name : {"Z", "z", "ZBack", "depth", "Depth.V", "ViewLayer.Depth.Z",
                           "camera.depth", "distance", "position.X"})
    EXPECT_TRUE(is_depth_like(name)) << name;
  for (const char* name : {"", "A", "diffuse", "depthOfField", "albedo.R", "Zebra", "N.X"})
    EXPECT_FALSE(is_depth_like(name)) << name;
}

}  // namespace
}  // namespace lobelia
