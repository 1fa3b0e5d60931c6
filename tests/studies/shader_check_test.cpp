// Shaders of users, run for real, against the models.
#include <fmt/format.h>

#include <chrono>

#include "base/system/error.hpp"
#include "renderer/export/export.hpp"
#include "renderer/export/names.hpp"
#include "studies/search/minimax.hpp"
#include "studies/shader_check/annotation.hpp"
#include "studies/shader_check/check.hpp"
#include "studies/shader_check/explain.hpp"
#include "studies/shader_check/own_shader.hpp"
#include "tests/shaders/shader_runner.hpp"
#include "tests/studies/planted_mistakes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

using shader_check::Check;
using testing::ElementsAreArray;

class ShaderCheck : public NeedsShaderRunner {
 protected:
  /// Only a hang takes so long.
  static constexpr std::chrono::hours kHang{1};
  static shader_check::Request request_of(const char* model, const std::string& text) {
    shader_check::Request request;
    request.file = "mine.glsl";
    request.text = text;
    request.function = "highlight";
    request.arguments = kVectors;
    request.highlight = {*find_model(model), *find_lobe("cosine")};
    request.exponents.assign(std::begin(shader_check::kUsualExponents),
                             std::end(shader_check::kUsualExponents));
    request.costs = false;
    request.time_limit = kHang;
    return request;
  }
  /// For the function that is exported of the model.
  static shader_check::Request request_of_export(const char* model,
                                                 ShaderText language = ShaderText::kGlsl) {
    shader_check::Request request = request_of(model, "");
    request.language = language;
    request.text = shader_text({*find_shader_language(kShaderTextNames[std::size_t(language)]),
                                {request.highlight.model},
                                request.highlight.lobe,
                                Normalisation::kExact,
                                {}});
    request.function = function_name(request.highlight);
    return request;
  }
  static std::string why_not(const shader_check::Request& request) {
    try {
      shader_check::check_shader(request);
    } catch (const Error& error) {
      return fmt::format("{}: {}", int(error.code()), error.what());
    }
    return "";
  }
};

TEST_F(ShaderCheck, FindsEveryPlantedMistakeByName) {
  EXPECT_GE(planted_mistakes().size(), 36u);
  for (const PlantedMistake& planted : planted_mistakes()) {
    shader_check::Request request = request_of(planted.model, shader_with(planted));
    request.arguments = planted.arguments;
    const Check check = shader_check::check_shader(request);
    EXPECT_EQ(check.record.verdict, "differs") << planted.what;
    ASSERT_TRUE(check.record.explanation) << planted.what;
    EXPECT_THAT(check.record.explanation->mistakes, ElementsAreArray(planted.mistakes))
        << planted.what << ": " << check.record.explanation->sentence;
    EXPECT_THAT(check.record.explanation->sentence, HasSubstr(planted.words)) << planted.what;
    EXPECT_TRUE(check.record.explanation->complete) << planted.what;
  }
}

TEST_F(ShaderCheck, FindsTheCodeOfASearchedLobeWithinItsBound) {
  using search::Outer, search::Shape;
  const search::Range range{16, 256};
  for (const Shape& shape : {Shape{Outer::kClamp, 3, 2, 1}, Shape{Outer::kReciprocal, 2, 1, 1},
                             Shape{Outer::kBits, 1, 0, 1}, Shape{Outer::kClamp, 3, 2, 1, true},
                             Shape{Outer::kBits, 2, 0, 2, true}}) {
    const search::Lobe lobe = search::minimax(shape, range).lobe;
    ASSERT_FALSE(lobe.c.empty());
    shader_check::Request request = request_of("phong_rdf", "");
    request.text = "#version 420\n" + lobe.code("lobe") + R"(
float highlight(vec3 N, vec3 V, vec3 L, float n) {
  vec3 off = reflect(-V, N) - L;
  return dot(N, L) > 0.0 ? (n + 1.0) / 6.28318530718 * lobe(0.5 * dot(off, off), n) : 0.0;
})";
    request.exponents = {16, 64, 256};
    const Check check = shader_check::check_shader(request);
    const double bound = search::prove(lobe, range).bound;
    double most = 0;
    for (const records::ShaderError& error : check.record.errors)
      most = std::max(most, error.max_of_peak);
    EXPECT_LE(most, bound + 1e-5) << name(shape);
    EXPECT_GE(most, 0.5 * bound) << name(shape);
  }
}

