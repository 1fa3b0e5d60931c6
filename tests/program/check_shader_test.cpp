// lobelia check-shader as a user runs it, and its page in docs/.
#include <fmt/format.h>

#include "base/records/bsdf_check.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/explain.hpp"
#include "studies/shader_check/mistakes_document.hpp"
#include "tests/json.hpp"
#include "tests/program/run_lobelia.hpp"
#include "tests/shaders/shader_runner.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// Only a hang takes so long.
constexpr char kHang[] = "--time-limit=3600";

std::string tutorial() {
  return read_file(std::string(LOBELIA_SOURCE_DIR) + "/docs/check_shader.md", 1 << 20);
}

/// The first block between ``` lines that begins with `beginning`, without its first line.
std::string block_of(const std::string& page, const std::string& beginning) {
  const std::size_t begin = page.find("```" + beginning);
  const std::size_t text = page.find('\n', begin + 3 + beginning.size()) + 1;
  return page.substr(text, page.find("```", text) - text);
}

class CheckShaderCommand : public NeedsShaderRunner {
 protected:
  ProcessResult check(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "check-shader");
    return run_lobelia(arguments, directory_.path());
  }
  void write(const std::string& file, const std::string& text) const {
    write_file(directory_.path() / file, text);
  }
  const TemporaryDirectory directory_;
};

TEST_F(CheckShaderCommand, PrintsTheOutputOfTheTutorial) {
  const std::string page = tutorial(), shader = block_of(page, "glsl");
  write("mine.glsl", shader);
  const ProcessResult result =
      check({"mine.glsl", "--function", "myHighlight", "--model", "blinn_phong_ndf", kHang});
  EXPECT_EQ(result.exit_code, 1);
  // Values of another device, and times, differ.
  const bool same_device = result.output_tail.find("llvmpipe (LLVM 15") != std::string::npos;
  int lines = 0;
  for (const std::string& line : split(block_of(page, "\n$ lobelia check-shader"), "\n")) {
    if (line == "..." ||
        (!same_device && !line.starts_with("differs:") && !line.starts_with("mistakes:")))
      continue;
    EXPECT_THAT(result.output_tail, HasSubstr(line));
    ++lines;
  }
  EXPECT_GE(lines, 2);
  std::string right = shader;
  right.replace(right.find("(2.0 *"), 4, "(8.0");
  write("mine.glsl", right);
  const ProcessResult passes =
      check({"mine.glsl", "--function", "myHighlight", "--model", "blinn_phong_ndf", "--no-costs"});
  EXPECT_EQ(passes.exit_code, 0) << passes.output_tail;
  EXPECT_THAT(passes.output_tail,
              HasSubstr("\npasses: it is the model within the rounding of float32\n"));
}

