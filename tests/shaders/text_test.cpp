// The exported text as compilers and people meet it.
#include <fmt/format.h>

#include <regex>

#include "base/system/files.hpp"
#include "base/system/process.hpp"
#include "tests/shaders/exports.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

/// An expression that adds up every function of the export: its red, if it is a colour.
std::string calls(const ShaderExport& request, const std::string& vec3) {
  std::string sum;
  const std::string vectors =
      fmt::format("{0}(0.0, 0.0, 1.0), {0}(0.6, 0.0, 0.8), {0}(0.0, 0.6, 0.8)", vec3);
  for (const ModelId model : request.models)
    sum += (sum.empty() ? "" : " + ") +
           call_of(request, model, vectors, "16.0", "2.5", vec3 + "(0.04, 0.5, 1.0)") +
           (request.fresnel == Fresnel::kNone ? "" : ".x");
  return sum;
}

class CompiledByGlslang : public testing::Test {
 protected:
  void SetUp() override {
    compiler_ = find_program("glslangValidator");
    if (!compiler_.empty()) return;
    const char* required = std::getenv("LOBELIA_REQUIRE_ENGINES");
    if (required && std::string_view(required) == "1") FAIL() << "no program 'glslangValidator'";
    GTEST_SKIP() << "no program 'glslangValidator': sudo apt-get install glslang-tools";
  }

  /// The compiler's complaints about the shaders that were written; empty if there are none.
  std::string complaints(std::vector<std::string> options) {
    options.insert(options.begin(), compiler_.string());
    options.insert(options.end(), files_.begin(), files_.end());
    const ProcessResult result = run_process(options, working_here());
    EXPECT_NE(result.exit_code == 0, result.output_tail.find("ERROR") != std::string::npos);
    return result.exit_code == 0 ? "" : result.output_tail;
  }

  ProcessOptions working_here() const {
    ProcessOptions process;
    process.working_directory = scratch_.path();
    return process;
  }

  void write(const std::string& file, const std::string& text) {
    write_file(scratch_.path() / file, text);
    files_.push_back(file);
  }

  /// By this version of GLSL, with `head` at the beginning of each shader.
  void expect_accepted(const std::string& version, const char* head,
                       const std::vector<ShaderExport>& requests) {
    const bool old = version.starts_with("1");
    files_.clear();
    for (const ShaderExport& request : requests)
      write(fmt::format("{}.frag", files_.size()),
            fmt::format("#version {}\n{}{}{}void main() {{ {} = vec4({}); }}\n", version, head,
                        old ? "" : "out vec4 colour;\n", shader_text(request),
                        old ? "gl_FragColor" : "colour", calls(request, "vec3")));
    EXPECT_GT(files_.size(), 100u);
    EXPECT_EQ(complaints({}), "") << version;
  }

  std::filesystem::path compiler_;
  TemporaryDirectory scratch_;
  std::vector<std::string> files_;
};

TEST_F(CompiledByGlslang, EveryGlslExportIsValidInAllVersions) {
  const char* const es = "precision highp float;\n";
  expect_accepted("100", es, every_export("glsl"));
  expect_accepted("110", "", every_export("glsl"));
  expect_accepted("320 es", es, every_export("glsl"));
  expect_accepted("460", "", every_export("glsl"));
}

TEST_F(CompiledByGlslang, KeepsHighPrecisionInGlslExports) {
  const auto precisions = [&](const std::string& text) {
    files_.clear();
    write("mediump.frag", "#version 320 es\nprecision mediump float;\n" + text +
                              "out vec4 colour;\nvoid main() { colour = vec4(0.5); }\n");
    return run_process({compiler_.string(), "-i", files_.front()}, working_here()).output_tail;
  };
  EXPECT_THAT(precisions("float f(float x) { return x; }\n"), HasSubstr("mediump"));
  const std::string tree = precisions(shader_text(every_export("glsl").front()));
  EXPECT_THAT(tree, HasSubstr("highp"));
  EXPECT_THAT(tree, Not(HasSubstr("mediump")));
}

