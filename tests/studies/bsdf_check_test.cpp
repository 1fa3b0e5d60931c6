// BSDFs of shaders, run for real: eval, sample and pdf against each other.
#include <algorithm>
#include <chrono>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/bsdf/check.hpp"
#include "tests/shaders/shader_runner.hpp"
#include "tests/studies/bsdf_shaders.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using shader_check::bsdf::bsdf_report;
using shader_check::bsdf::BsdfRequest;
using shader_check::bsdf::check_bsdf;

class BsdfCheck : public NeedsShaderRunner {
 protected:
  static BsdfRequest request_of(const std::string& text) {
    BsdfRequest request;
    request.file = "mine.glsl";
    request.text = text;
    request.time_limit = std::chrono::hours(1);
    return request;
  }
  static std::string why_not(const BsdfRequest& request) {
    try {
      check_bsdf(request);
    } catch (const Error& error) {
      return fmt::format("{}: {}", int(error.code()), error.what());
    }
    return "";
  }
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  return at == text.npos ? text : text.replace(at, from.size(), to);
}

/// The same functions in HLSL.
std::string as_hlsl(std::string text) {
  for (const auto& [from, to] : {std::pair{"const float PI", "static const float PI"},
                                 {"vec2", "float2"},
                                 {"vec3", "float3"},
                                 {"vec4", "float4"},
                                 {"fract(", "frac("},
                                 {"float3(0.0)", "float3(0.0, 0.0, 0.0)"}})
    for (std::size_t at = 0; (at = text.find(from, at)) != text.npos;
         at += std::string_view(to).size())
      text.replace(at, std::string_view(from).size(), to);
  return text;
}

TEST_F(BsdfCheck, PassesRightOnesOnEveryDriver) {
  for (const char* text : {kPhongBsdf, kBlinnBsdf, kGgxBsdf, kDiffuseBsdf}) {
    const records::BsdfCheck record = check_bsdf(request_of(text));
    EXPECT_EQ(record.verdict, "passes") << bsdf_report(record);
    EXPECT_TRUE(record.explanations.empty());
    EXPECT_TRUE(record.reciprocal) << bsdf_report(record);
    EXPECT_EQ(record.eval_has_cosine, text == kBlinnBsdf);
  }
  for (const char* text : {kBlinnBsdf, kGgxBsdf}) {
    BsdfRequest request = request_of(as_hlsl(text));
    request.language = ShaderText::kHlsl;
    request.api = ShaderApi::kVulkan;
    const records::BsdfCheck record = check_bsdf(request);
    EXPECT_EQ(record.verdict, "passes") << bsdf_report(record);
  }
}

TEST_F(BsdfCheck, FindsEveryPlantedMistake) {
  for (const PlantedBsdf& planted : planted_bsdfs()) {
    const records::BsdfCheck record =
        check_bsdf(request_of(replaced(planted.shader, planted.right, planted.wrong)));
    EXPECT_EQ(record.verdict, "fails") << planted.what;
    std::vector<std::string> mistakes;
    for (const auto& one : record.explanations) mistakes.push_back(one.mistake);
    EXPECT_EQ(mistakes, planted.mistakes) << planted.what << "\n" << bsdf_report(record);
    EXPECT_TRUE(std::ranges::any_of(
        record.failures, [&](const auto& failure) { return failure.check == planted.check; }))
        << planted.what << "\n"
        << bsdf_report(record);
  }
}

TEST_F(BsdfCheck, TakesFunctionsByTheirLists) {
  BsdfRequest request = request_of(replaced(kGgxBsdf, "vec4 ggx_sample(vec3 V, float alpha, float",
                                            "vec4 ggx_sample(vec3 q, float rho, float"));
  request.text = replaced(request.text, "reflect(-V, half_vector(V, alpha,",
                          "reflect(-q, half_vector(q, rho,");
  request.text =
      replaced(request.text, "vec4(L, ggx_pdf(V, L, alpha))", "vec4(L, ggx_pdf(q, L, rho))");
  EXPECT_THAT(why_not(request), HasSubstr("2: mine.glsl: ggx_sample takes 'float rho'"));
  request.sample = "ggx_sample(V,alpha,u1,u2)";
  EXPECT_EQ(check_bsdf(request).verdict, "passes");
  request.sample = "ggx_sample(V,alpha,u1,u9)";
  EXPECT_THAT(why_not(request), HasSubstr("2: --sample: 'u9' for the parameter u2"));
}

TEST_F(BsdfCheck, SaysInOneLineWhatIsMissing) {
  EXPECT_THAT(
      why_not(request_of("float f(vec3 V, vec3 L) { return 1.0; }\n")),
      HasSubstr("2: mine.glsl: no function has sample in its name; it has f; type --sample NAME"));
  BsdfRequest request = request_of(kGgxBsdf);
  request.pdf = "gx_pdf";
  EXPECT_THAT(why_not(request), HasSubstr("did you mean 'ggx_pdf'?"));
  EXPECT_THAT(why_not(request_of("uniform float k;\n" +
                                 replaced(kDiffuseBsdf, "0.318309886 : 0.0", "k : 0.0"))),
              HasSubstr("eval reads float k, which nothing sets: --set k=NUMBER"));
}

TEST_F(BsdfCheck, SetsUniforms) {
  BsdfRequest request =
      request_of("uniform float k;\n" + replaced(kDiffuseBsdf, "0.318309886 : 0.0", "k : 0.0"));
  request.settings = {{"k", "0.2"}};
  const records::BsdfCheck record = check_bsdf(request);
  EXPECT_EQ(record.verdict, "passes") << bsdf_report(record);
  EXPECT_NEAR(record.settings.front().albedo, 0.2 * 3.14159265, 1e-4);
  EXPECT_EQ(record.settings.size(), 5u) << "without a parameter there is one exponent";
}

}  // namespace
}  // namespace lobelia