TEST_F(CheckShaderCommand, WritesARecordAndAPage) {
  write("mine.hlsl",
        "float spec(float c, float n) { return (n + 1.0) / 6.2831853 * pow(max(c, 0.0), n); }\n");
  const ProcessResult result =
      check({"mine.hlsl", "--function", "spec", "--arguments", "cosine,n", "--model", "phong_rdf",
             "--exponent", "8,128", "--json", "r.json", "--html", "r.html", "--no-costs"});
  // The function does not know the light.
  EXPECT_EQ(result.exit_code, 1) << result.output_tail;
  const Json record = Json::parse(read_file(directory_.path() / "r.json", 1 << 20));
  EXPECT_EQ(record["kind"], "shader-check");
  EXPECT_EQ(record["api"], "vulkan");
  EXPECT_EQ(record["explanation"]["mistakes"], Json::parse(R"(["light-behind"])"));
  EXPECT_EQ(record["errors"].size(), 2u);
  EXPECT_THAT(record["device"].get<std::string>(), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(read_file(directory_.path() / "r.html", 1 << 22), HasSubstr("light leaks"));
}

TEST_F(CheckShaderCommand, PassesAnExportWithItsOwnCoefficient) {
  // Only the integral of modified Blinn-Phong has the moments m2 and m3. At n = 30 half of m2 is 0.6 % of it, far
  // more than is allowed; at n = 300 it is less.
  for (const char* model : {"modified_phong", "modified_blinn_phong"}) {
    ASSERT_EQ(
        run_lobelia({"export", "--language", "glsl", "--lobe", "cs16", model, "-o", "ours.glsl"},
                    directory_.path())
            .exit_code,
        0);
    const ProcessResult result =
        check({"ours.glsl", "--function", std::string("lobelia_") + model + "_cs16", "--model",
               model, "--lobe", "cs16", "--exponent", "4,30,300", "--no-costs"});
    EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  }
}

TEST_F(CheckShaderCommand, AShaderMayDiscardNoCallWhereTheModelHasLight) {
  const auto exit_code = [&](const char* first) {
    write("mine.glsl", std::string("float f(float c, float l, float n)\n{\n") + first +
                           "    if (l <= 0.0 || c <= 0.0) return 0.0;\n"
                           "    return (n + 1.0) / 6.28318531 * pow(c, n);\n}\n");
    return check({"mine.glsl", "--function", "f", "--arguments", "cosine,N.L,n", "--model",
                  "phong_rdf", "--exponent", "16", "--no-costs"})
        .exit_code;
  };
  EXPECT_EQ(exit_code(""), 0);
  EXPECT_EQ(exit_code("    if (c < 0.0) discard;\n"), 0);
  EXPECT_EQ(exit_code("    if (c < 0.9) discard;\n"), 1);
}

TEST_F(NeedsWebGpu, WgslIsCheckedInABrowser) {
  const TemporaryDirectory directory;
  const auto run = [&](std::vector<std::string> arguments) {
    return run_lobelia(std::move(arguments), directory.path());
  };
  ASSERT_EQ(run({"export", "--language", "wgsl", "phong_rdf", "-o", "ours.wgsl"}).exit_code, 0);
  const ProcessResult result = run({"check-shader", "ours.wgsl", "--function",
                                    "lobelia_phong_rdf_cosine", "--model", "phong_rdf", kHang});
  EXPECT_EQ(result.exit_code, 0) << result.output_tail;
  EXPECT_THAT(result.output_tail, HasSubstr("passes: "));
  write_file(directory.path() / "bad.wgsl", "fn f(N: vec3f) -> f32 {\n  return M;\n}\n");
  const ProcessResult bad = run(
      {"check-shader", "bad.wgsl", "--function", "f", "--arguments", "N", "--model", "phong_rdf"});
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_THAT(bad.output_tail, HasSubstr("bad.wgsl:2: unresolved value 'M'"));
}

TEST_F(NeedsWebGpu, KeepsAShaderFromForgingResults) {
  const TemporaryDirectory directory;
  // Chromium warns of code behind a return, and quotes it.
  write_file(directory.path() / "forged.wgsl",
             "fn f(n: f32) -> f32\n{\n    return n;\n"
             "    var a = 1.0; /* \"lobelia device SEFDS0VE\", source: x */\n}\n");
  const ProcessResult result = run_shell(
      "mkdir tmp home; export TMPDIR=\"$PWD/tmp\" HOME=\"$PWD/home\"\n"
      "\"$LOBELIA\" check-shader forged.wgsl --function f --arguments n --model phong_rdf "
      "--no-costs --time-limit 3600; find tmp home -mindepth 1",
      directory.path());
  EXPECT_THAT(result.output_tail, HasSubstr("\ndiffers: "));
  EXPECT_THAT(result.output_tail, testing::Not(HasSubstr("HACKED")));
  EXPECT_THAT(result.output_tail, testing::Not(HasSubstr("\ntmp/")));
  EXPECT_THAT(result.output_tail, testing::Not(HasSubstr("\nhome/")));
}

TEST_F(CheckShaderCommand, TellsGithubTheLineOfTheTerm) {
  // The name of the file would end the command, and begin another.
  const std::string file = "a,line=1::b%0A.glsl";
  write(file,
        "const float PI = 3.14159265;\nfloat f(float c, float l, float n)\n{\n"
        "    if (l <= 0.0) return 0.0;\n    float k = (n + 2.0)\n        / (2.0 * PI);\n"
        "    return k * pow(max(c, 0.0), n);\n}\n");
  const std::vector<std::string> arguments{file,           "--function", "f",         "--arguments",
                                           "cosine,N.L,n", "--model",    "phong_rdf", "--no-costs",
                                           "--format",     "github"};
  const ProcessResult result = check(arguments);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.output_tail,
              HasSubstr("\n::error file=a%2Cline=1%3A%3Ab%250A.glsl,line=6,title=f differs from "
                        "phong_rdf::"));
  write(file,
        "float f(float c, float l, float n)\n{\n"
        "    return l > 0.0 ? (n + 1.0) / 6.28318531 * pow(max(c, 0.0), n) : 0.0;\n}\n");
  const ProcessResult passes = check(arguments);
  EXPECT_EQ(passes.exit_code, 0) << passes.output_tail;
  EXPECT_THAT(passes.output_tail, testing::Not(HasSubstr("::error")));
}

