// Engines of the user's own in `lobelia farm`: programs that behave, programs that do not, and pictures that are there
// already.
#include "base/words/text.hpp"
#include "tests/json.hpp"
#include "tests/program/page_commands.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class OutsideEngines : public testing::Test {
 protected:
  fs::path path(const std::string& file) const { return directory_.path() / file; }
  /// A program that renders as Lobelia does, and then does `more`, in which $1 is the scene and $2 the picture.
  void script(const std::string& name, const std::string& more,
              const std::string& before = "") const {
    write_file(path(name), before + "\n" + shell_quote(LOBELIA_PROGRAM) +
                               " render \"$1\" --threads 1 -o \"$2\" || exit 9\n" + more + "\n");
  }
  void grid(const std::string& engines, const std::string& attributes = "") const {
    write_file(path("grid.xml"),
               "<grid version=\"1\" " + attributes + "><scene file=\"" + kScenes +
                   "head_on.xml\"/><film width=\"32\" height=\"32\"/><axis name=\"exponent\" "
                   "values=\"16, 32\"/>" +
                   engines + "</grid>");
  }
  ProcessResult farm(std::vector<std::string> more = {"--allow-commands"}) const {
    std::vector<std::string> arguments{"farm", "grid.xml", "-o", "out", "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_lobelia(arguments, directory_.path());
  }
  nlohmann::json cell(const std::string& id = "n16") const {
    return read_json(path("out/cells/" + id + "/cell.json"));
  }
  std::vector<std::string> images(const std::string& id = "n16") const {
    std::vector<std::string> names;
    const nlohmann::json record = cell(id);
    for (const auto& image : record["images"]) names.push_back(image["engine"]);
    return names;
  }
  TemporaryDirectory directory_;
};

constexpr char kMine[] =
    "<engine name=\"mine\" title=\"My renderer\" command=\"sh mine.sh {scene} {out} {exponent}\" "
    "version-command=\"echo mine 1.0\"/>";

TEST_F(OutsideEngines, IsAFullColumnOfTheFarmAndOfItsGallery) {
  script("mine.sh", "echo \"made n = $3\"");
  grid(kMine);
  const ProcessResult result = farm({"--allow-commands", "--gallery", "out"});
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(images("n32"), ElementsAre("lobelia", "mine"));
  EXPECT_EQ(cell()["status"], "pass");
  EXPECT_EQ(cell()["comparisons"][0]["a"], "lobelia");
  EXPECT_THAT(read_file(path("out/cells/n32/mine.log"), 1 << 20), HasSubstr("made n = 32"));
  const nlohmann::json engine = read_json(path("out/farm.json"))["engines"][1];
  EXPECT_EQ(engine["title"], "My renderer");
  EXPECT_EQ(engine["version"], "mine 1.0");
  EXPECT_THAT(read_file(path("out/index.html"), 1 << 24), HasSubstr("My renderer"));
  const auto again = farm();
  EXPECT_THAT(again.output_tail, HasSubstr("0 pictures rendered, 4 kept"));
}

TEST_F(OutsideEngines, IsMadeAgainWhenItsScriptItsCommandOrItsVersionChanges) {
  script("mine.sh", "");
  grid(kMine);
  ASSERT_EQ(farm().exit_code, 0);
  script("mine.sh", "# another script");
  EXPECT_THAT(farm().output_tail, HasSubstr("2 pictures rendered, 2 kept"));
  const std::string mine = kMine;
  grid(mine.substr(0, mine.find("{exponent}")) + "x" + mine.substr(mine.find("{exponent}") + 10));
  EXPECT_THAT(farm().output_tail, HasSubstr("2 pictures rendered, 2 kept"));
  grid(mine.substr(0, mine.find("1.0")) + "2.0" + mine.substr(mine.find("1.0") + 3));
  EXPECT_THAT(farm().output_tail, HasSubstr("2 pictures rendered, 2 kept"));
  grid(kMine);
  EXPECT_THAT(farm().output_tail, HasSubstr("0 pictures rendered, 4 kept"));
}

