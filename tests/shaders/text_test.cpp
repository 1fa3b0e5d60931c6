// The exported text as compilers and people meet it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <set>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/process.hpp"
#include "tests/shaders/exports.hpp"

namespace lobelia {
namespace {

using testing::HasSubstr;
using testing::Not;

class CompiledByGlslang : public testing::Test {
 protected:
  void SetUp() override {
    compiler_ = find_program("glslangValidator");
    if (!compiler_.empty()) return;
    const char* required = std::getenv("LOBELIA_REQUIRE_ENGINES");
    if (required && std::string_view(required) == "1") FAIL() << "no program 'glslangValidator'";
    GTEST_SKIP() << "no program 'glslangValidator': sudo apt-get install glslang-tools";
  }

  /// What the compiler says of the shaders that were written; empty if they are all right.
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

  std::filesystem::path compiler_;
  TemporaryDirectory scratch_;
  std::vector<std::string> files_;
};

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

TEST_F(CompiledByGlslang, EveryGlslExportIsAcceptedByTheOldestAndTheNewestVersions) {
  for (const auto& [name, head, output] :
       {std::array{"100", "#version 100\nprecision highp float;\n", "gl_FragColor"},
        std::array{"110", "#version 110\n", "gl_FragColor"},
        std::array{"320", "#version 320 es\nprecision highp float;\nout vec4 colour;\n", "colour"},
        std::array{"460", "#version 460\nout vec4 colour;\n", "colour"}}) {
    files_.clear();
    for (const ShaderExport& request : every_export("glsl"))
      write(fmt::format("{}_{}.frag", name, files_.size()),
            fmt::format("{}{}void main() {{ {} = vec4({}); }}\n", head, shader_text(request),
                        output, calls(request, "vec3")));
    EXPECT_GT(files_.size(), 100u);
    EXPECT_EQ(complaints({}), "") << name;
  }
}

TEST_F(CompiledByGlslang, AGlslExportIsOfHighPrecisionWhateverTheShadersDefault) {
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

TEST_F(CompiledByGlslang, EveryHlslExportIsAcceptedAndAllOfThemInOneShader) {
  std::string text, sum = "0.0";
  for (const ShaderExport& request : every_export("hlsl")) {
    text += shader_text(request);
    sum += " + " + calls(request, "float3");
  }
  write("all.frag",
        text +
            fmt::format(
                "float4 main() : SV_Target {{ float v = {}; return float4(v, v, v, v); }}\n", sum));
  EXPECT_EQ(complaints({"-D", "-V", "-e", "main"}), "");
}

TEST_F(CompiledByGlslang, EveryGlslExportInHalfFloatsIsAccepted) {
  for (const auto& [name, head, output] :
       {std::array{"100", "#version 100\nprecision mediump float;\n", "gl_FragColor"},
        std::array{"130", "#version 130\n", "gl_FragColor"},
        std::array{"320", "#version 320 es\nprecision mediump float;\nout vec4 colour;\n",
                   "colour"},
        std::array{"460", "#version 460\nout vec4 colour;\n", "colour"}}) {
    files_.clear();
    for (const ShaderExport& request : every_half_export("glsl"))
      write(fmt::format("half_{}_{}.frag", name, files_.size()),
            fmt::format("{}{}void main() {{ {} = vec4({}); }}\n", head, shader_text(request),
                        output, calls(request, "vec3")));
    EXPECT_GT(files_.size(), 100u);
    EXPECT_EQ(complaints({}), "") << name;
  }
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

TEST(HalfFloatExports, OfGlslAndHlslAreTheSameButForTheTypes) {
  const auto functions = [](const ShaderExport& request) {
    std::string text = shader_text(request);
    text = text.substr(text.find("#ifndef"));
    for (const auto& [from, to] :
         {std::pair{"\n#ifdef GL_FRAGMENT_PRECISION_HIGH\nprecision mediump float;\n#endif\n", ""},
          std::pair{"\\bmediump (float|vec3)\\b", "$1"}, std::pair{"\\bvec3\\b", "float3"},
          std::pair{"\\bmin16float(3?)\\b", "float$1"},
          std::pair{"(?:_mediump|_min16float)\\b", ""},
          std::pair{"(?:_MEDIUMP|_MIN16FLOAT)\\b", ""}})
      text = std::regex_replace(text, std::regex(from), to);
    return text;
  };
  const auto glsl = every_half_export("glsl"), hlsl = every_half_export("hlsl");
  ASSERT_EQ(glsl.size(), hlsl.size());
  for (std::size_t i = 0; i < glsl.size(); ++i) EXPECT_EQ(functions(glsl[i]), functions(hlsl[i]));
}

TEST_F(CompiledByGlslang, AMistakeWouldBeSeen) {
  std::string text = shader_text(every_export("glsl").front());
  text.replace(text.find("n_dot_l > 0.0"), 1, "m");
  write("mistake.frag", "#version 460\n" + text + "void main() {}\n");
  EXPECT_THAT(complaints({}), HasSubstr("undeclared identifier"));
}

TEST(MslExport, IsTheHlslExportButForItsBeginningAndTheWordInline) {
  // No compiler of MSL is in Debian. What the text computes, run_test shows of HLSL.
  const auto functions = [](const ShaderExport& request) {
    const std::string text = shader_text(request);
    return std::regex_replace(text.substr(text.find("#ifndef")), std::regex("\\binline "), "");
  };
  const std::vector<ShaderExport> msl = every_export("msl"), hlsl = every_export("hlsl");
  ASSERT_EQ(msl.size(), hlsl.size());
  for (std::size_t i = 0; i < msl.size(); ++i) {
    EXPECT_EQ(functions(msl[i]), functions(hlsl[i]));
    EXPECT_THAT(shader_text(msl[i]),
                HasSubstr("\n#include <metal_stdlib>\nusing namespace metal;\n"));
  }
  // In a header that several shaders include, each function would be defined more than once.
  EXPECT_FALSE(std::regex_search(shader_text(msl.front()), std::regex("\n(float|float3) ")));
}

TEST(OslExport, IsTheHlslExportButForTypesAndTheNormalsName) {
  // No compiler of OSL is in Debian. What the text computes, run_test shows of HLSL.
  const auto functions = [](const ShaderExport& request) {
    std::string text = shader_text(request);
    text.erase(0, text.find("#ifndef"));
    for (const auto& [osl, hlsl] : {std::pair{"\\b(vector|color)\\b(?!s)", "float3"},
                                    std::pair{"\\bsurface_normal\\b", "normal"}})
      text = std::regex_replace(text, std::regex(osl), hlsl);
    return text;
  };
  const std::vector<ShaderExport> osl = every_export("osl"), hlsl = every_export("hlsl");
  ASSERT_EQ(osl.size(), hlsl.size());
  for (std::size_t i = 0; i < osl.size(); ++i) EXPECT_EQ(functions(osl[i]), functions(hlsl[i]));
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

TEST(EveryExport, IsFilledInAndSaysWhatItIs) {
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

TEST(AnExport, HasWhatSeveralModelsShareOnce) {
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

TEST(AnExport, OfAFixedExponentHasTheCoefficientAsOneNumber) {
  const Highlight highlight{*find_model("modified_phong"), *find_lobe("gauss"),
                            Normalisation::kExact, 64};
  const std::string text = shader_text({*find_shader_language("hlsl"),
                                        {highlight.model},
                                        highlight.lobe,
                                        highlight.normalisation,
                                        64});
  EXPECT_THAT(text, HasSubstr(fmt::format("radiance = {:.9g}\n", radiance_coefficient(highlight))));
  EXPECT_THAT(text, Not(HasSubstr("_coefficient")));
}

TEST(AnExport, ThatCannotBeMadeSaysWhy) {
  const auto why_not = [](const char* language, const char* lobe, Normalisation normalisation,
                          std::optional<double> exponent,
                          CoefficientFrom coefficient = CoefficientFrom::kComputed,
                          Fresnel fresnel = Fresnel::kNone) -> std::string {
    try {
      shader_text({*find_shader_language(language),
                   {*find_model("phong_rdf")},
                   *find_lobe(lobe),
                   normalisation,
                   exponent,
                   coefficient,
                   fresnel});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const auto exact = Normalisation::kExact;
  const auto argument = CoefficientFrom::kArgument;
  EXPECT_THAT(
      why_not("glsl", "gauss", exact, {}),
      HasSubstr("'gauss' has no closed form; give the exponent that it is for: --exponent"));
  EXPECT_THAT(why_not("osl", "schlick", exact, {}), HasSubstr("give the exponent"));
  EXPECT_EQ(why_not("wgsl", "schlick", exact, {}, argument), "");
  EXPECT_THAT(why_not("msl", "cosine", exact, 64, argument), HasSubstr("--coefficient"));
  EXPECT_THAT(why_not("glsl", "cs8", Normalisation::kPaper, 64),
              HasSubstr("the paper gives no coefficient for the lobe 'cs8'"));
  EXPECT_THAT(why_not("povray", "cs8", Normalisation::kPaper, {}), HasSubstr("'cs8'"));
  EXPECT_THAT(why_not("povray", "cs8", exact, 64), HasSubstr("an argument"));
  EXPECT_THAT(why_not("povray", "cs8", exact, {}, argument), HasSubstr("--coefficient"));
  EXPECT_THAT(why_not("povray", "cs8", exact, {}, CoefficientFrom::kComputed, Fresnel::kSchlick),
              HasSubstr("--fresnel"));
}

TEST(AnExport, InHalfFloatsIsRefusedWhereTheLanguageOrTheLobeHasNone) {
  const auto why_not = [](const char* language, ShaderPrecision precision,
                          std::optional<double> exponent, const LobeId& lobe) -> std::string {
    ShaderExport request;
    request.language = *find_shader_language(language);
    request.models = {*find_model("phong_rdf")};
    request.lobe = lobe;
    request.exponent = exponent;
    request.precision = precision;
    try {
      shader_text(request);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage);
      return error.what();
    }
    return "";
  };
  const LobeId cosine = *find_lobe("cosine");
  const auto mediump = ShaderPrecision::kMediump, min16float = ShaderPrecision::kMin16Float;
  EXPECT_EQ(why_not("glsl", mediump, {}, cosine), "");
  EXPECT_EQ(why_not("hlsl", min16float, {}, cosine), "");
  EXPECT_THAT(why_not("hlsl", mediump, {}, cosine), HasSubstr("not in HLSL"));
  EXPECT_THAT(why_not("glsl", min16float, {}, cosine), HasSubstr("mediump is GLSL's"));
  for (const char* language : {"wgsl", "msl", "osl"})
    EXPECT_THAT(why_not(language, mediump, {}, cosine), HasSubstr("float32 alone"));
  EXPECT_THAT(why_not("povray", mediump, {}, cosine), HasSubstr("--precision"));
  EXPECT_THAT(why_not("glsl", mediump, 1e5, cosine), HasSubstr("at most 65504"));
  EXPECT_THAT(why_not("glsl", mediump, {}, formula_lobe("c^n")), HasSubstr("formula"));
}

TEST(AnExport, WithTheCoefficientAsAnArgumentHasItsFunctionButDoesNotCallIt) {
  for (const ShaderExport& request : every_export("glsl")) {
    if (request.coefficient != CoefficientFrom::kArgument) continue;
    const std::string_view lobe = family(request.lobe);
    const bool closed_form = lobe != "gauss" && lobe != "schlick" && lobe != "pk" && lobe != "ggx";
    for (const ModelId model : request.models) {
      const std::string name = coefficient_name_of(request, model);
      EXPECT_EQ(name.empty(), !closed_form);
      EXPECT_THAT(shader_text(request), Not(HasSubstr(" = " + name + "(")));
    }
    if (!closed_form) {
      EXPECT_THAT(shader_text(request), HasSubstr("has no closed form"));
    }
  }
}

}  // namespace
}  // namespace lobelia
