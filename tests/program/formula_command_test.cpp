// A lobe by its formula, as a user tries one.
#include "tests/program/page_commands.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class TryALobe : public testing::Test {
 protected:
  ProcessResult run(const std::string& arguments) {
    return run_shell("\"$LOBELIA\" " + arguments, directory_.path());
  }
  std::string text(const std::string& file) { return read_file(directory_.path() / file, 1 << 24); }
  const TemporaryDirectory directory_;
};

TEST_F(TryALobe, RunsByTheCommandsOfThePage) {
  const std::string commands = page_commands("docs/scene_format.md", "## Try a lobe");
  ASSERT_THAT(commands, HasSubstr("lobelia render"));
  const auto result = run_commands(commands, directory_.path());
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(text("idea.glsl"), HasSubstr("--formula"));
}

TEST_F(TryALobe, IsPlannedAndListedAsSlowAndDouble) {
  const auto plan = run("plan \"$SCENES\"oblique_45.xml --formula '1/(1 + n*s)^2'");
  EXPECT_EQ(plan.exit_code, 0);
  EXPECT_THAT(plan.output_tail, HasSubstr("float64"));
  EXPECT_THAT(plan.output_tail, HasSubstr("slow: a lobe is a formula"));
  const auto models = run("models --exponent 20 --formula '1/(1 + n*s)^2'");
  EXPECT_EQ(models.exit_code, 0);
  const auto formulas =
      run("models --exponent 20 --formula '1/(1 + n*s)^2' | head -n 30 | tail -n 12");
  EXPECT_THAT(formulas.output_tail, HasSubstr("1 / (1 + n * s)^2"));
  EXPECT_THAT(models.output_tail, HasSubstr("modified_phong            expression          exact"));
}

TEST_F(TryALobe, VariesInAGrid) {
  write_file(directory_.path() / "s.xml", read_file(kScenes + "oblique_45.xml", 1 << 20));
  write_file(
      directory_.path() / "g.xml",
      std::string(
          "<grid version=\"1\" title=\"t\"><scene file=\"s.xml\"/><film width=\"32\" height=\"32\"/>"
          "<axis name=\"lobe\" values=\"cs16, expression:max(0, 1 - n*s/16)^16,"
          " expression:1/(1 + n*s)\"/><engine name=\"analytic\"/></grid>"));
  const auto result = run("farm g.xml -o out --gallery out");
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, HasSubstr("3 cells: 0 failed, 0 differ"));
}

TEST_F(TryALobe, LocatesAMistakeInOneLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"--formula '1 - (s'", "--formula, column 7: the formula ends before a ')'"},
      {"--formula '1 - m'", "--formula, column 5: unknown name 'm'"},
      {"--formula '1 + s'", "the formula 1 + s is no lobe"},
      {"--formula 'c^n' --lobe cs16", "--formula is for --lobe expression, not for 'cs16'"},
      {"--lobe expression", "--lobe expression needs a --formula"},
      {"--lobe expresion", "--lobe 'expresion' is unknown"},
  };
  for (const auto& [options, message] : cases) {
    SCOPED_TRACE(options);
    expect_one_line(run(std::string("render \"$SCENES\"oblique_45.xml -o no.exr ") + options), 2,
                    message);
  }
  EXPECT_EQ(files_in(directory_.path()), 0);
  const auto paper =
      run("render \"$SCENES\"oblique_45.xml -o no.exr --formula 'c^n' --normalisation paper");
  EXPECT_EQ(paper.exit_code, 3);
  EXPECT_THAT(paper.output_tail,
              HasSubstr("the paper gives no coefficient for the lobe 'expression'"));
}

}  // namespace
}  // namespace lobelia
