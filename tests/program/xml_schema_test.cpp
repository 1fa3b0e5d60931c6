// The XML Schemas of scene and grid files: every file that the program reads is valid, and common mistakes are not.
#include "base/system/error.hpp"
#include "farm/grid.hpp"
#include "renderer/scene/scene_io.hpp"
#include "tests/house/tree.hpp"
#include "tests/program/page_commands.hpp"
#include "tests/renderer/random_scene.hpp"
#include "tests/renderer/scene_text.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

const fs::path kSource = LOBELIA_SOURCE_DIR;

bool is_read(const fs::path& file, const std::string& root) {
  try {
    root == "scene" ? void(read_scene(file)) : void(read_grid(file));
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// "scene" for a text that begins with <scene version=..., also after comments.
bool has_root(const std::string& text, const std::string& root) {
  const auto at = text.find("<" + root + " version=");
  return at != text.npos && text.find("</") > at;
}

/// The examples on a page.
std::vector<std::string> xml_blocks(const std::string& page) {
  std::vector<std::string> blocks;
  bool inside = false;
  for (const std::string& line : house::lines(page)) {
    if (line == "```xml") blocks.emplace_back();
    if (line.starts_with("```"))
      inside = line == "```xml";
    else if (inside)
      blocks.back() += line + "\n";
  }
  return blocks;
}

class XmlSchema : public testing::Test {
 protected:
  void SetUp() override {
    if (find_program("xmllint").empty()) GTEST_SKIP() << "xmllint is not installed";
    // Examples name their scenes as the grids of the source do.
    fs::create_directory(directory_.path() / "grids");
    fs::create_directory_symlink(kSource / "reference_scenes/scenes", directory_.path() / "scenes");
  }
  ProcessResult lint(std::vector<std::string> files, const std::string& root) {
    files.insert(files.begin(), {"/usr/bin/env", "xmllint", "--noout", "--schema",
                                 kSource / ("docs/reference/" + root + ".xsd")});
    return run_process(files, {});
  }
  std::string example(const std::string& text) {
    const fs::path path =
        directory_.path() / "grids" / ("example" + std::to_string(examples_++) + ".xml");
    write_file(path, text);
    return path;
  }

  const TemporaryDirectory directory_;
  int examples_ = 0;
};

class XmlSchemaOf : public XmlSchema, public testing::WithParamInterface<std::string> {};
INSTANTIATE_TEST_SUITE_P(Roots, XmlSchemaOf, testing::Values("scene", "grid"));

TEST_P(XmlSchemaOf, IsTheCommittedOne) {
  const std::string option = GetParam() == "scene" ? "--xsd" : "--grid-xsd";
  const ProcessResult printed =
      run_shell("\"$LOBELIA\" scene-format " + option + " > s", directory_.path());
  EXPECT_EQ(printed.exit_code, 0) << printed.output_tail;
  const std::string file = "docs/reference/" + GetParam() + ".xsd";
  EXPECT_EQ(house::read(directory_.path() / "s"), house::read(kSource / file))
      << "run: lobelia scene-format " << option << " > " << file;
}

TEST_P(XmlSchemaOf, CommandsOfItsPageRun) {
  const TemporaryDirectory directory;
  const ProcessResult result = run_commands(
      page_commands("docs/" + GetParam() + "_format.md", "## Completion"), directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_TRUE(fs::exists(directory.path() / (GetParam() + ".xsd")));
}

TEST_P(XmlSchemaOf, KnowsEveryFileOfTheSourceThatIsRead) {
  std::vector<std::string> valid;
  std::size_t shown = 0;
  for (const fs::path& file : house::project_files(kSource)) {
    const fs::path path = kSource / file;
    if (file.extension() == ".xml" && has_root(house::read(path), GetParam()) &&
        is_read(path, GetParam()))
      valid.push_back(path);
    if (file.extension() != ".md") continue;
    for (const std::string& block : xml_blocks(house::read(path))) {
      if (!has_root(block, GetParam())) continue;
      const std::string written = example(block);
      if (is_read(written, GetParam())) valid.push_back(written), ++shown;
    }
  }
  EXPECT_GE(valid.size(), GetParam() == "scene" ? 20u : 8u);
  EXPECT_GE(shown, 1u);
  const ProcessResult checked = lint(valid, GetParam());
  EXPECT_EQ(checked.exit_code, 0) << checked.output_tail;
}

TEST_F(XmlSchema, AcceptsFilesWrittenByTheProgram) {
  std::vector<std::string> written;
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
    written.push_back(example(scene_to_xml(random_scene(seed, SceneKind::kAny))));
  const ProcessResult checked = lint(written, "scene");
  EXPECT_EQ(checked.exit_code, 0) << checked.output_tail;
}

TEST_F(XmlSchema, AllowsTheElementsInAnyOrder) {
  std::string head = house::read(fs::path(kScenes) / "head_on.xml");
  const auto begin = head.find("<sensor"), end = head.find("</sensor>") + 9;
  const std::string sensor = head.substr(begin, end - begin);
  head.erase(begin, end - begin);
  head.insert(head.find("</scene>"), sensor);
  const std::string file = example(head);
  EXPECT_TRUE(is_read(file, "scene"));
  const ProcessResult checked = lint({file}, "scene");
  EXPECT_EQ(checked.exit_code, 0) << checked.output_tail;
}

struct SchemaMistake {
  const char *right, *wrong;
};

/// Both refuse each mistake, and read the text without it.
void expect_refused(const std::string& right, std::span<const SchemaMistake> mistakes,
                    const std::function<bool(const std::string&)>& read,
                    const std::function<bool(const std::string&)>& valid) {
  ASSERT_TRUE(read(right) && valid(right));
  for (const auto& [from, to] : mistakes) {
    std::string wrong = right;
    ASSERT_NE(wrong.find(from), wrong.npos) << from;
    wrong.replace(wrong.find(from), std::string(from).size(), to);
    EXPECT_FALSE(read(wrong)) << to;
    EXPECT_FALSE(valid(wrong)) << to;
  }
}

TEST_F(XmlSchema, RefusesMistakesInAScene) {
  const std::string right = scene(
      "<integrator type=\"path\"><integer name=\"mirror_depth\" value=\"2\"/></integrator>"
      "<emitter type=\"directional\"><vector name=\"direction\" value=\"0, 0, -1\"/>"
      "<rgb name=\"irradiance\" value=\"1 .5 2e3\"/></emitter>"
      "<bsdf type=\"phong_rdf\" id=\"m\"><float name=\"exponent\" value=\"8\"/></bsdf>"
      "<shape type=\"sphere\"><point name=\"center\" x=\"1\"/><ref id=\"m\"/></shape>");
  const SchemaMistake mistakes[] = {
      {"<emitter type", "<emiter type"},
      {"\"phong_rdf\"", "\"phong\""},
      {"\"exponent\"", "\"exponnent\""},
      {"value=\"8\"", "value=\"1e9\""},
      {"value=\"8\"", "value=\"eight\""},
      {"value=\"8\"", "val=\"8\""},
      {"value=\"2\"", "value=\"65\""},
      {"value=\"2\"", "value=\"1.5\""},
      {"value=\"0, 0, -1\"", "value=\"0, -1\""},
      {"value=\"0, 0, -1\"", "value=\"0, 0, up\""},
      {"value=\"1 .5 2e3\"", "value=\"1 -.5 2e3\""},
      {"value=\"1 .5 2e3\"", "value=\"-1\""},
      {"x=\"1\"", "x=\"1e10\""},
      {"<float name=\"exponent\" value=\"8\"/>", "<integer name=\"exponent\" value=\"8\"/>"},
      {" id=\"m\"><float", "><float"},
      {"<ref id=\"m\"", "<ref id=\"n\""},
      {"<ref id=\"m\"/>", ""},
      {"<ref id=\"m\"/>", "<ref id=\"m\"/><ref id=\"m\"/><ref id=\"m\"/>"},
      {" type=\"sphere\"", ""},
      {" up=\"0,1,0\"", ""},
      {"<transform name=\"to_world\">", "<transform name=\"world\">"},
      {"version=\"1\"", "version=\"2\""},
      {"version=\"1\"", ""},
      {"version=\"1\"", "version=\"1\" xsi:type=\"scene\""},
      {kSensor, ""},
  };
  expect_refused(
      right, mistakes, [](const std::string& text) { return error_of(text) == "it was read"; },
      [&](const std::string& text) { return lint({example(text)}, "scene").exit_code == 0; });
}

TEST_F(XmlSchema, RefusesMistakesInAGrid) {
  const std::string right =
      "<grid version=\"1\" title=\"A\" ours=\"yes\"><scene file=\"../scenes/head_on.xml\"/>"
      "<film width=\"8\" height=\"8\"/><axis name=\"model\" values=\"phong_rdf, modified_phong\"/>"
      "<list><axis name=\"exponent\" values=\"8, 16\"/></list>"
      "<exclude model=\"phong_rdf\" exponent=\"8\"/><engine name=\"analytic\"/></grid>";
  const SchemaMistake mistakes[] = {
      {"<film ", "<flim "},
      {"<axis name=\"model\"", "<axis name=\"modell\""},
      {"width=\"8\"", "width=\"0\""},
      {"width=\"8\"", "width=\"8.5\""},
      {" height=\"8\"", ""},
      {" values=\"8, 16\"", ""},
      {"<axis name=\"exponent\" values=\"8, 16\"/>", ""},
      {"<exclude model", "<exclude modell"},
      {"ours=\"yes\"", "ours=\"maybe\""},
      {"file=\"../scenes", "name=\"../scenes"},
      {"<engine name=\"analytic\"/>", "<engine nam=\"analytic\"/>"},
      {"<engine name=\"analytic\"/>", "<film width=\"8\" height=\"8\"/>"},
      {"version=\"1\"", "version=\"2\""},
      {"version=\"1\"", ""},
  };
  expect_refused(
      right, mistakes, [&](const std::string& text) { return is_read(example(text), "grid"); },
      [&](const std::string& text) { return lint({example(text)}, "grid").exit_code == 0; });
}

TEST_F(XmlSchema, ARootMayNameItsSchemaAndMeansTheSame) {
  const std::string names =
      " xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xsi:noNamespaceSchemaLocation=\"scene.xsd\"";
  const auto named = [&](std::string text) { return text.insert(text.find(" version="), names); };
  const std::string plain = house::read(fs::path(kScenes) / "oblique_45.xml");
  const std::string file = example(named(plain));
  EXPECT_EQ(scene_to_xml(read_scene(file)), scene_to_xml(read_scene(kScenes + "oblique_45.xml")));
  const ProcessResult checked = lint({file}, "scene");
  EXPECT_EQ(checked.exit_code, 0) << checked.output_tail;
  EXPECT_THAT(error_of(scene("<shape type=\"sphere\"" + names + "/>")),
              testing::HasSubstr("<shape> has no attribute 'xmlns:xsi'"));

  const std::string grid =
      example(named("<grid version=\"1\"><scene file=\"../scenes/oblique_45.xml\"/>"
                    "<axis name=\"exponent\" values=\"16\"/><engine name=\"analytic\"/></grid>"));
  EXPECT_EQ(cells_of(read_grid(grid)).at(0).id, "n16");
  EXPECT_EQ(lint({grid}, "grid").exit_code, 0);
}

}  // namespace
}  // namespace lobelia
