// Adds a throw-away lobe, model, metric, light, effect, engine, view and command to a copy of the tree, by exactly the
// files that CONTRIBUTING.md names, builds it and sees each of them work. What is added is a copy of a neighbour under
// another name, so that this test need not know the interfaces.
#include <regex>

#include "lobelia_paths.hpp"
#include "tests/house/tree.hpp"
#include "tests/test.hpp"

namespace house {
namespace {

/// Text in place of text, in a file that is copied or in one that gets a line more.
using Renames = std::vector<std::pair<std::string, std::string>>;

std::string renamed(std::string text, const Renames& renames) {
  for (const auto& [from, to] : renames) {
    std::size_t at = 0;
    while ((at = text.find(from, at)) != text.npos) {
      text.replace(at, from.size(), to);
      at += to.size();
    }
  }
  return text;
}

/// A copied file; NAME in CONTRIBUTING.md stands for the added one.
struct Copy {
  std::string from, to;
  Renames renames;
};

/// Puts `more` behind a text of a file, which CONTRIBUTING.md may name as one of many.
struct Insertion {
  std::string file, after, more, named = {};
};

/// One thing more in a copy of the tree.
struct Addition {
  std::string what;
  std::vector<Copy> copies;
  std::vector<Insertion> insertions;
};

/// The files of the row in CONTRIBUTING.md, "| a lobe | `...`, `...` |".
std::set<std::string> documented(const fs::path& tree, const std::string& what) {
  std::set<std::string> named;
  for (const std::string& line : lines(read(tree / "CONTRIBUTING.md"))) {
    if (!line.starts_with("| " + what + " |")) continue;
    static const std::regex span("`([^`]+)`");
    for (std::sregex_iterator it(line.begin(), line.end(), span), end; it != end; ++it)
      named.insert((*it)[1]);
  }
  return named;
}

void add(const fs::path& tree, const Addition& addition) {
  std::set<std::string> files;
  for (const Copy& copy : addition.copies) {
    const std::string to = renamed(copy.to, {{"NAME", "throwaway"}});
    ASSERT_FALSE(fs::exists(tree / to)) << to;
    write(tree / to, renamed(read(tree / copy.from), copy.renames));
    files.insert(copy.to);
  }
  for (const auto& [file, after, more, named] : addition.insertions) {
    std::string text = read(tree / file);
    const std::size_t at = text.find(after);
    ASSERT_NE(at, text.npos) << file << ": " << after;
    text.insert(at + after.size(), more);
    write(tree / file, text);
    files.insert(named.empty() ? file : named);
  }
  EXPECT_EQ(files, documented(tree, addition.what)) << addition.what;
}

const Renames kLobe{{"schlick", "throwaway"}, {"Schlick", "Throwaway"}, {"SCHLICK", "THROWAWAY"}};
const Renames kModel{{"modified_phong", "throwaway"},
                     {"ModifiedPhong", "Throwaway"},
                     {"Modified_Phong", "Throwaway"},
                     {"MODIFIED_PHONG", "THROWAWAY"}};
const Renames kEngine{{"engines/analytic/analytic.hpp", "engines/throwaway/throwaway.hpp"},
                      {"Analytic", "Throwaway"},
                      {"analytic_", "throwaway_"},
                      {"make_analytic", "make_throwaway"},
                      {"\"analytic", "\"throwaway"},
                      {"'analytic'", "'throwaway'"}};
const std::string kFormulas = "reference_scenes/engines/blender/blender_formulas.py";
const std::string kEngines = "reference_scenes/engines/";

const std::vector<Addition> kAdditions{
    {"a lobe",
     {{"renderer/lobes/schlick.hpp", "renderer/lobes/NAME.hpp", kLobe},
      {"renderer/export/povray/lobes/schlick.inc", "renderer/export/povray/lobes/NAME.inc", kLobe}},
     {{"renderer/lobes/catalogue.hpp", "schlick.hpp\"\n",
       "#include \"renderer/lobes/throwaway.hpp\"\n"},
      {"renderer/lobes/catalogue.hpp", "SchlickLobe", ", ThrowawayLobe"},
      {kFormulas, "LOBES = {\n",
       "    \"throwaway\": Lobe(lambda s, n, k: (1 - s) / (1 - s + n * s),\n"
       "                      lambda nodes, s, n, k: schlick_node(nodes, s, n),\n"
       "                      lambda n, k: 1.0),\n"}}},
    {"a model",
     {{"renderer/models/modified_phong.hpp", "renderer/models/NAME.hpp", kModel},
      {"renderer/export/povray/models/modified_phong.inc", "renderer/export/povray/models/NAME.inc",
       kModel}},
     {{"renderer/models/catalogue.hpp", "modified_phong.hpp\"\n",
       "#include \"renderer/models/throwaway.hpp\"\n"},
      {"renderer/models/catalogue.hpp", "TypeList<PhongRdf, ModifiedPhong", ", Throwaway"},
      {kFormulas, "MODELS = {\n",
       "    \"throwaway\": Model(False, False, 1.0, True, 1,\n"
       "                       lambda n, tail: (n + 2) / (2 * math.pi),\n"
       "                       lambda n: (1.063 * n + 1) / (2 * math.pi)),\n"},
      {"reference_scenes/engines/analytic/formulas/highlight.cpp", "kRows[] = {\n",
       "    {\"throwaway\", kR, true, false, true, 1},\n"}}},
    {"a metric",
     {{"compare/metrics/relmse.cpp",
       "compare/metrics/NAME.cpp",
       {{"relmse", "throwaway"}, {"Relmse", "Throwaway"}}}},
     {{"compare/metrics/catalogue.cpp", "#define LOBELIA_METRICS(METRIC) ", "METRIC(throwaway) "}}},
    {"a light",
     {{"renderer/scene/lights/constant.hpp",
       "renderer/scene/lights/NAME.hpp",
       {{"\"constant\"", "\"throwaway\""},
        {"ConstantLight", "ThrowawayLight"},
        {"_CONSTANT_", "_THROWAWAY_"}}}},
     {{"renderer/scene/lights/catalogue.hpp", "sphere.hpp\"\n",
       "#include \"renderer/scene/lights/throwaway.hpp\"\n"},
      {"renderer/scene/lights/catalogue.hpp", "ConstantLight", ", ThrowawayLight"}}},
    {"an effect of light",
     {{"renderer/plan/effects/ground.hpp",
       "renderer/plan/effects/NAME.hpp",
       {{"struct Ground", "struct Throwaway"}, {"\"ground\"", "\"throwaway\""}}}},
     {{"renderer/plan/effects/catalogue.hpp", "shadows.hpp\"\n",
       "#include \"renderer/plan/effects/throwaway.hpp\"\n"},
      {"renderer/plan/effects/catalogue.hpp", "effects::Ground", ", effects::Throwaway"},
      // One of the files there has its effect on rays.
      {"renderer/waves/surfaces.cpp", "static constexpr Sphere kAnySphere{};\n",
       "  if (prepared.plan.on<effects::Throwaway>())\n"
       "    work.work.of<effects::Throwaway>() += wave.count;\n",
       "renderer/waves/"}}},
    {"an engine",
     {{kEngines + "analytic/analytic.hpp", kEngines + "NAME/NAME.hpp", kEngine},
      {kEngines + "analytic/analytic.cpp", kEngines + "NAME/NAME.cpp", kEngine}},
     {{kEngines + "catalogue.cpp", "analytic.hpp\"\n",
       "#include \"reference_scenes/engines/throwaway/throwaway.hpp\"\n"},
      {kEngines + "catalogue.cpp", "keep_analytic_input},\n",
       "    {kThrowawayInfo, make_throwaway, keep_throwaway_input},\n"}}},
    {"a command",
     {{"program/command/scene_format.cpp",
       "program/command/NAME.cpp",
       {{"add_scene_format", "add_throwaway"}, {"\"scene-format\"", "\"throwaway\""}}}},
     {{"program/command/commands.hpp", "command(scene_format)", " command(throwaway)"}}},
    {"a view of the gallery",
     {{"gallery/pages/paper_page.cpp",
       "gallery/pages/NAME_page.cpp",
       {{"paper_view", "throwaway_view"},
        {"paper_page", "throwaway_page"},
        {"\"paper\", \"Paper\", \"paper.html\"",
         "\"throwaway\", \"Throwaway\", \"throwaway.html\""}}},
      {"gallery/web/src/views/paper.ts",
       "gallery/web/src/views/NAME.ts",
       {{"function paper(", "function throwaway("}}}},
     {{"gallery/pages/views.cpp", "VIEW(paper)", " VIEW(throwaway)"}}},
};

class Adding : public testing::Test {
 protected:
  void SetUp() override {
    for (const fs::path& file : project_files(kRoot)) {
      if (*file.begin() == "tests" || *file.begin() == "docs") continue;
      fs::create_directories((tree / file).parent_path());
      fs::copy(kRoot / file, tree / file);
    }
  }
  /// Not optimised, without debug information, several files as one, and for a single instruction set: as quick as it gets.
  void build() {
    const std::string at = quoted(tree.path());
    const Ran made =
        run("cd " + at + " && export CCACHE_BASEDIR=" + at +
            " CCACHE_NOHASHDIR=1 && cmake -G Ninja -S . -B build -DCMAKE_BUILD_TYPE=None "
            "-DCMAKE_CXX_FLAGS=-O0 -DLOBELIA_LEFT_OUT='(HWY_SSE4|HWY_AVX2|HWY_AVX3|HWY_AVX3_DL)' "
            "-DLOBELIA_UNITY=ON -DLOBELIA_TESTS=OFF -DLOBELIA_BENCH=OFF && "
            "cmake --build build --target lobelia lobelia_image_io");
    ASSERT_EQ(made.exit_code, 0) << made.output.substr(
        made.output.size() - std::min<std::size_t>(made.output.size(), 4000));
  }
  Ran lobelia(const std::string& arguments) {
    return run("cd " + quoted(tree.path()) + " && build/bin/lobelia " + arguments);
  }
  void expect_output(const std::string& arguments, const std::string& part) {
    const Ran ran = lobelia(arguments);
    EXPECT_EQ(ran.exit_code, 0) << arguments << "\n" << ran.output;
    EXPECT_THAT(ran.output, HasSubstr(part)) << arguments;
  }