TEST_F(OutsideEngines, IsStartedOnlyWithPermission) {
  script("mine.sh", "");
  grid(
      "<engine name=\"mine\" command=\"sh mine.sh {scene} {out}\" "
      "version-command=\"touch started\"/>");
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--dry-run"}}) {
    const ProcessResult refused = farm(more);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.output_tail,
                AllOf(HasSubstr("touch started"), HasSubstr("sh mine.sh '{scene}' '{out}'"),
                      HasSubstr("--allow-commands")));
    EXPECT_EQ(std::ranges::count(refused.output_tail, '\n'), 1);
  }
  EXPECT_FALSE(fs::exists(path("out")));
  EXPECT_EQ(run_lobelia({"engines", "grid.xml"}, directory_.path()).exit_code, 2);
  grid("<engine name=\"mine\" command=\"sh mine.sh {scene} {out}\"/>");
  const std::string run = "\"$LOBELIA\" farm grid.xml -o out -q --dry-run";
  const auto in = [&](const std::string& folders) {
    return run_shell("LOBELIA_ALLOW_COMMANDS_IN=" + folders + " " + run, directory_.path())
        .exit_code;
  };
  EXPECT_EQ(in("/nowhere:\"$PWD\""), 0);
  EXPECT_THAT(run_shell("LOBELIA_ALLOW_COMMANDS_IN=/nowhere " + run, directory_.path()).output_tail,
              HasSubstr("warning: $LOBELIA_ALLOW_COMMANDS_IN: '/nowhere' gives no leave"));
  EXPECT_EQ(in("\"$PWD\"x:/nowhere:."), 2);
  // Leave for a folder does not reach a neighbour whose name begins like it. Only a folder that exists gives leave.
  for (const char* folder : {"near", "nearby"}) fs::create_directory(path(folder));
  fs::rename(path("grid.xml"), path("nearby/grid.xml"));
  const std::string run_nearby = " \"$LOBELIA\" farm nearby/grid.xml -o out -q --dry-run";
  for (const auto& [folder, code] : {std::pair{"nearby", 0}, {"near", 2}})
    EXPECT_EQ(run_shell("LOBELIA_ALLOW_COMMANDS_IN=\"$PWD\"/" + std::string(folder) + run_nearby,
                        directory_.path())
                  .exit_code,
              code)
        << folder;
}

TEST_F(OutsideEngines, StartOnlyIfEveryFileIsTrusted) {
  for (const char* folder : {"trusted/sub", "outside/deep"}) fs::create_directories(path(folder));
  const std::string engine = "<engine name=\"mine\" command=\"sh mine.sh {scene} {out}\"/>";
  for (const char* file : {"trusted/x.engine.xml", "outside/o.engine.xml"})
    write_file(path(file), engine);
  fs::create_directory_symlink("../../outside/deep", path("trusted/sub/ln"));
  fs::create_symlink("../outside/o.engine.xml", path("trusted/link.engine.xml"));
  const auto exit_code = [&](const std::string& engines, const std::string& folder) {
    grid(engines);
    fs::rename(path("grid.xml"), path(folder) / "grid.xml");
    return run_shell("LOBELIA_ALLOW_COMMANDS_IN=\"$PWD\"/trusted \"$LOBELIA\" engines " + folder +
                         "/grid.xml --models",
                     directory_.path())
        .exit_code;
  };
  EXPECT_EQ(exit_code("<engine file=\"x.engine.xml\"/>", "trusted"), 0);
  EXPECT_EQ(exit_code("<engine file=\"../trusted/x.engine.xml\"/>", "outside"), 2);
  EXPECT_EQ(exit_code("<engine file=\"../outside/o.engine.xml\"/>", "trusted"), 2);
  // The kernel follows the link first: it is outside/o.engine.xml.
  EXPECT_EQ(exit_code("<engine file=\"sub/ln/../o.engine.xml\"/>", "trusted"), 2);
  EXPECT_EQ(exit_code("<engine file=\"link.engine.xml\"/>", "trusted"), 2);
  EXPECT_EQ(exit_code(engine, "outside"), 2);
  fs::remove(path("trusted/grid.xml"));
  fs::create_symlink("../outside/grid.xml", path("trusted/linked.xml"));
  EXPECT_EQ(run_shell("LOBELIA_ALLOW_COMMANDS_IN=\"$PWD\"/trusted \"$LOBELIA\" engines "
                      "trusted/linked.xml --models",
                      directory_.path())
                .exit_code,
            2);
}