TEST_F(CheckShaderCommand, WatchesItsFileUntilItIsInterrupted) {
  const auto shader = [](const char* coefficient) {
    return fmt::format(
        "float f(float c, float l, float n)\n{{\n    return l > 0.0 ? {} / "
        "6.28318531 * pow(max(c, 0.0), n) : 0.0;\n}}\n",
        coefficient);
  };
  write("mine.glsl", shader("(n + 2.0)"));
  write("broken", shader("(n + m)"));
  write("right", shader("(n + 1.0)"));
  // An editor writes into the file, or gives its name to a new one; some remove it first.
  const ProcessResult result = run_shell(
      "until_said() { until grep -q \"$1\" out; do sleep 0.05; done; }\n"
      "{ until_said differs; cat broken > mine.glsl; until_said lobelia:; rm mine.glsl; sleep 0.4\n"
      "mv right mine.glsl; until_said passes; kill -INT $$; } > /dev/null 2>&1 &\n"
      "exec \"$LOBELIA\" check-shader mine.glsl --function f --arguments cosine,N.L,n --model "
      "phong_rdf --exponent 16 --no-costs --watch > out 2>&1\n",
      directory_.path());
  EXPECT_EQ(result.exit_code, 130);
  const std::string said = read_file(directory_.path() / "out", 1 << 20);
  const std::size_t differs = said.find("\ndiffers: "),
                    broken = said.find("\nlobelia: mine.glsl:3: "),
                    passes = said.find("\npasses: ");
  EXPECT_LT(differs, broken) << said;
  EXPECT_LT(broken, passes) << said;
  EXPECT_NE(passes, said.npos) << said;
  EXPECT_EQ(check({"none.glsl", "--function", "f", "--model", "phong_rdf", "--watch"}).exit_code,
            3);
}

TEST_F(CheckShaderCommand, RefusesInOneLine) {
  write("mine.glsl", "float f(vec3 N)\n{\n    return M;\n}\n");
  const auto expect = [&](std::vector<std::string> arguments, int exit_code, const char* said) {
    expect_one_line(check(std::move(arguments)), exit_code, said);
  };
  expect({"mine.glsl", "--function", "f", "--arguments", "N", "--model", "phong_rdf"}, 3,
         "mine.glsl:3: ");
  expect({"mine.glsl", "--function", "g", "--model", "phong_rdf"}, 3, "it has f");
  expect({"mine.glsl", "--function", "f", "--model", "phong"}, 2, "--model 'phong' is unknown");
  expect({"mine.glsl", "--function", "f", "--model", "phong_rdf", "--arguments", "N,x"}, 2,
         "'x' is unknown");
  expect(
      {"mine.glsl", "--function", "f", "--model", "phong_rdf", "--language", "hlsl", "--on", "egl"},
      2, "--on egl");
  expect({"none.glsl", "--function", "f", "--model", "phong_rdf"}, 3, "none.glsl");
  expect({"mine.glsl", "--function", "f", "--model", "phong_rdf", "--json", "no/r.json"}, 4,
         "no/r.json");
  expect({"mine.glsl", "--function", "f", "--model", "phong_rdf", "--json", "mine.glsl"}, 2,
         "mine.glsl");
}

/// The names of the files in docs/examples/shaders.
std::vector<std::string> engine_formulas() {
  std::vector<std::string> names;
  for (const auto& file :
       fs::directory_iterator(fs::path(LOBELIA_SOURCE_DIR) / "docs/examples/shaders"))
    names.push_back(file.path().filename().string());
  std::ranges::sort(names);
  return names;
}

