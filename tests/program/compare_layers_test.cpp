// `lobelia compare` on pictures with layers, alpha and channels of other names.
#include <nlohmann/json.hpp>
#include "base/pictures/image_io.hpp"
#include "tests/base/picture_files.hpp"
#include "tests/more_samples.hpp"
#include "tests/program/compare_pictures_fixture.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using namespace fixtures;

TEST_F(ComparePictures, OneLayerIsComparedByItsName) {
  flat("a.exr", 1,
       {channel("diffuse.R", 1), channel("diffuse.G", 2), channel("diffuse.B", 3),
        channel("Z", 70)});
  flat(
      "b.exr", 9,
      {channel("diffuse.R", 1), channel("diffuse.G", 2), channel("diffuse.B", 3), channel("Z", 7)});
  EXPECT_EQ(compare({"a.exr", "b.exr"}).exit_code, 1);
  const Record made = record({"a.exr", "b.exr", "--layer", "diffuse"}, 0);
  EXPECT_EQ(made["pictures"]["b"]["layer"], "diffuse");
  EXPECT_EQ(made["pictures"]["b"]["channels"], Record({"diffuse.R", "diffuse.G", "diffuse.B"}));
  EXPECT_EQ(compare({"a.exr", "b.exr", "--layer", "Z"}).exit_code, 1);
  const ProcessResult unknown = compare({"a.exr", "b.exr", "--layer", "difuse"});
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.output_tail,
              HasSubstr("no layer 'difuse'; did you mean 'diffuse'?; there are 'diffuse', 'Z'"));
}

TEST_F(ComparePictures, OneLayerMayHaveTwoNames) {
  exr("a.exr", 32, 32,
      {channel("View.DiffDir.R", 1), channel("View.DiffDir.G", 2), channel("View.DiffDir.B", 3),
       channel("View.AO.R", 1), channel("View.AO.G", 1), channel("View.AO.B", 1)});
  flat("b.exr", 9, {channel("diffuse.R", 1), channel("diffuse.G", 2), channel("diffuse.B", 3)});
  const Record made = record({"a.exr", "b.exr", "--layer", "diffdir=diffuse"}, 0);
  EXPECT_EQ(made["pictures"]["a"]["layer"], "View.DiffDir");
  EXPECT_EQ(made["pictures"]["b"]["layer"], "diffuse");
  EXPECT_EQ(compare({"a.exr", "b.exr", "--layer", "diffuse=diffdir"}).exit_code, 3);
  EXPECT_EQ(compare({"a.exr", "b.exr", "--layer", "=diffuse"}).exit_code, 2);
}

TEST_F(ComparePictures, AllLayersHaveFiguresAndTheWorstIsTheVerdict) {
  flat("a.exr", 1, {channel("A", 0.5f), channel("Z", 70), channel("same.Y", 1)});
  flat("b.exr", 1, {channel("A", 0.75f), channel("same.Y", 1), channel("id", 3)});
  const Record made = record({"a.exr", "b.exr", "--all-layers"}, 1);
  EXPECT_EQ(made["verdict"], "differs");
  EXPECT_EQ(made["metrics"]["max_abs"], 0);
  ASSERT_EQ(made["layers"].size(), 2u);
  for (const Record& layer : made["layers"]) {
    const bool alpha = layer["layer"] == "A";
    EXPECT_EQ(layer["verdict"], alpha ? "differs" : "pass");
    EXPECT_EQ(layer["metrics"]["max_abs"], alpha ? 0.25 : 0);
    EXPECT_EQ(layer["pictures"]["a"]["layer"], layer["layer"]);
  }
  EXPECT_EQ(made["layersInOne"]["a"], Record({"Z"}));
  EXPECT_EQ(made["layersInOne"]["b"], Record({"id"}));
  const std::string table = compare({"a.exr", "b.exr", "--all-layers"}).output_tail;
  EXPECT_THAT(table, HasSubstr("layer A (alpha): differs; max_rel_peak 0.3333 (limit 0.01)"));
  EXPECT_THAT(table, HasSubstr("only in a: Z"));
  EXPECT_THAT(table, HasSubstr("only in b: id"));
  EXPECT_THAT(table, HasSubstr("verdict: differs"));

  flat("c.exr", 1, {channel("A", std::numeric_limits<float>::quiet_NaN())});
  EXPECT_EQ(record({"c.exr", "b.exr", "--all-layers"}, 1)["verdict"], "non-finite");
}

