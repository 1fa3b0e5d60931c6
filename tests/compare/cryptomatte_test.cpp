// Cryptomattes: which objects cover a pixel, by how much, and metadata that somebody else wrote.
#include "compare/cryptomatte.hpp"

#include <fmt/format.h>

#include "base/records/manifest.hpp"
#include "tests/compare/layer_files.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

constexpr std::uint32_t kBall = 0xdeadbeef, kCube = 0x3f00d001, kFloor = 0x00000007;

/// An object's share of a pixel.
struct Share {
  std::uint32_t id = 0;
  float share = 0;
};

class Cryptomatte : public LayerFiles {
 protected:
  /// By rank, two for each layer; of every pixel.
  using Ranks = std::vector<std::vector<Share>>;

  static std::vector<ExrChannel> channels(const Ranks& ranks, const std::string& name = "crypto",
                                          Imf::PixelType coverage = Imf::FLOAT) {
    std::vector<ExrChannel> result;
    for (std::size_t rank = 0; rank < ranks.size(); ++rank) {
      std::vector<float> ids, shares;
      for (const auto& [id, share] : ranks[rank]) {
        ids.push_back(std::bit_cast<float>(id));
        shares.push_back(share);
      }
      const std::string layer = fmt::format("{}{:02}.", name, rank / 2);
      result.push_back({layer + (rank % 2 == 0 ? "R" : "B"), ids});
      result.push_back({layer + (rank % 2 == 0 ? "G" : "A"), shares, coverage});
    }
    return result;
  }
  static Texts metadata(const std::string& name = "crypto", const std::string& manifest = "{}") {
    return {{"cryptomatte/1234567/name", name},
            {"cryptomatte/1234567/hash", "MurmurHash3_32"},
            {"cryptomatte/1234567/conversion", "uint32_to_float32"},
            {"cryptomatte/1234567/manifest", manifest}};
  }
  /// The left half is a ball in front of the floor, the right half a cube.
  static Ranks scene() {
    Ranks ranks(4, std::vector<Share>(kPixels));
    for (int i = 0; i < kPixels; ++i) {
      const bool left = i % kSide < kSide / 2;
      ranks[0][std::size_t(i)] = {left ? kBall : kCube, 0.75f};
      ranks[1][std::size_t(i)] = {kFloor, 0.25f};
    }
    return ranks;
  }
  LayerComparison compare_ranks(const Ranks& a, const Ranks& b, const Texts& texts = metadata()) {
    file("a.exr", channels(a), texts);
    file("b.exr", channels(b), texts);
    return compare_one();
  }
};

TEST_F(Cryptomatte, IsOneLayerAndPassesIfItIsTheSame) {
  const LayerComparison layer = compare_ranks(scene(), scene());
  EXPECT_EQ(layer.name, "crypto");
  EXPECT_EQ(layer.type, LayerType::kIdentifier);
  EXPECT_EQ(value(layer, "identifier.pixels"), 0);
  EXPECT_EQ(value(layer, "coverage.max"), 0);
  EXPECT_EQ(layer.verdict(), Verdict::kPass);
  const OtherLayers all = compare_all();
  EXPECT_TRUE(is_empty(all.not_compared)) << to_text(all.not_compared);
  EXPECT_TRUE(all.common->only_a.empty() && all.common->only_b.empty());
}

TEST_F(Cryptomatte, CountsThePixelsOfExchangedObjects) {
  Ranks a = scene();
  for (int i = 0; i < kPixels / 2; ++i) {
    std::uint32_t& id = a[0][std::size_t(i)].id;
    id = id == kBall ? kCube : kBall;
  }
  const LayerComparison layer = compare_ranks(
      a, scene(), metadata("crypto", R"({"ball \"\u00e9\"": "deadbeef", "cube\n": "3f00d001"})"));
  EXPECT_EQ(value(layer, "identifier.pixels"), kPixels / 2);
  EXPECT_EQ(layer.verdict(), Verdict::kDiffers);
  EXPECT_THAT(layer.comparison->finding, HasSubstr("'ball \"é\"'"));
  EXPECT_THAT(layer.comparison->finding, HasSubstr("'cube\\n'")) << "one line";
}