TEST_F(ShaderCheck, PassesTheExportedFunctionOfEveryModelInBothLanguages) {
  for (const ModelId model : all_models())
    for (const ShaderText language : {ShaderText::kGlsl, ShaderText::kHlsl}) {
      shader_check::Request request = request_of_export(info(model).name.data(), language);
      request.api = language == ShaderText::kHlsl ? ShaderApi::kVulkan : ShaderApi::kEgl;
      const Check check = shader_check::check_shader(request);
      EXPECT_EQ(check.record.verdict, "passes") << shader_check::report_text(check.record);
      EXPECT_EQ(check.record.oddities.hard_nonfinite, 0u) << request.function;
      for (const records::ShaderError& error : check.record.errors)
        // With shadowing a highlight is higher at grazing angles, and so is its error: 1.6e-5.
        EXPECT_LE(error.max_of_peak, info(model).has_shadowing ? 2e-5 : 1e-5)
            << request.function << " n = " << error.exponent;
      for (const records::ShaderEnergy& energy : check.record.energy)
        EXPECT_NEAR(energy.energy, energy.of_model, 1e-5 * (1 + energy.of_model));
      request.exponents = {1e6};
      EXPECT_EQ(shader_check::check_shader(request).record.verdict, "passes") << request.function;
    }
}

TEST_F(ShaderCheck, PassesAnExportedFunctionInEveryVersionOfGlsl) {
  for (const char* version : {"#version 300 es", "#version 310 es", "#version 100", "#version 110",
                              "#version 330 core", "#version 450"})
    for (const char* model : {"modified_phong", "microfacet_smith"}) {
      shader_check::Request request = request_of_export(model);
      request.exponents = {16, 1000};
      request.text = std::string(version) + "\n" + request.text;
      const Check check = shader_check::check_shader(request);
      EXPECT_EQ(check.record.verdict, "passes") << version << "\n"
                                                << shader_check::report_text(check.record);
    }
}

TEST_F(ShaderCheck, TakesTheDriverForRightWithEveryLobe) {
  for (const ModelId model : all_models()) {
    shader_check::Request request = request_of(info(model).name.data(), "");
    std::vector<shader_check::Point> points;
    for (const double n : {kMinExponent, 0.5, 2.0, 30.0, 1e4, 1e6}) {
      const auto more = shader_check::domain_points(request.highlight, n, 200);
      points.insert(points.end(), more.begin(), more.end());
    }
    for (const LobeId& lobe : all_lobes()) {
      request.highlight.lobe = lobe;
      // The coefficient is that of the lobe.
      const ShaderPoints called = shader_check::Arguments(request.highlight).of(points);
      const ShaderRun run =
          run_programs(request.api, called,
                       {make_program(shader_check::own_source(request), request.api, called.count(),
                                     called.components)},
                       1, {kHang, 0});
      EXPECT_NO_THROW(
          shader_check::require_right_driver(request, run.device, points, run.values.front()))
          << info(model).name << " " << info(lobe).name;
    }
  }
}

TEST_F(ShaderCheck, ADriverOnWhichOurExportIsWrongIsToldInPlaceOfTheShader) {
  shader_check::Request request = request_of_export("modified_phong");
  const std::vector<shader_check::Point> points =
      shader_check::domain_points(request.highlight, 16, 50);
  std::vector<ShaderValue> values(points.size());
  Highlight here = request.highlight;
  here.exponent = 16;
  for (std::size_t i = 0; i < points.size(); ++i) {
    values[i].r =
        float(model_radiance(here, radiance_coefficient(here), shader_check::Geometry(points[i])));
    values[i].written = true;
  }
  const auto told = [&] {
    try {
      shader_check::require_right_driver(request, "a driver", points, values);
    } catch (const Error& error) {
      return fmt::format("{}: {}", int(error.code()), error.what());
    }
    return std::string();
  };
  EXPECT_EQ(told(), "");
  values[7].r += 1e-2f;
  EXPECT_THAT(told(),
              testing::StartsWith("5: a driver: Lobelia's own export of modified_phong is wrong "));
  values[7].r = std::nanf("");
  EXPECT_THAT(told(), testing::StartsWith("5: a driver: "));
}