TEST_F(ComparePictures, OpaqueAgainstTransparentDoesNotPass) {
  flat("opaque.exr", 0.5f, {channel("A", 1)});
  flat("clear.exr", 0.5f, {channel("A", 0)});
  const Record made = record({"clear.exr", "opaque.exr"}, 1);
  EXPECT_EQ(made["verdict"], "differs");
  EXPECT_EQ(made["metrics"]["max_abs"], 0) << "the picture itself";
  ASSERT_EQ(made["layers"].size(), 1u);
  EXPECT_EQ(made["layers"][0]["layer"], "A");
  EXPECT_EQ(made["layers"][0]["metrics"]["max_abs"], 1);
  EXPECT_EQ(compare({"opaque.exr", "clear.exr"}).exit_code, 1);
  // However dark the display is.
  EXPECT_EQ(compare({"opaque.exr", "clear.exr", "--exposure", "-20", "--fail", "flip.ldr.mean=0.1"})
                .exit_code,
            1);
  const Record same = record({"clear.exr", "clear.exr"}, 0);
  EXPECT_EQ(same["layers"][0]["identical"], true);
  EXPECT_EQ(same["notCompared"]["alpha"], false);
  const Record ignored = record({"clear.exr", "opaque.exr", "--ignore-alpha"}, 0);
  EXPECT_EQ(ignored["notCompared"]["alpha"], true);
  EXPECT_THAT(compare({"clear.exr", "opaque.exr", "--ignore-alpha"}).output_tail,
              HasSubstr("  not compared: alpha\n"));
  EXPECT_EQ(record({"clear.exr", "opaque.exr", "--ignore-alpha", "--all-layers"}, 0)["verdict"],
            "pass");
}

TEST_F(ComparePictures, AnAlphaThatOneSideAloneHasDiffersUnlessItIsOne) {
  flat("none.exr", 0.5f);
  flat("one.exr", 0.5f, {channel("A", 1)});
  flat("nearly_one.exr", 0.5f, {channel("A", 0.99999f)});
  std::vector<float> hole(32 * 32, 1.0f);
  hole[5] = 0.25f;
  hole[7] = std::numeric_limits<float>::quiet_NaN();
  flat("hole.exr", 0.5f, {{"A", hole}});
  for (const char* all : {"", "--all-layers"})
    for (const bool swap : {false, true}) {
      const auto with_none = [&](const char* other) {
        std::vector<std::string> arguments{swap ? "none.exr" : other, swap ? other : "none.exr"};
        if (*all) arguments.emplace_back(all);
        return arguments;
      };
      EXPECT_EQ(record(with_none("one.exr"), 0)["layers"], Record::array());
      EXPECT_EQ(compare(with_none("nearly_one.exr")).exit_code, 0);
      const Record made = record(with_none("hole.exr"), 1);
      ASSERT_EQ(made["layers"].size(), 1u) << made;
      const std::string why = made["layers"][0]["problem"];
      EXPECT_THAT(why, HasSubstr(swap ? "only b" : "only a"));
      EXPECT_THAT(why, HasSubstr("2 pixels of it are not 1, the least 0.25"));
      std::vector<std::string> quiet = with_none("hole.exr");
      quiet.emplace_back("-q");
      EXPECT_THAT(compare(quiet).output_tail, HasSubstr(why));
      quiet.back() = "--junit=-";
      EXPECT_THAT(compare(quiet).output_tail, HasSubstr(why));
      quiet.back() = "--ignore-alpha";
      EXPECT_EQ(record(quiet, 0)["notCompared"]["alpha"], true);
    }
  const std::vector<std::string> part{"hole.exr", "none.exr", "--crop", "8,0,8,8"};
  EXPECT_EQ(compare(part).exit_code, 0) << "it is 1 in the part that is compared";
  EXPECT_EQ(compare({"hole.exr", "none.exr", "--ignore", "rect:5,0,3,1"}).exit_code, 0);
  flat("other.exr", 0.51f, {{"A", hole}});
  EXPECT_EQ(compare({"hole.exr", "none.exr", "--a-replicate", "other.exr"}).exit_code, 1)
      << "no noise makes an alpha";
}

TEST_F(ComparePictures, FailsForAMissingLayerWithAllLayers) {
  flat("less.exr", 1);
  flat("more.exr", 1, {channel("Z", 1)});
  EXPECT_EQ(record({"less.exr", "more.exr", "--all-layers"}, 1)["verdict"], "differs");
  EXPECT_EQ(record({"more.exr", "less.exr", "--all-layers"}, 0)["notCompared"]["layers"],
            Record({"Z"}));
  for (const auto& [a, b] : {std::pair{"less.exr", "more.exr"}, {"more.exr", "less.exr"}}) {
    EXPECT_EQ(record({a, b}, 0)["notCompared"]["layers"], Record({"Z"}));
    EXPECT_THAT(compare({a, b}).output_tail, HasSubstr("  not compared: layer 'Z'\n"));
  }
  EXPECT_EQ(record({"more.exr", "more.exr", "--layer", "Z"}, 0)["notCompared"]["layers"],
            Record({""}))
      << "the picture";
}