TEST_F(OutsideEngines, GetNoValueResemblingAnOption) {
  script("mine.sh", "");
  fs::copy_file(kScenes + "head_on.xml", path("--exec=evil.xml"));
  write_file(path("grid.xml"),
             "<grid version=\"1\"><scene file=\"" + kScenes +
                 "head_on.xml\"/><film width=\"32\" height=\"32\"/><axis name=\"light\" "
                 "values=\"--exec=evil.xml\"/><engine name=\"mine\" command=\"sh mine.sh {scene} "
                 "{out} {light}\"/></grid>");
  const ProcessResult result = farm();
  expect_one_line(result, 3,
                  "light '--exec=evil.xml': a program could take a value that begins "
                  "with '-' for an option");
  EXPECT_FALSE(fs::exists(path("out")));
}

TEST_F(OutsideEngines, HasItsPictureRefusedIfItIsTooLargeOrOfAnotherHeight) {
  script("large.sh", "truncate -s 40M more");
  script("low.sh", "", "sed 's/\\(.*\\)32/\\116/' \"$1\" > s.xml; set -- s.xml \"$2\"");
  write_file(path("fails.sh"), "echo no licence >&2; exit 3\n");
  script("good.sh", "");
  std::string engines;
  for (const std::string name : {"large", "low", "fails", "good"})
    engines += "<engine name=\"" + name + "\" command=\"sh " + name + ".sh {scene} {out}\"/>";
  grid(engines);
  EXPECT_EQ(farm({"--allow-commands", "--attempts", "1", "--disk", "20M"}).exit_code, 4);
  EXPECT_THAT(images(), ElementsAre("lobelia", "good"));
  std::map<std::string, std::string> failures;
  const nlohmann::json record = cell();
  for (const auto& problem : record["problems"]) failures[problem["engine"]] = problem["failure"];
  EXPECT_EQ(failures["large"], "disk limit");
  EXPECT_EQ(failures["low"], "wrong size");
  EXPECT_EQ(failures["fails"], "exit code");
  EXPECT_TRUE(fs::exists(path("out/failed/n16/reference-fails/again.sh")));
}

TEST_F(OutsideEngines, CanWriteNowhereElseAndLeavesNothingBehind) {
  script("mine.sh", "echo x > " + shell_quote(path("elsewhere").string()) +
                        "\n(setsid sleep 987.6 &) > /dev/null 2>&1");
  grid("<engine name=\"mine\" command=\"sh mine.sh {scene} {out}\"/>");
  EXPECT_NE(farm().exit_code, 5);
  const bool is_limited = read_json(path("out/cells/n16/mine.json")).value("writesLimited", false);
  EXPECT_NE(fs::exists(path("elsewhere")), is_limited);
  EXPECT_NE(
      run_shell("grep -qsa 'sleep.987[.]6' /proc/[0-9]*/cmdline", directory_.path()).exit_code, 0);
}

TEST_F(OutsideEngines, GetsNamedVariablesOnly) {
  script("mine.sh", "echo \"<$HELLO|$SECRET>\"");
  grid("<engine name=\"mine\" command=\"sh mine.sh {scene} {out}\" environment=\"HELLO\"/>");
  const auto run = [&](const std::string& hello) {
    return run_shell(
               "HELLO=" + hello + " SECRET=x \"$LOBELIA\" farm grid.xml -o out -q --allow-commands",
               directory_.path())
        .output_tail;
  };
  EXPECT_THAT(run("a"), HasSubstr("4 pictures rendered"));
  EXPECT_THAT(read_file(path("out/cells/n16/mine.log"), 1 << 20), HasSubstr("<a|>"));
  EXPECT_THAT(run("a"), HasSubstr("0 pictures rendered"));
  EXPECT_THAT(run("b"), HasSubstr("2 pictures rendered"));
}

TEST_F(OutsideEngines, SaysWhichScenesItCannotShow) {
  script("mine.sh", "");
  // Copied, as the scenes of an axis are separated by blanks, and the path of the project may have some.
  for (const std::string name : {"head_on.xml", "two_spheres.xml"})
    fs::copy_file(kScenes + name, path(name));
  write_file(
      path("grid.xml"),
      "<grid version=\"1\"><axis name=\"scene\" values=\"head_on.xml, two_spheres.xml\"/>"
      "<film width=\"32\" height=\"32\"/>"
      "<engine name=\"mine\" command=\"sh mine.sh {scene} {out}\" effects=\"fresnel\"/></grid>");
  EXPECT_EQ(farm().exit_code, 0);
  EXPECT_THAT(images("head_on"), ElementsAre("lobelia", "mine"));
  EXPECT_THAT(images("two_spheres"), ElementsAre("lobelia"));
  EXPECT_THAT(cell("two_spheres")["notComparable"][0]["because"].get<std::string>(),
              HasSubstr("calls for"));
}