TEST_F(ShaderCheck, PassesATextbookPowerAsFarAsFloat32KnowsItsCosine) {
  shader_check::Request request = request_of(
      "blinn_phong_ndf",
      "float highlight(vec3 N, vec3 V, vec3 L, float n)\n"
      "{ return (n + 1.0) / (8.0 * 3.14159265) * pow(max(dot(N, normalize(L + V)), 0.0), n) * "
      "max(dot(N, L), 0.0); }\n");
  const Check check = shader_check::check_shader(request);
  EXPECT_EQ(check.record.verdict, "passes") << shader_check::report_text(check.record);
  request.exponents = {20000};
  const Check sharp = shader_check::check_shader(request);
  EXPECT_EQ(sharp.record.verdict, "differs");
  EXPECT_THAT(sharp.record.explanation->mistakes, testing::ElementsAre("float32-cosine"));
}

TEST_F(ShaderCheck, EnergyIsTheModelsAlbedo) {
  shader_check::Request request = request_of_export("modified_phong");
  for (const records::ShaderEnergy& energy : shader_check::check_shader(request).record.energy)
    if (energy.incidence_degrees == 0) {
      EXPECT_NEAR(energy.energy, 1, 2e-3) << energy.exponent;
    }
}

TEST_F(ShaderCheck, RefusesInOneLineABrokenShader) {
  const std::string head = "float highlight(vec3 N, vec3 V, vec3 L, float n)\n";
  const auto with = [&](const std::string& body, std::chrono::duration<double> time_limit = kHang) {
    shader_check::Request request = request_of("phong_rdf", head + body);
    request.time_limit = time_limit;
    return why_not(request);
  };
  EXPECT_THAT(with("{\n  return foo;\n}\n"), testing::StartsWith("3: mine.glsl:3: "));
  EXPECT_THAT(with("{ return 1.0\n}\n"), testing::StartsWith("3: mine.glsl:3: "));
  EXPECT_EQ(with("{ discard; return 1.0; }\n"),
            "3: mine.glsl: highlight writes nothing: every call is discarded");
  // Mesa leaves a loop after 65535 rounds; other drivers do not.
  constexpr std::chrono::seconds kShort(5);
  const auto does_not_end = testing::AnyOf(HasSubstr("highlight does not seem to end: it takes "),
                                           HasSubstr("the shader did not end within 5 s on "));
  EXPECT_THAT(
      with("{ float x = 1.0; while (x > 0.0) x = x * 0.5 + N.z * N.z + 1.0; return x; }\n", kShort),
      does_not_end);
  EXPECT_THAT(
      with("{ float x = 1.0; while (x > 0.0) { float y = 1.0; while (y > 0.0) y = y * 0.5 + "
           "N.z * N.z + 1.0; x = x * 0.5 + y; } return x; }\n",
           kShort),
      does_not_end);
  shader_check::Request request = request_of("phong_rdf", head + "{ return 1.0; }\n");
  request.function = "highligt";
  EXPECT_EQ(
      why_not(request),
      "3: mine.glsl: has no function 'highligt'; it has highlight; did you mean 'highlight'?");
  request = request_of("phong_rdf", head + "{ return 1.0; }\n");
  request.arguments = "N,V,L";
  EXPECT_EQ(
      why_not(request),
      "2: mine.glsl: --arguments has 3 words, but highlight takes: vec3 N, vec3 V, vec3 L, float n");
  request.arguments = "N,V,L,m";
  EXPECT_THAT(why_not(request),
              testing::StartsWith("2: --arguments: 'm' is unknown; allowed: N, V"));
}

TEST_F(ShaderCheck, CountsNansBesideValuesOutsideTheSupport) {
  const std::string head =
      "float highlight(vec3 N, vec3 V, vec3 L, float n)\n{ float c = dot(reflect(-V, N), L); ";
  const Check nan =
      shader_check::check_shader(request_of("phong_rdf", head + "return sqrt(c) + n; }\n"));
  EXPECT_GT(nan.record.oddities.nan, 100u);
  EXPECT_TRUE(nan.record.oddities.first_nonfinite);
  const Check outside =
      shader_check::check_shader(request_of("phong_rdf", head + "return 1.0; }\n"));
  EXPECT_EQ(outside.record.oddities.nan, 0u);
  EXPECT_GT(outside.record.oddities.outside_support, 100u);
  EXPECT_THAT(outside.record.explanation->sentence, HasSubstr("there is no lobe"));
  const Check zero = shader_check::check_shader(request_of("phong_rdf", head + "return 0.0; }\n"));
  EXPECT_EQ(zero.record.explanation->sentence, "it is 0 in every direction");
}