TEST_F(ComparePictures, LayersHaveATypeThatEveryReportNames) {
  std::vector<float> far(32 * 32, 2.0f), ids(32 * 32, 7.0f);
  far[3] = std::numeric_limits<float>::infinity();
  flat("b.exr", 0.5f, {{"Z", far}, {"id", ids, Imf::UINT}, channel("mine", 1)});
  far[4] = far[3];
  ids[9] = 8;
  flat("a.exr", 0.5f, {{"Z", far}, {"id", ids, Imf::UINT}, channel("mine", 1.0000001f)});
  const Record made = record({"a.exr", "b.exr", "--all-layers"}, 1);
  std::map<std::string, Record> layers;
  for (const Record& layer : made["layers"]) layers[layer["layer"]] = layer;
  EXPECT_EQ(layers["Z"]["type"], "depth");
  EXPECT_EQ(layers["Z"]["metrics"]["depth.background"], 1);
  EXPECT_EQ(layers["id"]["type"], "identifier");
  EXPECT_EQ(layers["id"]["metrics"]["identifier.pixels"], 1);
  EXPECT_EQ(layers["id"]["finding"], "a has 8 where b has 7, in 1 pixel");
  EXPECT_EQ(layers["mine"]["type"], "colour");
  EXPECT_FALSE(made.contains("type")) << "the picture is a colour";
  EXPECT_THAT(
      compare({"a.exr", "b.exr", "--all-layers"}).output_tail,
      AllOf(HasSubstr("layer Z (depth): differs"), HasSubstr("depth.background 1 (limit 0)"),
            HasSubstr("layer id (identifier): differs; identifier.pixels 1 (limit 0); a has 8")));
  EXPECT_THAT(
      compare({"a.exr", "b.exr", "--all-layers", "--csv", "-"}).output_tail,
      HasSubstr("layer Z (depth): differs; layer id (identifier): differs; layer mine: pass"));
  for (const char* report : {"-q", "--junit=-", "--markdown=-"})
    EXPECT_THAT(compare({"a.exr", "b.exr", "--all-layers", report}).output_tail,
                HasSubstr("identifier.pixels is 1, limit 0"))
        << report;
}

TEST_F(ComparePictures, AChannelThatDiffersAloneNeverPassesUnsaid) {
  // Random channels; of each file every channel differs once. One run of two folders for each way to ask.
  constexpr const char* kPrefixes[] = {"", "", "motion.", "N.", "a.b.", "diffuse.", "Y."};
  constexpr const char* kSuffixes[] = {"R", "G", "B", "A", "X", "Y", "Z",     "x",
                                       "y", "z", "u", "v", "w", "r", "alpha", "id"};
  std::mt19937 random(11);
  std::map<std::string, std::string> changed;  // channel by file
  for (const char* side : {"a", "b"}) std::filesystem::create_directory(path(side));
  for (int run = 0; run < 14 * more_samples(); ++run) {
    std::set<std::string> names;
    if (run % 2 == 0) names = {"R", "G", "B"};
    for (std::size_t count = names.size() + 1 + random() % 4; names.size() < count;)
      names.insert(std::string(kPrefixes[random() % std::size(kPrefixes)]) +
                   kSuffixes[random() % std::size(kSuffixes)]);
    for (const std::string& other : names) {
      const std::string file = std::to_string(run) + "_" + std::to_string(changed.size()) + ".exr";
      for (const bool is_a : {true, false}) {
        std::vector<ExrChannel> channels;
        float value = 1;
        for (const std::string& name : names)
          channels.push_back(
              {name, std::vector<float>(16 * 16, is_a && name == other ? 20 : ++value)});
        exr((is_a ? "a/" : "b/") + file, 16, 16, channels);
      }
      changed[file] = other;
    }
  }
  ASSERT_GT(changed.size(), 35u);
  std::size_t named = 0, failed = 0;
  for (const bool all : {true, false}) {
    std::vector<std::string> arguments = {"a", "b", "--json", "set.json"};
    if (all) arguments.emplace_back("--all-layers");
    compare(arguments);
    const Record set = Record::parse(read_file(path("set.json"), 64 << 20));
    ASSERT_EQ(set["pairs"].size(), changed.size());
    for (const Record& pair : set["pairs"]) {
      const std::string channel = changed[pair["name"]];
      if (!pair.contains("comparison")) {
        EXPECT_FALSE(all) << pair;
        EXPECT_THAT(std::string(pair["error"]), HasSubstr("a layer has to be chosen"));
        continue;
      }
      const Record& made = pair["comparison"];
      if (made["verdict"] != "pass") {
        ++failed;
        continue;
      }
      EXPECT_FALSE(all) << channel << " " << made["pictures"]["a"] << made["notCompared"];
      const auto has_channel = [&](const Record& layer) {
        const std::string name = layer;
        return name == channel || channel.starts_with(name + ".");
      };
      const Record& layers = made["notCompared"]["layers"];
      EXPECT_TRUE(std::any_of(layers.begin(), layers.end(), has_channel))
          << channel << " " << made["notCompared"];
      ++named;
    }
  }
  EXPECT_GT(named, 6u);
  EXPECT_GT(failed, 35u);
}

}  // namespace
}  // namespace lobelia
