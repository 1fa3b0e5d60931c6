// lobelia convert, and the page that shows it.
#include <regex>

#include "tests/json.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/studies/merl_file.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

std::string page() { return read_file(LOBELIA_SOURCE_DIR "/docs/convert.md", 1 << 20); }

class ConvertCommand : public testing::Test {
 protected:
  ProcessResult run(const std::string& arguments) const {
    return run_shell("\"$LOBELIA\" convert " + arguments, directory_.path());
  }
  std::string printed(const std::string& commands) const {
    const auto result = run_shell(
        "lobelia() { \"$LOBELIA\" \"$@\"; }\n(\n" + commands + ") > printed", directory_.path());
    EXPECT_EQ(result.exit_code, 0) << commands << result.output_tail;
    return read_file(directory_.path() / "printed", 1 << 20);
  }
  const TemporaryDirectory directory_;
};

TEST_F(ConvertCommand, PrintsTheOutputOnThePage) {
  const std::string text = page();
  static const std::regex example("```sh\n([^`]*)```\n\n```text\n([^`]*)```\n");
  int examples = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), example), end; it != end; ++it) {
    EXPECT_EQ(printed((*it)[1]), (*it)[2]) << (*it)[1];
    ++examples;
  }
  EXPECT_GE(examples, 3);
}

TEST_F(ConvertCommand, DrawsThePicturesOfThePage) {
  static const std::regex drawing("(lobelia convert [^`\n]* --svg) (docs/images/[a-z_]*.svg)");
  const std::string text = page();
  int pictures = 0;
  for (std::sregex_iterator it(text.begin(), text.end(), drawing), end; it != end; ++it) {
    EXPECT_EQ(printed((*it)[1].str() + " -\n"),
              read_file(LOBELIA_SOURCE_DIR "/" + (*it)[2].str(), 1 << 20))
        << "run: " << it->str();
    ++pictures;
  }
  EXPECT_EQ(pictures, 2);
}

TEST_F(ConvertCommand, WritesARecordAndAChart) {
  const auto result =
      run("--exponent 32 --to ggx --measure width --json record.json --svg chart.svg");
  ASSERT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, StartsWith("blinn_phong_heightfield, exponent 32\n"));
  EXPECT_THAT(read_file(directory_.path() / "chart.svg", 1 << 20), StartsWith("<svg"));
  const Json record = Json::parse(read_file(directory_.path() / "record.json", 1 << 20));
  EXPECT_EQ(record["kind"], "conversion");
  EXPECT_EQ(record["measure"], "width");
  EXPECT_EQ(record["best"].size(), 4u);
  EXPECT_EQ(record["rules"].size(), 5u);
  EXPECT_NEAR(double(record["best"][1]["errors"]["halfWidthRatio"]), 1, 1e-9);
  const Json range = Json::parse(printed("lobelia convert --to phong_rdf --json -\n"));
  EXPECT_EQ(range["kind"], "conversion-table");
  EXPECT_EQ(range["from"], "ggx");
  EXPECT_EQ(range["columns"].size(), 9u);
}

TEST_F(ConvertCommand, WritesTheMaterialsOfAFile) {
  write_file(directory_.path() / "a.mtl", "newmtl shiny\nNs 100\nnewmtl plain\n");
  const Json record = Json::parse(printed("lobelia convert a.mtl --to ggx --f0 0.04 --json -\n"));
  EXPECT_EQ(record["kind"], "converted-materials");
  EXPECT_EQ(record["file"], "a.mtl");
  const Json& shiny = record["materials"][0];
  EXPECT_EQ(shiny["from"]["exponent"], 100);
  EXPECT_EQ(shiny["reflectance"], 0.04);
  EXPECT_EQ(shiny["best"][0]["highlight"]["model"], "ggx");
  EXPECT_EQ(shiny["rules"].size(), 5u);
  EXPECT_FALSE(record["materials"][1].contains("from"));
  expect_one_line(run("a.mtl --exponent 3"), 2, "leave out --from, --exponent");
  expect_one_line(run("a.obj"), 2, "allowed: .mtl");
  expect_one_line(run("missing.mtl"), 3, "missing.mtl");
  expect_one_line(run("a.mtl --json a.mtl"), 2, "a.mtl");
}

TEST_F(ConvertCommand, ARoughnessIsTheRootOfAlpha) {
  const auto best = [&](const std::string& from) {
    return Json::parse(
        printed("lobelia convert " + from + " --to phong_rdf --measure width --json -\n"))["best"];
  };
  EXPECT_EQ(best("--roughness 0.5"), best("--alpha 0.25"));
  EXPECT_NE(best("--roughness 0.5"), best("--alpha 0.5"));
}