TEST_F(ShaderCheck, MeasuresHalfFloatsAndInstructionsBesideOurs) {
  shader_check::Request request = request_of_export("blinn_phong_ndf");
  request.costs = true;
  const Check check = shader_check::check_shader(request);
  EXPECT_THAT(check.record.remarks, testing::IsEmpty());
  ASSERT_EQ(check.record.costs.size(), 3u);
  // It is ours.
  EXPECT_EQ(check.record.costs[0].instructions, check.record.costs[1].instructions);
  EXPECT_GT(check.record.costs[0].instructions, check.record.costs[2].instructions);
  ASSERT_EQ(check.record.half_floats.size(), request.exponents.size());
  EXPECT_GT(check.record.half_floats.back().max_of_peak, 1e-3);
}

TEST_F(ShaderCheck, ThePageHasPicturesAndEscapesTheFilesName) {
  shader_check::Request request =
      request_of("phong_rdf", "float highlight(vec3 N, vec3 V, vec3 L, float n) { return 1.0; }\n");
  request.file = "<b>&\".glsl";
  const std::string page = shader_check::report_page(shader_check::check_shader(request));
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_EQ(page.find("<b>"), std::string::npos);
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;"));
}

TEST_F(ShaderCheck, ThePageMapsTheErrorOfTheExponentShownAndOfTheWorst) {
  // Right for n = 16 alone.
  shader_check::Request request = request_of(
      "phong_rdf",
      "float highlight(vec3 N, vec3 V, vec3 L, float n) { return dot(N, L) <= 0.0 ? 0.0 : "
      "17.0 / 6.28318531 * pow(max(dot(reflect(-V, N), L), 0.0), n); }\n");
  request.exponents = {4, 16, 64};
  request.shown_exponent = 16;
  request.worst_spheres = true;
  const Check check = shader_check::check_shader(request);
  ASSERT_EQ(check.spheres.size(), 2u);
  EXPECT_EQ(check.spheres[0].exponent, 16);
  // 17 / 5 - 1 of the peak is more than 1 - 17 / 65.
  EXPECT_EQ(check.spheres[1].exponent, 4);
  const auto largest = [](const shader_check::Spheres& spheres) {
    double error = 0;
    for (const shader_check::SpherePair& pair : spheres.pairs)
      for (std::size_t i = 0; i < pair.model.values().size(); ++i)
        error = std::max(
            error, std::abs(double(pair.theirs.values()[i]) - double(pair.model.values()[i])));
    return error / spheres.peak;
  };
  EXPECT_LT(largest(check.spheres[0]), 1e-4);
  EXPECT_NEAR(largest(check.spheres[1]), 2.4, 0.01);
  const std::string page = shader_check::report_page(check);
  EXPECT_THAT(page, HasSubstr("Spheres, n = 16<"));
  EXPECT_THAT(page, HasSubstr("Spheres, n = 4, furthest above what is allowed<"));
  EXPECT_THAT(page, HasSubstr("+240 % of the peak: brighter than the model"));
  EXPECT_THAT(page, HasSubstr("-0.1 % of the peak: darker than the model"));
}

TEST(LineOfTerm, IsThatOfTheCoefficientOfThePowerOrOfTheReturn) {
  const ShaderSource source{ShaderText::kGlsl,
                            "mine.glsl",
                            "// pi pow(\nfloat f(float c);\nfloat f(float c)\n{\n"
                            "    float k = 1.0 / PI;\n    float p = pow(c, 2.0);\n"
                            "    if (c < 0.0) return 0.0;\n    return k * p;\n}\n"
                            "float g(float c)\n{\n    return pow(c, 2.0);\n}\n",
                            {}};
  const auto line = [&](const char* function, std::vector<std::string> mistakes) {
    return shader_check::line_of_term(source, function, mistakes);
  };
  EXPECT_EQ(line("f", {"coefficient"}), 5u);
  EXPECT_EQ(line("f", {"two-twice"}), 5u);
  EXPECT_EQ(line("f", {"exponent", "coefficient"}), 6u);
  EXPECT_EQ(line("f", {"cosine-missing"}), 8u);
  EXPECT_EQ(line("f", {"coefficient-missing"}), 8u);
  EXPECT_EQ(line("f", {}), 8u);
  EXPECT_EQ(line("g", {"exponent"}), 12u);
  EXPECT_EQ(line("g", {"coefficient"}), 5u) << "it is in another function";
  EXPECT_EQ(line("h", {"coefficient"}), 0u);
  EXPECT_EQ(shader_check::line_of_term(
                {ShaderText::kGlsl, "mine.glsl", "float f(float c) { return pow(c,\nPI) / PI", {}},
                "f", std::vector<std::string>{"coefficient"}),
            2u);
}

}  // namespace
}  // namespace lobelia