  Scratch tree;
};

TEST_F(Adding, OneOfEachTakesTheFilesListedInContributing) {
  for (const Addition& addition : kAdditions) add(tree.path(), addition);
  if (HasFailure()) return;
  build();
  if (HasFatalFailure()) return;

  const std::string scene = "reference_scenes/scenes/head_on.xml ";
  const std::string small = scene + "--width 32 --height 32 --exponent 20 ";
  expect_output("models", "throwaway");
  // By our own kernels and by the formulas, which know the lobe and the model in their own words.
  for (const std::string which : {"--lobe throwaway ", "--model throwaway "}) {
    expect_output("render " + small + which + "-o ours.exr", "ours.exr");
    expect_output("reference " + small + which + "--engine analytic -o formulas.exr",
                  "formulas.exr");
    expect_output("compare ours.exr formulas.exr --fail max_rel_peak=1e-5", "throwaway");
    expect_output("reference " + small + which + "--engine throwaway -o engine.exr", "engine.exr");
    expect_output("compare formulas.exr engine.exr --fail max_abs=0", "throwaway");
    // Where the programs are here, they have been told it right.
    for (const std::string engine : {"povray", "blender"}) {
      const Ran ran =
          lobelia("reference " + small + which + "--engine " + engine + " -o " + engine + ".exr");
      if (ran.exit_code == 5) continue;
      EXPECT_EQ(ran.exit_code, 0) << ran.output;
      expect_output("compare " + engine + ".exr formulas.exr --fail max_rel_peak=1e-3",
                    "throwaway");
    }
  }
  expect_output("export --language povray modified_phong --lobe throwaway",
                "Lobelia_Throwaway_Lobe");
  expect_output("export --language povray throwaway", "Lobelia_Throwaway_S");
  expect_output("compare --list-metrics", "throwaway.eps=0.01");
  // Some of them need what was not built here.
  EXPECT_THAT(lobelia("engines").output, HasSubstr("(--engine throwaway)"));
  expect_output("throwaway", "<emitter type=\"throwaway\">");
  write(
      tree / "lit.xml",
      renamed(
          read(tree / "reference_scenes/scenes/head_on.xml"),
          {{"</scene>",
            "<emitter type=\"throwaway\"><rgb name=\"radiance\" value=\"1\"/></emitter></scene>"}}));
  expect_output("plan lit.xml", "throwaway");
  expect_output("render lit.xml --width 32 --height 32 --samples 16 -o lit.exr", "lit.exr");
  EXPECT_EQ(lobelia("compare lit.exr ours.exr").exit_code, 1) << "the light shines";

  // The view's record is none, which its page says.
  write(tree / "grid.xml",
        "<grid version=\"1\" title=\"One\"><scene file=\"reference_scenes/scenes/head_on.xml\"/>"
        "<film width=\"16\" height=\"16\"/><axis name=\"exponent\" values=\"16\"/></grid>");
  expect_output("farm grid.xml -o out", "1 cells: 0 failed");
  write(tree / "out/paper/paper.json", "{}");
  lobelia("gallery out");
  EXPECT_THAT(read(tree / "out/throwaway.html"), HasSubstr("paper/paper.json"));
  EXPECT_THAT(read(tree / "out/index.html"), HasSubstr("throwaway.html"));
}

}  // namespace
}  // namespace house
