// `lobelia export` as a user meets it.
#include "reference_scenes/engines/povray/povray_input.hpp"
#include "renderer/export/export.hpp"
#include "renderer/export/povray.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/reference_scenes/test_scenes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

class ExportCommand : public testing::Test {
 protected:
  std::string file(const char* name) { return read_file(scratch_.path() / name, 1 << 20); }
  ProcessResult run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "export");
    return run_lobelia(arguments, scratch_.path());
  }
  TemporaryDirectory scratch_;
};

TEST_F(ExportCommand, PrintsTheTextOrWritesItToAFile) {
  const ShaderExport request{*find_shader_language("hlsl"),
                             {*find_model("modified_phong"), *find_model("blinn_phong_rdf")},
                             *find_lobe("cs16"),
                             Normalisation::kPaper,
                             64};
  const std::string command =
      "export --language hlsl modified_phong blinn_phong_rdf --lobe cs16 --normalisation paper "
      "--exponent 64";
  ASSERT_EQ(run_shell("\"$LOBELIA\" " + command + " > printed", scratch_.path()).exit_code, 0);
  ASSERT_EQ(run_shell("\"$LOBELIA\" " + command + " -o written", scratch_.path()).exit_code, 0);
  EXPECT_EQ(file("printed"), shader_text(request));
  EXPECT_EQ(file("written"), shader_text(request));
  EXPECT_THAT(file("printed"), HasSubstr("//   lobelia " + command)) << "how to get it again";
}

TEST_F(ExportCommand, WritesHalfFloatsForGlslAndHlsl) {
  const std::string command =
      "export --language glsl modified_phong --lobe cs16 --normalisation exact "
      "--precision mediump";
  ASSERT_EQ(run_shell("\"$LOBELIA\" " + command + " > printed", scratch_.path()).exit_code, 0);
  EXPECT_THAT(file("printed"), HasSubstr("//   lobelia " + command + "\n"));
  EXPECT_THAT(file("printed"), HasSubstr("\nmediump float lobelia_modified_phong_cs16_mediump("));
  ASSERT_EQ(run({"--language", "hlsl", "--precision", "min16float", "modified_phong", "-o", "a"})
                .exit_code,
            0);
  EXPECT_THAT(file("a"), HasSubstr("\nmin16float lobelia_modified_phong_cosine_min16float("));
}

TEST_F(ExportCommand, WarnsOutsideThePapersExponents) {
  const auto exported = [&](const char* exponent) {
    return run({"--language", "glsl", "phong_rdf", "--lobe", "cs16", "--normalisation", "paper",
                "--exponent", exponent, "-o", "x.glsl"});
  };
  const ProcessResult outside = exported("2000");
  EXPECT_EQ(outside.exit_code, 0);
  EXPECT_THAT(outside.output_tail, HasSubstr("warning: exponent 2000: the paper gives"));
  EXPECT_THAT(file("x.glsl"), HasSubstr("given for n = 16 to 1024"));
  EXPECT_EQ(exported("64").output_tail, "");
}

TEST_F(ExportCommand, MatchesThePovRayReference) {
  const Scene scene =
      sphere_scene({"modified_phong", "gauss", "exact", 64}, {directional_at(45)}, 16);
  ASSERT_EQ(
      run({"--language", "povray", "modified_phong", "--lobe", "gauss", "-o", "a.inc"}).exit_code,
      0);
  EXPECT_EQ(povray_input(scene).includes.at("lobelia_modified_phong_gauss.inc"), file("a.inc"));
}

TEST_F(ExportCommand, RefusesTheUnknownWithExitCode2AndOneLine) {
  const auto expect_refusal = [&](std::vector<std::string> arguments, const char* said) {
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.output_tail, HasSubstr(said));
    EXPECT_EQ(std::count(result.output_tail.begin(), result.output_tail.end(), '\n'), 1);
  };
  expect_refusal({"--language", "gsl", "modified_phong"}, "did you mean 'glsl'?");
  expect_refusal({"--language", "glsl", "modified_fong"}, "did you mean 'modified_phong'?");
  expect_refusal({"--language", "glsl", "phong_rdf", "--lobe", "cs15"}, "even K from 2 to 1024");
  expect_refusal({"--language", "glsl", "phong_rdf", "--normalisation", "papre"},
                 "did you mean 'paper'?");
  expect_refusal({"--language", "glsl", "phong_rdf", "--exponent", "-1"}, "--exponent");
  expect_refusal({"--language", "glsl", "phong_rdf", "--lobe", "gauss"},
                 "'gauss' has no closed form; give the exponent that it is for: --exponent");
  expect_refusal({"--language", "wgsl", "phong_rdf", "--fresnel", "shlick"},
                 "did you mean 'schlick'?");
  expect_refusal({"--language", "wgsl", "phong_rdf", "--coefficient", "arguments"},
                 "did you mean 'argument'?");
  expect_refusal({"--language", "msl", "phong_rdf", "--coefficient", "argument", "--exponent", "2"},
                 "--coefficient argument");
  expect_refusal({"--language", "glsl"}, "MODEL");
  // POV-Ray does not have these.
  for (const auto& [option, value] : {std::pair{"--exponent", "64"},
                                      {"--fresnel", "schlick"},
                                      {"--coefficient", "argument"},
                                      {"--precision", "mediump"}})
    expect_refusal({"--language", "povray", "phong_rdf", option, value}, option);
  // Half floats where the language or the lobe has none.
  const auto expect_no_half = [&](std::vector<std::string> more, const char* said) {
    more.insert(more.begin(), {"phong_rdf", "--language"});
    expect_refusal(more, said);
  };
  expect_no_half({"hlsl", "--precision", "mediump"}, "not in HLSL");
  expect_no_half({"glsl", "--precision", "min16float"}, "mediump is GLSL's");
  for (const char* language : {"wgsl", "msl", "osl"})
    expect_no_half({language, "--precision", "mediump"}, "float32 alone");
  expect_no_half({"glsl", "--precision", "mediump", "--exponent", "1e5"}, "at most 65504");
  expect_no_half({"glsl", "--precision", "mediump", "--formula", "c^n"}, "a formula may not hold");
}

TEST_F(ExportCommand, LeavesNothingAndEndsWith4IfItCannotWrite) {
  EXPECT_EQ(run({"--language", "glsl", "phong_rdf", "-o", "nowhere/a.glsl"}).exit_code, 4);
  EXPECT_EQ(run({"--language", "glsl", "phong_rdf", "--lobe", "cs8", "--normalisation", "paper",
                 "-o", "a.glsl"})
                .exit_code,
            3);
  EXPECT_EQ(files_in(scratch_.path()), 0u);
}

}  // namespace
}  // namespace lobelia