TEST_F(OutsideEngines, ShowsExistingPicturesOnly) {
  fs::create_directory(path("renders"));
  ASSERT_EQ(run_lobelia({"render", kScenes + "head_on.xml", "--width", "32", "--height", "32",
                         "--exponent", "16", "-o", "renders/studio_16.exr"},
                        directory_.path())
                .exit_code,
            0);
  grid("<pictures name=\"studio\" title=\"Studio\" files=\"renders/studio_{exponent}.exr\"/>");
  EXPECT_EQ(farm({}).exit_code, 0);
  EXPECT_THAT(images("n16"), ElementsAre("lobelia", "studio"));
  EXPECT_EQ(cell("n16")["status"], "pass");
  EXPECT_THAT(images("n32"), ElementsAre("lobelia"));
  EXPECT_EQ(cell("n32")["notComparable"][0]["because"], "missing: renders/studio_32.exr");
  // A new picture under the name is another result.
  fs::copy_file(path("renders/studio_16.exr"), path("renders/studio_32.exr"));
  EXPECT_EQ(farm({}).exit_code, 1);
  EXPECT_EQ(cell("n32")["status"], "differs");
}

TEST_F(OutsideEngines, APictureOutsideOfTheGridsFolderIsReadOnlyWithLeave) {
  const TemporaryDirectory secret;
  const std::string file = (secret.path() / "x.exr").string();
  ASSERT_EQ(run_lobelia({"render", kScenes + "head_on.xml", "--width", "32", "--height", "32",
                         "--exponent", "16", "-o", file},
                        directory_.path())
                .exit_code,
            0);
  fs::create_symlink(file, path("link.exr"));
  const std::string beside = "../" + secret.path().filename().string() + "/x.exr";
  for (const std::string& name : {file, beside, std::string("link.exr")}) {
    grid("<pictures name=\"studio\" files=\"" + name + "\"/>");
    const ProcessResult refused = farm({});
    expect_one_line(refused, 2, "read '" + name + "' for engine studio");
    EXPECT_THAT(refused.output_tail, HasSubstr("--allow-commands"));
    EXPECT_FALSE(fs::exists(path("out"))) << name;
  }
  EXPECT_EQ(farm().exit_code, 1) << "the cell of another exponent differs";
  EXPECT_THAT(images("n16"), ElementsAre("lobelia", "studio"));
}

TEST_F(OutsideEngines, MayBeTheReferenceWithoutOurPicture) {
  script("one.sh", "");
  script("two.sh", "");
  const std::string both =
      "<engine name=\"one\" command=\"sh one.sh {scene} {out}\" tolerance=\"0,1e-5\"/>"
      "<engine name=\"two\" command=\"sh two.sh {scene} {out}\" tolerance=\"0,1e-5\"/>"
      "<engine name=\"analytic\"/>";
  grid(both, "reference=\"two\" ours=\"no\"");
  const ProcessResult result = farm({"--allow-commands", "--gallery", "out"});
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(images(), ElementsAre("one", "two", "analytic"));
  std::vector<std::string> compared;
  const nlohmann::json record = cell();
  for (const auto& one : record["comparisons"])
    compared.push_back(one["a"].get<std::string>() + " " + one["b"].get<std::string>());
  EXPECT_THAT(compared, ElementsAre("one two", "analytic two"));
  EXPECT_EQ(read_json(path("out/cells/n16/one-two.json"))["metrics"]["max_abs"], 0.0);
  grid(both, "reference=\"analytic\"");
  EXPECT_EQ(farm().exit_code, 0);
  EXPECT_THAT(images(), ElementsAre("lobelia", "one", "two", "analytic"));
  EXPECT_FALSE(fs::exists(path("out/cells/n16/one-two.json"))) << "it is of the grid before";
}