TEST_F(Cryptomatte, CountsOutsideOfTheDisplayWindowToo) {
  constexpr int kBorder = 2, kWide = kSide + 2 * kBorder;
  /// `outside`: the object beyond the display window; 0 for none.
  const auto write = [&](const std::string& name, bool has_overscan, std::uint32_t outside) {
    const auto display = window(0, 0, kSide, kSide);
    const auto data = has_overscan ? window(-kBorder, -kBorder, kWide, kWide) : display;
    Ranks ranks(2);
    for (int y = data.min.y; y <= data.max.y; ++y)
      for (int x = data.min.x; x <= data.max.x; ++x) {
        const bool inside = x >= 0 && y >= 0 && x < kSide && y < kSide;
        const std::uint32_t id = inside ? kBall : outside;
        ranks[0].push_back({id, id == 0 ? 0.0f : 1.0f});
        ranks[1].emplace_back();
      }
    auto all = channels(ranks);
    for (const char* letter : {"R", "G", "B"})
      all.push_back({letter, std::vector<float>(ranks[0].size(), 0.5f)});
    write_exr_parts(path(name), {{.data = data, .display = display, .channels = all}});
  };
  const auto verdicts = [&] {
    std::vector<Verdict> found;
    for (const LayerComparison& layer : compare_all().compared)
      if (layer.name == "crypto") found.push_back(layer.verdict());
    return found;
  };
  write("b.exr", true, kCube);
  write("a.exr", true, kCube);
  EXPECT_EQ(verdicts(), (std::vector{Verdict::kPass, Verdict::kPass}));
  write("a.exr", true, kFloor);
  EXPECT_EQ(verdicts(), (std::vector{Verdict::kPass, Verdict::kDiffers}));
  const LayerComparison outside = compare_all().compared.back();
  EXPECT_EQ(outside.title(), "overscan of layer crypto (identifier)");
  EXPECT_EQ(value(outside, "identifier.pixels"), kWide * kWide - kPixels);
  write("a.exr", false, 0);
  EXPECT_EQ(verdicts(), (std::vector{Verdict::kPass, Verdict::kDiffers})) << "b alone has objects";
  write("b.exr", true, 0);
  EXPECT_EQ(verdicts(), (std::vector{Verdict::kPass, Verdict::kPass})) << "no object, as no data";
  // As the picture itself.
  write("a.exr", true, kFloor);
  write("b.exr", true, kCube);
  PicturePair pair = read_pair(path("a.exr"), path("b.exr"), parse_layer_names("crypto00"));
  const OtherLayers others = compare_others(path("a.exr"), path("b.exr"), pair, {}, options());
  ASSERT_EQ(others.compared.size(), 1u);
  EXPECT_EQ(others.compared.front().verdict(), Verdict::kDiffers);
  EXPECT_EQ(others.not_compared.overscan_pixels, 0);
}

TEST_F(Cryptomatte, IsASetWhateverTheOrderOfItsRanks) {
  std::mt19937 random(6);
  Ranks b(4, std::vector<Share>(kPixels));
  for (std::size_t i = 0; i < kPixels; ++i)
    for (auto& rank : b) rank[i] = {std::uint32_t(random() % 4), 0.25f * float(random() % 3)};
  Ranks a = b;
  for (std::size_t i = 0; i < kPixels; ++i) {
    std::vector<Share> pixel;
    for (const auto& rank : a) pixel.push_back(rank[i]);
    std::shuffle(pixel.begin(), pixel.end(), random);
    for (std::size_t rank = 0; rank < a.size(); ++rank) a[rank][i] = pixel[rank];
  }
  const LayerComparison layer = compare_ranks(a, b);
  EXPECT_EQ(value(layer, "identifier.pixels"), 0);
  EXPECT_EQ(value(layer, "coverage.max"), 0);
}

TEST_F(Cryptomatte, SaysByHowMuchAnObjectsCoverageDiffers) {
  Ranks a = scene();
  a[0][9].share -= 0.125f;
  a[1][9].share += 0.0625f;
  const LayerComparison layer = compare_ranks(a, scene());
  EXPECT_EQ(value(layer, "identifier.pixels"), 0);
  EXPECT_EQ(value(layer, "coverage.max"), 0.125);
  EXPECT_EQ(value(layer, "coverage.mean"), 0.125 / kPixels);
  EXPECT_EQ(layer.verdict(), Verdict::kDiffers);
}

TEST_F(Cryptomatte, PassesWithCoverageInHalfFloats) {
  Ranks b = scene();
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0, 1);
  for (std::size_t i = 0; i < kPixels; ++i) {
    b[0][i].share = unit(random);
    b[1][i].share = 1 - b[0][i].share;
  }
  file("a.exr", channels(b, "crypto", Imf::HALF), metadata());
  file("b.exr", channels(b), metadata());
  EXPECT_EQ(compare_one().verdict(), Verdict::kPass);
}