TEST_F(ConvertCommand, FitsAMeasuredMaterialBesideItsGroundTruth) {
  const fs::path file = directory_.path() / "blue paint.binary";
  write_file(file, merl_bytes([](Vec3 to_eye, Vec3 to_light) {
               const double lobe = 72 / (8 * kPi) * std::pow(normalize(to_eye + to_light).z, 70);
               return Rgb{0.1 + 0.3 * lobe, 0.1 + 0.3 * lobe, 0.2 + 0.3 * lobe};
             }));
  const auto result = run("'blue paint.binary' -o fits --json record.json");
  ASSERT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, StartsWith("blue paint.binary (MERL), "));
  const Json record = Json::parse(read_file(directory_.path() / "record.json", 1 << 20));
  EXPECT_EQ(record["kind"], "measured-fits");
  EXPECT_EQ(record["fits"][0]["lobe"], "cosine");
  EXPECT_NEAR(double(record["fits"][0]["exponent"]), 70, 1e-3);
  EXPECT_NEAR(double(record["fits"][0]["diffuse"][2]), 0.2 * kPi, 1e-4);
  // The scene beside a fit's picture renders to that picture, and the fit is near to the measurement.
  for (const char* scene : {"head_on", "oblique_45"}) {
    SCOPED_TRACE(scene);
    const std::string name = std::string("/") + scene;
    const auto compared = run_shell(
        "\"$LOBELIA\" render fits/fit_1" + name + ".xml -o again.exr && cmp again.exr fits/fit_1" +
            name + ".exr && \"$LOBELIA\" compare fits/fit_1" + name + ".exr fits/measured" + name +
            ".exr --no-default-limits --fail max_rel_peak=0.05",  // 0.026 measured: steps of the cells
        directory_.path());
    EXPECT_EQ(compared.exit_code, 0) << compared.output_tail;
    EXPECT_TRUE(
        fs::exists(directory_.path() / ("fits/png/measured_" + std::string(scene) + ".png")));
  }
}

TEST_F(ConvertCommand, RefusesOtherFilesThanMeasuredMaterials) {
  write_file(directory_.path() / "short.binary", "abc");
  write_file(directory_.path() / "short.bsdf", "abc");
  expect_one_line(run("none.binary -o fits"), 3, "none.binary");
  expect_one_line(run("short.binary -o fits"), 3, "is no MERL file");
  expect_one_line(run("short.bsdf"), 3, "is no tensor file");
  expect_one_line(run("short.txt"), 2, ".binary, .bsdf");
  expect_one_line(run("short.bsdf --to ggx"), 2, "FILE");
  expect_one_line(run("short.bsdf --json short.bsdf"), 2, "short.bsdf");
  EXPECT_FALSE(fs::exists(directory_.path() / "fits"));
}

TEST_F(ConvertCommand, RefusesWrongValuesInOneLine) {
  constexpr std::pair<const char*, const char*> kMistakes[] = {
      {"--exponent 32", "--to is required"},
      {"--exponent 32 --alpha 0.1 --to ggx", "only one of --exponent"},
      {"--exponent 32 --to gx", "--to 'gx' is unknown"},
      {"--exponent 32 --to ggx --from ggx", "--from ggx takes --alpha or --roughness"},
      {"--alpha 0.1 --to ggx --from phong_rdf", "--from phong_rdf takes --exponent"},
      {"--exponent nan --to ggx", "allowed: 0 to 1e+08"},
      {"--exponent 1e99 --to ggx", "allowed: 0 to 1e+08"},
      {"--alpha 0 --to phong_rdf", "allowed: 0.0001 to 1"},
      {"--roughness 2 --to phong_rdf", "allowed: 0.01 to 1"},
      {"--exponent 32 --to ggx --f0 0", "allowed: 0.001 to 1"},
      {"--exponent 32 --to ggx --measure widht", "did you mean 'width'?"},
      {"--exponent 32 --to ggx --json a --svg a", "written by this command already"},
      {"--exponent 32 --to ggx --json - --svg -", "only one of --json and --svg can go to stdout"},
  };
  for (const auto& [arguments, message] : kMistakes) {
    SCOPED_TRACE(arguments);
    expect_one_line(run(arguments), 2, message);
  }
  EXPECT_EQ(run("--exponent 32 --to ggx --json no/such/a.json").exit_code, 4);
  EXPECT_EQ(files_in(directory_.path()), 0u);
}

}  // namespace
}  // namespace lobelia