TEST_F(OutsideEngines, IsListedWithItsVersionAndState) {
  script("mine.sh", "");
  grid(kMine);
  write_file(path("gone.engine.xml"),
             "<engine name=\"gone\" command=\"no_such_program {scene} {out}\"/>");
  const ProcessResult result = run_lobelia(
      {"engines", "grid.xml", "gone.engine.xml", "--allow-commands"}, directory_.path());
  EXPECT_EQ(result.exit_code, 5);
  EXPECT_THAT(result.output_tail, AllOf(HasSubstr("My renderer"), HasSubstr("mine 1.0"),
                                        HasSubstr("no program 'no_such_program'")));
}

TEST_F(OutsideEngines, IsRefusedWithTheLineOfAWrongDescription) {
  const std::pair<const char*, const char*> cases[] = {
      {"<engine name=\"povray\" command=\"x {out}\"/>", "the name 'povray' is taken"},
      {"<engine name=\"profile\" command=\"x {out}\"/>", "the name 'profile' is taken"},
      {"<engine name=\"../x\" command=\"x {out}\"/>", "allowed: up to 32 small letters"},
      {"<engine name=\"x\" command=\"\"/>", "the command is empty"},
      {"<engine name=\"x\" command=\"x {scene}\"/>", "the command has no {out}"},
      {"<engine name=\"x\" command=\"x {out} {colour}\"/>",
       "{colour} is neither a place nor an axis"},
      {"<engine name=\"x\" command=\"x {out} {\"/>", "has a brace without its other"},
      {"<engine name=\"x\" command=\"x {out} 'a\"/>", "the quotation mark ' is not closed"},
      {"<engine name=\"x\" command=\"x {out} | tee log\"/>", "'|' means something to a shell"},
      {"<engine name=\"x\" command=\"x {out}\" effects=\"shadow\"/>", "did you mean 'shadows'?"},
      {"<engine name=\"x\" command=\"x {out}\" tolerance=\"nan,0\"/>", "expected a share"},
      {"<engine name=\"x\" command=\"x {out}\" environment=\"A=B\"/>",
       "no name of an environment variable"},
      {"<engine name=\"x\" command=\"x {out}\" colour=\"red\"/>", "colour"},
      {"<engine name=\"x\" command=\"x {out}\"/><engine name=\"x\" command=\"x {out}\"/>",
       "a second engine 'x'"},
      {"<engine file=\"none.engine.xml\"/>", "none.engine.xml"},
      {"<pictures name=\"x\"/>", "files"},
      {"<pictures name=\"x\" files=\"{scene}.exr\"/>", "{scene} is neither"},
  };
  for (const auto& [engines, why] : cases) {
    grid(engines);
    const ProcessResult result = farm();
    EXPECT_EQ(result.exit_code, 3) << engines;
    EXPECT_THAT(result.output_tail, AllOf(HasSubstr("grid.xml:1:"), HasSubstr(why))) << engines;
  }
  grid("", "ours=\"no\"");
  EXPECT_THAT(farm().output_tail, HasSubstr("needs a reference"));
  grid("", "reference=\"nobody\"");
  EXPECT_THAT(farm().output_tail, HasSubstr("allowed: an engine of this grid"));
}

TEST_F(OutsideEngines, BecomesAColumnByTheCommandsOfTheTutorial) {
  if (find_program("python3").empty()) {
    ASSERT_FALSE(std::getenv("LOBELIA_REQUIRE_ENGINES")) << "no python3";
    GTEST_SKIP() << "no python3";
  }
  const std::string commands = page_commands("docs/own_engine.md");
  EXPECT_GE(std::ranges::count(commands, '\n'), 6);
  const ProcessResult result = run_commands(
      commands, directory_.path(),
      "lobelia() { code=0; \"$LOBELIA\" \"$@\" < /dev/null || code=$?; [ $code = 5 ] || return $code; }\n");
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  std::size_t cells = 0;
  for (const auto& entry : fs::directory_iterator(path("out/own/cells"))) {
    const nlohmann::json comparison = read_json(entry.path() / "lobelia-sphere.json");
    EXPECT_EQ(comparison["verdict"], "pass") << entry.path();
    EXPECT_LT(comparison["metrics"]["max_rel_peak"], 1e-6) << entry.path();
    ++cells;
  }
  EXPECT_EQ(cells, 6u);
  EXPECT_THAT(read_file(path("out/own/index.html"), 1 << 24), HasSubstr("sphere.py"));
}

}  // namespace
}  // namespace lobelia