class EngineFormula : public NeedsShaderRunner, public testing::WithParamInterface<std::string> {};

TEST_P(EngineFormula, IsAsThePageSays) {
  const fs::path docs = fs::path(LOBELIA_SOURCE_DIR) / "docs";
  std::vector<std::string> row;  // engine, formula, options, what the command says, why
  for (const std::string& line : split(read_file(docs / "engine_formulas.md", 1 << 20), "\n"))
    if (line.find("(examples/shaders/" + GetParam() + ")") != line.npos) row = split(line, "|");
  ASSERT_EQ(row.size(), 5u) << "docs/engine_formulas.md has no row of " << GetParam();
  std::vector<std::string> arguments = split(row[2], " `");
  arguments.insert(arguments.begin(),
                   {"check-shader", "examples/shaders/" + GetParam(), "--no-costs", kHang});
  const ProcessResult result = run_lobelia(arguments, docs);
  if (result.output_tail.find("llvmpipe") == std::string::npos)
    GTEST_SKIP() << "the page is of Mesa's llvmpipe";
  EXPECT_THAT(result.output_tail, HasSubstr("\n" + row[3] + "\n"));
  const std::string readme = read_file(docs.parent_path() / "README.md", 1 << 20);
  if (readme.find(GetParam()) != readme.npos) {
    EXPECT_THAT(readme, HasSubstr("\n" + row[3] + "\n"));
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, EngineFormula, testing::ValuesIn(engine_formulas()),
                         [](const auto& name) {
                           std::string word = name.param.substr(0, name.param.rfind('.'));
                           std::ranges::replace(word, '.', '_');
                           return word;
                         });

TEST_F(CheckShaderCommand, TestsTheBsdfOfTheTutorial) {
  const std::string page = tutorial(), section = page.substr(page.find("## A BSDF"));
  const std::string shader = block_of(section, "glsl");
  write("blinn.glsl", shader);
  const ProcessResult result = check({"blinn.glsl", "--bsdf", kHang});
  EXPECT_EQ(result.exit_code, 1) << result.output_tail;
  for (const char* line :
       {"explained by half-vector-jacobian: ", "eval is reciprocal", "random tests"}) {
    EXPECT_THAT(result.output_tail, HasSubstr(line));
    EXPECT_THAT(section, HasSubstr(line));
  }
  std::string right = shader;
  right.replace(right.find("D(c, n) * c;"), 11,
                "D(c, n) * c / (4.0 * dot(wi, normalize(wi + wo)))");
  write("blinn.glsl", right);
  const ProcessResult passes = check({"blinn.glsl", "--bsdf", "--json", "r.json", kHang});
  EXPECT_EQ(passes.exit_code, 0) << passes.output_tail;
  const Json record = Json::parse(read_file(directory_.path() / "r.json", 1 << 20));
  EXPECT_EQ(record["kind"], "bsdf-check");
  EXPECT_EQ(record["verdict"], "passes");
  EXPECT_EQ(check({"blinn.glsl", "--bsdf", "--model", "phong_rdf"}).exit_code, 2);
  EXPECT_EQ(check({"blinn.glsl", "--bsdf", "--sample", "pdf(V,L,n)"}).exit_code, 2);
  write("mine.wgsl", "fn f() -> f32 { return 0.0; }\n");
  EXPECT_EQ(check({"mine.wgsl", "--bsdf"}).exit_code, 2);
}

TEST(MistakesDocument, ListsEveryNameAndIsThePage) {
  const std::string document = shader_check::mistakes_document();
  for (const std::string_view name : shader_check::mistake_names())
    EXPECT_THAT(document, HasSubstr(fmt::format("`{}`", name)));
  EXPECT_EQ(read_file(std::string(LOBELIA_SOURCE_DIR) + "/docs/shader_mistakes.md", 1 << 20),
            document)
      << "run: lobelia check-shader --list-mistakes > docs/shader_mistakes.md";
}

TEST(CheckShaderPage, ListsEveryTestOfABsdf) {
  const std::string page = tutorial();
  for (const std::string_view check : records::kBsdfChecks)
    EXPECT_THAT(page, HasSubstr(fmt::format("`{}`", check)));
}

}  // namespace
}  // namespace lobelia