TEST_F(Cryptomatte, IsToldByItsNameOrByItsMetadata) {
  Ranks a = scene();
  a[0][0].id ^= 1u;
  for (const auto& [name, texts] : {std::pair<std::string, Texts>("View.CryptoObject", {}),
                                    {"object.ids", metadata("object.ids")},
                                    {"View.object.ids", metadata("object.ids")},
                                    {"x y", metadata("x y")}}) {
    file("a.exr", channels(a, name), texts);
    file("b.exr", channels(scene(), name), texts);
    const LayerComparison layer = compare_one();
    EXPECT_EQ(layer.name, name);
    EXPECT_EQ(value(layer, "identifier.pixels"), 1) << name;
  }
}

TEST_F(Cryptomatte, IsToldByTheMetadataOfOneFileToo) {
  Ranks a = scene();
  a[0][0].id ^= 1u;
  file("a.exr", channels(a, "matte"));
  file("b.exr", channels(scene(), "matte"), metadata("matte"));
  EXPECT_EQ(value(compare_one(), "identifier.pixels"), 1);
}

TEST_F(Cryptomatte, DiffersIfARankIsLost) {
  file("a.exr", channels({scene()[0], scene()[1]}), metadata());
  file("b.exr", channels(scene()), metadata());
  const OtherLayers all = compare_all();
  EXPECT_EQ(worst_verdict(Verdict::kPass, all), Verdict::kDiffers);
  EXPECT_FALSE(all.common->only_b.empty());
}

TEST_F(Cryptomatte, IsComparedWithHostileMetadata) {
  Ranks a = scene();
  a[0][0].id ^= 1u;
  const std::string deep(100000, '['), huge(9 << 20, 'x');
  for (const std::string& manifest :
       {std::string(), std::string("{\"ball"), std::string("[]"),
        std::string("{\"a\": {\"b\": 1}}"),
        std::string("{\"a\": \"no hash\", \"b\": \"deadbeefdeadbeef\"}"), deep,
        "{\"" + huge + "\": \"deadbeef\"}", std::string("{\"\\ud800\": \"deadbeef\"}")}) {
    const LayerComparison layer = compare_ranks(a, scene(), metadata("crypto", manifest));
    EXPECT_EQ(value(layer, "identifier.pixels"), 1) << manifest.substr(0, 40);
  }
  Texts many = metadata();
  for (int i = 0; i < 300; ++i) many[fmt::format("cryptomatte/{}/name", i)] = fmt::format("c{}", i);
  for (const char* key : {"cryptomatte//name", "cryptomatte/name", "cryptomatte/x/name"})
    many[key] = "";
  EXPECT_EQ(value(compare_ranks(a, scene(), many), "identifier.pixels"), 1);
}

TEST(Manifests, AreReadUpToTheirFirstMistake) {
  const auto names =
      records::object_names(R"({"a": "00000001", "\t\u00e9": "ff", "c": 3, "d": "04"})");
  EXPECT_EQ(names.size(), 2u);
  EXPECT_EQ(names.at(1), "a");
  EXPECT_EQ(names.at(255), "\té");
  EXPECT_TRUE(records::object_names("").empty());
  EXPECT_TRUE(records::object_names("\"deadbeef\"").empty());
}

TEST_F(Cryptomatte, ComparesOnlyThePartThatCounts) {
  Ranks a = scene();
  a[0][0].id ^= 1u;
  file("a.exr", channels(a), metadata());
  file("b.exr", channels(scene()), metadata());
  ComparisonOptions part = options();
  part.crop = PixelWindow{1, 0, 4, 4};
  PicturePair pair = read_pair(path("a.exr"), path("b.exr"), {"crypto00", "crypto00"});
  take_part(pair, "a", "b", part);
  EXPECT_EQ(compare_pictures(pair, path("a.exr").string(), path("b.exr").string(), part)
                .value("identifier.pixels"),
            0);
  ComparisonOptions ignoring = options();
  ignoring.ignored = PixelFlags(kPixels);
  ignoring.ignored[0] = 1;
  EXPECT_EQ(value(compare_one(ignoring), "identifier.pixels"), 0);
}

}  // namespace
}  // namespace lobelia