TEST_F(CompiledByGlslang, EveryGlslExportInHalfFloatsIsAccepted) {
  const char* const es = "precision mediump float;\n";
  expect_accepted("100", es, every_half_export("glsl"));
  expect_accepted("130", "", every_half_export("glsl"));
  expect_accepted("320 es", es, every_half_export("glsl"));
  expect_accepted("460", "", every_half_export("glsl"));
}

TEST_F(CompiledByGlslang, AnExportInHalfFloatsShadesInMediumpAlone) {
  for (const ShaderExport& request : every_half_export("glsl")) {
    // A coefficient that is computed is highp.
    if (request.exponent != 64) continue;
    files_.clear();
    write("half.frag", "#version 320 es\nprecision highp float;\n" + shader_text(request) +
                           "out vec4 colour;\nvoid main() { colour = vec4(0.5); }\n");
    const std::string tree =
        run_process({compiler_.string(), "-i", files_.front()}, working_here()).output_tail;
    ASSERT_THAT(tree, HasSubstr("mediump"));
    ASSERT_THAT(tree, Not(HasSubstr("highp"))) << shader_text(request);
  }
}

TEST_F(CompiledByGlslang, EveryHlslExportInHalfFloatsIsAcceptedBesideThoseInFloats) {
  std::string text, sum = "0.0";
  for (const std::vector<ShaderExport>& requests :
       {every_half_export("hlsl"), every_export("hlsl")})
    for (const ShaderExport& request : requests) {
      text += shader_text(request);
      sum += " + " + calls(request, "float3");
    }
  EXPECT_THAT(text, HasSubstr("min16float3"));
  write("both.frag",
        text +
            fmt::format(
                "float4 main() : SV_Target {{ float v = {}; return float4(v, v, v, v); }}\n", sum));
  EXPECT_EQ(complaints({"-D", "-V", "-e", "main"}), "");
}

using Replacements = std::vector<std::pair<const char*, const char*>>;

/// The exported text from its first function on, with each match of a pattern replaced.
std::string functions_of(const ShaderExport& request, const Replacements& replacements) {
  std::string text = shader_text(request);
  text.erase(0, text.find("#ifndef"));
  for (const auto& [from, to] : replacements) text = std::regex_replace(text, std::regex(from), to);
  return text;
}

void expect_the_same(const std::vector<ShaderExport>& some, const std::vector<ShaderExport>& others,
                     const Replacements& replacements) {
  ASSERT_EQ(some.size(), others.size());
  for (std::size_t i = 0; i < some.size(); ++i)
    EXPECT_EQ(functions_of(some[i], replacements), functions_of(others[i], replacements));
}

TEST(HalfFloatExports, AreTheSameInGlslAndHlslButForTheTypes) {
  expect_the_same(every_half_export("glsl"), every_half_export("hlsl"),
                  {{"\n#ifdef GL_FRAGMENT_PRECISION_HIGH\nprecision mediump float;\n#endif\n", ""},
                   {"\\bmediump (float|vec3)\\b", "$1"},
                   {"\\bvec3\\b", "float3"},
                   {"\\bmin16float(3?)\\b", "float$1"},
                   {"(?:_mediump|_min16float)\\b", ""},
                   {"(?:_MEDIUMP|_MIN16FLOAT)\\b", ""}});
}

TEST(MslExport, MatchesTheHlslExportBelowItsBeginning) {
  // No compiler of MSL is in Debian. What the text computes, run_test shows of HLSL.
  const std::vector<ShaderExport> msl = every_export("msl");
  expect_the_same(msl, every_export("hlsl"), {std::pair{"\\binline ", ""}});
  for (const ShaderExport& request : msl)
    EXPECT_THAT(shader_text(request),
                HasSubstr("\n#include <metal_stdlib>\nusing namespace metal;\n"));
  // In a header that several shaders include, each function would be defined more than once.
  EXPECT_FALSE(std::regex_search(shader_text(msl.front()), std::regex("\n(float|float3) ")));
}

