#include "base/pictures/picture_layers.hpp"
#include "tests/test.hpp"
#include "tests/thrown.hpp"

namespace lobelia {
namespace {

std::vector<std::string> names(const std::vector<PicturePart>& parts) {
  std::vector<std::string> result;
  for (const PictureLayer& layer : picture_layers(parts)) result.push_back(layer.name);
  return result;
}

std::string message(const std::vector<PicturePart>& parts, const std::string& name) {
  return error_words(ExitCode::kInput, [&] { find_layer("a.exr", parts, name); });
}

TEST(PictureLayers, AreFoundByNameInWhateverOrderTheChannelsAre) {
  EXPECT_THAT(picture_layers({{{"", {"B", "G", "R"}}}})[0].where, ElementsAre(2, 1, 0));
  EXPECT_THAT(picture_layers({{{"", {"A", "g", "red", "Blue"}}}})[0].where, ElementsAre(2, 1, 3));
  const std::vector<PicturePart> file = {
      {"", {"A", "B", "G", "N.X", "N.Y", "N.Z", "R", "Z", "diffuse.B", "diffuse.G", "diffuse.R"}}};
  EXPECT_THAT(names(file), ElementsAre("", "N", "diffuse", "A", "Z"));
  EXPECT_THAT(find_layer("", file, "diffuse").where, ElementsAre(10, 9, 8));
  EXPECT_THAT(find_layer("", file, "N").where, ElementsAre(3, 4, 5));
  EXPECT_THAT(find_layer("", file, "Z").where, ElementsAre(7));
  EXPECT_THAT(find_layer("", file, "diffuse.G").where, ElementsAre(9));
}

TEST(PictureLayers, RecogniseColours) {
  const std::vector<PicturePart> file = {
      {"", {"R", "G", "B", "A", "Z", "N.X", "N.Y", "N.Z", "sss.Y"}}};
  for (const char* name : {"", "R", "sss"})
    EXPECT_TRUE(find_layer("", file, name).is_colour) << name;
  for (const char* name : {"A", "Z", "N", "N.X"})
    EXPECT_FALSE(find_layer("", file, name).is_colour) << name;
}

TEST(PictureLayers, YBesideXIsPartOfAVectorAndNoLuminance) {
  const std::vector<PicturePart> motion = {{"", {"motion.y", "R", "G", "B", "motion.x"}}};
  EXPECT_THAT(names(motion), ElementsAre("", "motion"));
  const PictureLayer vector = find_layer("", motion, "motion");
  EXPECT_THAT(vector.where, ElementsAre(4, 0));
  EXPECT_FALSE(vector.is_colour);
  EXPECT_THAT(names({{"", {"R", "G", "B", "P.x", "P.y", "P.z", "P.w"}}}),
              ElementsAre("", "P", "P.w"));
  EXPECT_THAT(message({{"", {"motion.x", "motion.y"}}}, ""), HasSubstr("'motion.x', 'motion.y'"));
  EXPECT_THAT(message({{"", {"x", "y"}}}, ""), HasSubstr("'x', 'y'"));
  EXPECT_THAT(names({{"", {"R", "G", "B", "motion.u", "motion.v"}}}),
              ElementsAre("", "motion.u", "motion.v"));
}

TEST(PictureLayers, KnowTheAlphaOfColours) {
  const std::vector<PicturePart> file = {
      {"first",
       {"R", "G", "B", "A", "diffuse.R", "diffuse.G", "diffuse.B", "diffuse.alpha", "N.Y"}},
      {"second", {"Y", "A"}}};
  EXPECT_EQ(find_layer("", file, "").alpha, "A");
  EXPECT_EQ(find_layer("", file, "diffuse").alpha, "diffuse.alpha");
  EXPECT_EQ(find_layer("", file, "second").alpha, "second.A");
  EXPECT_EQ(find_layer("", file, "N").alpha, "");
  EXPECT_EQ(find_layer("", file, "A").alpha, "");
}

TEST(PictureLayers, APartsNameMeansItsColoursOrAllThatItHas) {
  const std::vector<PicturePart> file = {{"beauty", {"R", "G", "B"}},
                                         {"motion", {"x", "y"}},
                                         {"left", {"Z", "R", "G", "B"}},
                                         {"speed", {"motion.x", "motion.y"}}};
  EXPECT_THAT(find_layer("", file, "left").where, ElementsAre(1, 2, 3));
  EXPECT_THAT(find_layer("", file, "speed").where, ElementsAre(0, 1));
  EXPECT_THAT(message(file, "motion"), HasSubstr("no layer 'motion'"))
      << "one of two components is not the motion";
}

TEST(PictureLayers, HoldEveryChannelOnceWhateverTheNamesAre) {
  constexpr const char* kPrefixes[] = {"", "motion", "N", "a.b", "A", "Y", "R"};
  constexpr const char* kSuffixes[] = {"R", "G",  "B",  "A",   "X",   "Y",     "Z", "x", "y",
                                       "z", "u",  "v",  "w",   "red", "Green", "r", "b", "alpha",
                                       "g", "RY", "BY", "foo", "id",  "blue",  "0", ""};
  std::mt19937 random(5);
  const auto pick = [&](const auto& from) { return std::string(from[random() % std::size(from)]); };
  for (int run = 0; run < 3000; ++run) {
    std::vector<PicturePart> parts(1 + random() % 3);
    for (PicturePart& part : parts) {
      part.name = pick(kPrefixes);
      std::set<std::string> channels;
      for (std::size_t count = 1 + random() % 7; channels.size() < count;) {
        const std::string prefix = pick(kPrefixes);
        channels.insert(prefix.empty() ? pick(kSuffixes) : prefix + "." + pick(kSuffixes));
      }
      part.channels.assign(channels.begin(), channels.end());
      std::shuffle(part.channels.begin(), part.channels.end(), random);
    }
    std::set<std::string> layer_names;
    std::map<std::pair<std::size_t, std::size_t>, int> uses;
    for (const PictureLayer& layer : picture_layers(parts)) {
      ASSERT_TRUE(layer_names.insert(layer.name).second) << layer.name;
      ASSERT_LE(layer.where.size(), 3u);
      for (const std::size_t c : layer.where) ++uses[{layer.part, c}];
      const PictureLayer found = find_layer("", parts, layer.name);
      ASSERT_EQ(found.part, layer.part) << layer.name;
      ASSERT_EQ(found.where, layer.where) << layer.name;
    }
    for (std::size_t p = 0; p < parts.size(); ++p)
      for (std::size_t c = 0; c < parts[p].channels.size(); ++c)
        ASSERT_EQ((uses[{p, c}]), 1) << run << " " << parts[p].channels[c];
  }
}

TEST(PictureLayers, PreferRgbThenYThenTheOnlyLayer) {
  EXPECT_THAT(find_layer("", {{{"", {"A", "Y"}}}}, "").where, ElementsAre(1));
  EXPECT_THAT(find_layer("", {{{"", {"Y", "R", "G", "B"}}}}, "").where, ElementsAre(1, 2, 3));
  EXPECT_THAT(find_layer("", {{{"", {"depth"}}}}, "").where, ElementsAre(0));
  const std::vector<PicturePart> one = {{"", {"beauty.R", "beauty.G", "beauty.B", "Z"}}};
  EXPECT_THAT(names(one), ElementsAre("", "Z"));
  EXPECT_THAT(find_layer("", one, "beauty").where, ElementsAre(0, 1, 2));
}

TEST(PictureLayers, LuminanceAndChromaAreOneLayerOfColours) {
  const std::vector<PicturePart> parts{{"", {"A", "BY", "RY", "Y", "Z"}}};
  const PictureLayer layer = find_layer("", parts, "");
  EXPECT_THAT(layer.where, ElementsAre(3, 2, 1));
  EXPECT_TRUE(layer.is_colour && layer.has_chroma);
  EXPECT_EQ(layer.alpha, "A");
  EXPECT_THAT(names(parts), ElementsAre("", "A", "Z"));
}

TEST(PictureLayers, AreNamedWhereANameCouldMeanSeveral) {
  EXPECT_THAT(message({{{"", {"u", "v"}}}}, ""), HasSubstr("its channels are 'u', 'v'"));
  // Half of a picture whose colours are in RY and BY, one of which is missing.
  EXPECT_THAT(message({{{"", {"RY", "Y"}}}}, ""), HasSubstr("'RY', 'Y'"));
  EXPECT_THAT(message({{{"", {"X", "Y", "Z"}}}}, ""), HasSubstr("'X', 'Y', 'Z'"));
  EXPECT_THAT(message({{{"", {"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"}}}}, ""),
              HasSubstr("a layer has to be chosen: 'a', 'b'"));
}

TEST(PictureLayers, AnUnknownNameIsToldTheNearest) {
  const std::vector<PicturePart> file = {
      {"", {"R", "G", "B", "diffuse.R", "diffuse.G", "diffuse.B", "Z"}}};
  EXPECT_EQ(message(file, "difuse"),
            "a.exr: no layer 'difuse'; did you mean 'diffuse'?; there are 'diffuse', 'Z'");
  EXPECT_EQ(message({{{"", {"R", "G", "B"}}}}, "Z"),
            "a.exr: no layer 'Z'; there is the picture alone");
  std::vector<std::string> many(1000, "channel\n");
  EXPECT_LT(message({{{"", many}}}, "R").size(), 1000u);
  EXPECT_EQ(message({{{"", many}}}, "R").find('\n'), std::string::npos);
}

TEST(PictureLayers, HaveTheNameOfTheirPart) {
  const std::vector<PicturePart> file = {{"beauty", {"R", "G", "B", "A"}},
                                         {"diffuse", {"R", "G", "B", "A"}},
                                         {"depth", {"depth.Z"}},
                                         {"", {"Y"}}};
  EXPECT_THAT(names(file), ElementsAre("", "A", "diffuse", "diffuse.A", "depth.Z", "part4"));
  EXPECT_EQ(find_layer("", file, "beauty").part, 0u);
  EXPECT_EQ(find_layer("", file, "diffuse").part, 1u);
  EXPECT_EQ(find_layer("", file, "depth").part, 2u);
  EXPECT_EQ(find_layer("", file, "diffuse.G").part, 1u);
  EXPECT_EQ(find_layer("", file, "part4").part, 3u);
}

TEST(PictureLayers, AreToldApartIfTheyShareAName) {
  const std::vector<PicturePart> file = {
      {"", {"R", "G", "B"}}, {"eye", {"R", "G", "B"}}, {"eye", {"R", "G", "B"}}};
  EXPECT_THAT(names(file), ElementsAre("", "eye", "eye#2"));
  EXPECT_EQ(find_layer("", file, "eye#2").part, 2u);
}

const std::vector<PicturePart> kCycles = {
    {"",
     {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B",
      "ViewLayer.Combined.A", "ViewLayer.Denoising Albedo.R", "ViewLayer.Denoising Albedo.G",
      "ViewLayer.Denoising Albedo.B", "ViewLayer.Normal.X", "ViewLayer.Normal.Y",
      "ViewLayer.Normal.Z", "ViewLayer.Denoising Normal.X", "ViewLayer.Denoising Normal.Y",
      "ViewLayer.Denoising Normal.Z", "ViewLayer.DiffDir.R", "ViewLayer.DiffDir.G",
      "ViewLayer.DiffDir.B", "ViewLayer.Depth.Z"}}};

TEST(PictureLayers, AreFoundByTheEndOfTheirNameInAnyCase) {
  for (const char* name : {"Combined", "combined", "viewlayer.COMBINED", "beauty", "rgba"})
    EXPECT_THAT(find_layer("", kCycles, name).where, ElementsAre(0, 1, 2)) << name;
  EXPECT_THAT(find_layer("", kCycles, "diffdir").where, ElementsAre(13, 14, 15));
  EXPECT_THAT(find_layer("", kCycles, "Depth").where, ElementsAre(16));
  EXPECT_THAT(find_layer("", kCycles, "denoising_albedo").where, ElementsAre(4, 5, 6));
}

TEST(PictureLayers, AreFoundByTheNamesOfOtherRenderers) {
  EXPECT_THAT(find_layer("", kCycles, "albedo").where, ElementsAre(4, 5, 6));
  EXPECT_THAT(find_layer("", kCycles, "N").where, ElementsAre(7, 8, 9)) << "not the denoiser's";
  EXPECT_THAT(find_layer("", kCycles, "diffuse_direct").where, ElementsAre(13, 14, 15));
  EXPECT_THAT(find_layer("", kCycles, "z").where, ElementsAre(16));
  EXPECT_THAT(message(kCycles, "diffuse"), HasSubstr("there are 'ViewLayer.DiffDir'"))
      << "direct light is not all of it";
  EXPECT_THAT(find_layer("", {{{"", {"R", "G", "B"}}}}, "combined").where, ElementsAre(0, 1, 2));
}

TEST(PictureLayers, KnowEachRenderersNameOfThePicture) {
  EXPECT_THAT(find_layer("", kCycles, "").where, ElementsAre(0, 1, 2));
  auto two = kCycles;
  for (const char* channel : {"Other.Combined.R", "Other.Combined.G", "Other.Combined.B"})
    two[0].channels.emplace_back(channel);
  EXPECT_THAT(message(two, ""), HasSubstr("a layer has to be chosen"));
  EXPECT_THAT(message(two, "combined"),
              HasSubstr("may be 'ViewLayer.Combined', 'Other.Combined'; give more of its name"));
  EXPECT_THAT(find_layer("", two, "other.combined").where, ElementsAre(17, 18, 19));
}

TEST(PictureLayers, AreFoundByTheirViewInAStereoFile) {
  // OpenEXR's rule: the default view is not in the names of channels without a layer.
  PicturePart plain{"", {"R", "G", "B", "right.R", "right.G", "right.B"}};
  plain.views = {"left", "right"};
  EXPECT_THAT(find_layer("", {{plain}}, "").where, ElementsAre(0, 1, 2));
  EXPECT_THAT(find_layer("", {{plain}}, "right").where, ElementsAre(3, 4, 5));
  EXPECT_THAT(find_layer("", {{plain}}, "left").where, ElementsAre(0, 1, 2));

  PicturePart cycles{"", {}};
  for (const char* pass : {"AO", "Combined"})
    for (const char* view : {"left", "right"})
      for (const char* channel : {"R", "G", "B"})
        cycles.channels.push_back(std::string("ViewLayer.") + pass + "." + view + "." + channel);
  cycles.views = {"left", "right"};
  EXPECT_THAT(find_layer("", {{cycles}}, "").where, ElementsAre(6, 7, 8));
  EXPECT_THAT(find_layer("", {{cycles}}, "Left").where, ElementsAre(6, 7, 8));
  EXPECT_THAT(find_layer("", {{cycles}}, "right").where, ElementsAre(9, 10, 11));
  EXPECT_THAT(find_layer("", {{cycles}}, "combined.right").where, ElementsAre(9, 10, 11));
  EXPECT_THAT(find_layer("", {{cycles}}, "ao").where, ElementsAre(0, 1, 2));

  std::vector<PicturePart> parts = {
      {"rgba_l", {"R", "G", "B"}}, {"rgba_r", {"R", "G", "B"}}, {"ao_r", {"AO.R", "AO.G", "AO.B"}}};
  parts[0].view = "left";
  parts[1].view = parts[2].view = "right";
  EXPECT_EQ(find_layer("", parts, "right").part, 1u);
  EXPECT_EQ(find_layer("", parts, "left").part, 0u);
  EXPECT_EQ(find_layer("", parts, "ao.right").part, 2u);
  EXPECT_EQ(find_layer("", parts, "rgba_r").part, 1u);
}

}  // namespace
}  // namespace lobelia
