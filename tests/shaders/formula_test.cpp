// A lobe by its formula, as shader text in every language.
#include <fmt/format.h>

#include "renderer/export/export.hpp"
#include "renderer/export/names.hpp"
#include "renderer/export/povray.hpp"
#include "renderer/formula.hpp"
#include "tests/renderer/infix.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

constexpr const char* kFormulas[] = {"max(0, 1 - n*s/6)^6", "exp(-n*x^2/2)", "c/(c + n*s)",
                                     "max(1/(1 + n*s)^2, exp(-sqrt(n*s)))",
                                     "1/(1 + log(1 + n*s))^4"};

ShaderExport request_of(std::string_view language, const char* formula) {
  return {*find_shader_language(language),
          {*find_model("phong_rdf"), *find_model("modified_blinn_phong")},
          formula_lobe(formula),
          Normalisation::kExact,
          {}};
}

/// Between the braces behind `heading`.
std::string body_of(const std::string& text, const std::string& heading) {
  const std::size_t at = text.find(heading);
  if (at == text.npos) return "no " + heading;
  const std::size_t begin = text.find("{\n", at) + 2;
  return text.substr(begin, text.find("\n}", begin) - begin);
}

TEST(ExportedFormula, HasTheValuesOfItsLobeInEveryLanguageOfGpus) {
  for (const std::string_view language : shader_language_names())
    for (const char* formula : kFormulas) {
      if (language == "povray") continue;
      ShaderExport request = request_of(language, formula);
      request.exponent = 20;
      const std::string text = shader_text(request);
      std::string body = body_of(text, identifier(request.lobe) + "_lobe(");
      // WGSL declares otherwise.
      for (const auto& [from, to] : {std::pair("let ", "float "), std::pair(": f32", "")})
        for (std::size_t at; (at = body.find(from)) != body.npos;)
          body.replace(at, std::strlen(from), to);
      for (const double s : {0.0, 1e-4, 0.03, 0.3, 0.99})
        EXPECT_NEAR(Infix::value_of_body(body, {{"s", s}, {"n", 20}}),
                    lobe_value(request.lobe, s, 20), 1e-9)
            << language << "\n"
            << body;
      for (const ModelId model : request.models) {
        const Highlight h{model, request.lobe, request.normalisation, 20};
        EXPECT_THAT(text, HasSubstr(fmt::format("radiance = {:.9g}\n", radiance_coefficient(h))));
      }
      EXPECT_THAT(text, HasSubstr(fmt::format(
                            "--lobe expression --formula '{}' --normalisation exact --exponent 20",
                            request.lobe.formula->text())));
      request.exponent.reset();
      request.coefficient = CoefficientFrom::kArgument;
      EXPECT_THAT(shader_text(request), HasSubstr("has no closed form")) << language;
    }
}

TEST(ExportedFormula, HasTheValuesOfItsLobeInPovraysLanguage) {
  for (const char* formula : kFormulas) {
    const Highlight highlight{*find_model("phong_rdf"), formula_lobe(formula)};
    const std::string text = povray_text(std::span(&highlight, 1)),
                      heading =
                          capitalised(identifier(highlight.lobe)) + "_Formula = function(S, N) { ";
    const std::size_t begin = text.find(heading) + heading.size();
    const std::string body = text.substr(begin, text.find(" }\n", begin) - begin);
    EXPECT_THAT(body, testing::Not(HasSubstr("log("))) << "to the base of ten";
    for (const double s : {0.0, 1e-4, 0.03, 0.3, 0.99})
      EXPECT_NEAR(Infix::value(body, {{"S", s}, {"N", 20}}), lobe_value(highlight.lobe, s, 20),
                  1e-12)
          << body;
  }
}

TEST(ExportedFormula, StandsBesideAnotherOne) {
  const std::string a = identifier(formula_lobe("c^n")),
                    b = identifier(formula_lobe("1/(1 + n*s)"));
  EXPECT_NE(a, b);
  EXPECT_EQ(a, identifier(formula_lobe("(c) ^ n")));
  EXPECT_TRUE(a.starts_with("expression_") && a.size() == 19) << a;
}

}  // namespace
}  // namespace lobelia