TEST(OslExport, MatchesTheHlslExportExceptForItsTypes) {
  // No compiler of OSL is in Debian. What the text computes, run_test shows of HLSL.
  expect_the_same(every_export("osl"), every_export("hlsl"),
                  {{"\\b(vector|color)\\b(?!s)", "float3"}, {"\\bsurface_normal\\b", "normal"}});
}

TEST(OslExport, DeclaresNoNameThatIsAWordOfTheLanguage) {
  const std::set<std::string> reserved{
      "and",     "break",   "closure",  "color",    "continue",    "do",         "else",
      "emit",    "float",   "for",      "if",       "illuminance", "illuminate", "int",
      "matrix",  "normal",  "not",      "or",       "output",      "point",      "public",
      "return",  "string",  "struct",   "vector",   "void",        "while",      "bool",
      "case",    "catch",   "char",     "class",    "const",       "delete",     "default",
      "double",  "enum",    "extern",   "false",    "friend",      "goto",       "inline",
      "long",    "new",     "operator", "private",  "protected",   "short",      "signed",
      "sizeof",  "static",  "switch",   "template", "this",        "throw",      "true",
      "try",     "typedef", "uniform",  "union",    "unsigned",    "varying",    "virtual",
      "volatile"};
  static const std::regex declaration("\\b(?:float|vector|color) ([A-Za-z_0-9]+)");
  int names = 0;
  for (const ShaderExport& request : every_export("osl")) {
    const std::string text = shader_text(request);
    for (std::sregex_iterator it(text.begin(), text.end(), declaration), end; it != end; ++it) {
      ++names;
      EXPECT_FALSE(reserved.contains((*it)[1])) << (*it)[1];
    }
  }
  EXPECT_GT(names, 1000);
}

TEST(EveryExport, NamesItsSources) {
  for (const std::string_view language : shader_language_names())
    for (ShaderExport request : every_export(std::string(language))) {
      if (language == "povray")
        request = {request.language, request.models, request.lobe, request.normalisation, {}};
      const std::string text = shader_text(request);
      EXPECT_THAT(text, Not(HasSubstr("%"))) << text;
      for (const ModelId model : request.models) {
        EXPECT_THAT(text, HasSubstr(info(model).source));
        EXPECT_THAT(text, HasSubstr(info(model).title));
      }
      EXPECT_THAT(text, HasSubstr(info(request.lobe).source));
      EXPECT_THAT(text, HasSubstr(request.normalisation == Normalisation::kExact ? "\"exact\""
                                                                                 : "\"paper\""));
    }
}

TEST(AnExport, HasSharedFunctionsOnce) {
  const std::string text = shader_text({*find_shader_language("glsl"),
                                        {all_models().begin(), all_models().end()},
                                        *find_lobe("cs16"),
                                        Normalisation::kExact,
                                        {}});
  for (const char* once :
       {"float lobelia_cs16_lobe(", "float lobelia_s_half(", "float lobelia_cs16_energy("}) {
    EXPECT_NE(text.find(once), std::string::npos) << once;
    EXPECT_EQ(text.find(once), text.rfind(once)) << once;
  }
}

TEST(AnExport, HasTheCoefficientsFunctionButTakesItAsAnArgument) {
  for (const ShaderExport& request : every_export("glsl")) {
    if (request.coefficient != CoefficientFrom::kArgument) continue;
    const std::string_view lobe = family(request.lobe);
    const bool closed_form = lobe != "gauss" && lobe != "schlick" && lobe != "pk" && lobe != "ggx";
    for (const ModelId model : request.models) {
      // GGX times its cosine has the integral of cos^n.
      const std::string_view integral = info(model).integral;
      const bool as_cosine = lobe == "ggx" && integral.find("x/2") == integral.npos &&
                             integral.find("cos") != integral.npos;
      const std::string name = coefficient_name_of(request, model);
      EXPECT_EQ(name.empty(), !closed_form && !as_cosine) << info(model).name;
      EXPECT_THAT(shader_text(request), Not(HasSubstr(" = " + name + "(")));
    }
    if (!closed_form) {
      EXPECT_THAT(shader_text(request), HasSubstr("has no closed form"));
    }
  }
}

}  // namespace
}  // namespace lobelia
