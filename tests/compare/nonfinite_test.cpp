// Values that are not finite: where the first is, and which pictures share them.
#include "compare/nonfinite.hpp"

#include "compare/compare.hpp"
#include "compare/layers.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

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
