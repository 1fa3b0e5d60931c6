// Writes every exported function as C++, for shader_values_test: the text of the given language with
// its `float` renamed to a class, and a table of what it has.
//     write_shader_functions glsl > functions.cpp
#include <fmt/format.h>

#include <regex>

#include "shaders/export.hpp"
#include "shaders/names.hpp"
#include "tests/shaders/exports.hpp"

int main(int, char** argv) {
  using namespace lobelia;
  const std::string language = argv[1];
  std::string text, table;
  for (const ShaderExport& request : every_export(language)) {
    text += shader_text(request);
    for (const ModelId model : request.models) {
      const bool coloured = request.fresnel != Fresnel::kNone;
      const std::string coefficient = coefficient_name_of(request, model);
      table += fmt::format(
          "    {{\"{}\", {{{{{}}}, {{{}, {}}}, Normalisation({}), {}}}, {}, {}, {},\n"
          "     [](vec3 n, vec3 v, vec3 l, [[maybe_unused]] Real exponent,\n"
          "        [[maybe_unused]] Real coefficient, [[maybe_unused]] vec3 f0) {{\n"
          "       return as_colour({});\n"
          "     }}}},\n",
          function_name_of(request, model), model.index, request.lobe.index, request.lobe.order,
          int(request.normalisation), request.exponent.value_or(1), request.exponent.has_value(),
          coloured, coefficient.empty() ? "nullptr" : "&" + coefficient,
          call_of(request, model, "n, v, l", "exponent", "coefficient", "f0"));
    }
  }
  fmt::print(
      "#include \"tests/shaders/shader_functions.hpp\"\n"
      "namespace lobelia::shader_functions::{0} {{\n"
      "{1}\n"
      "const std::vector<ShaderFunction>& table() {{\n"
      "  static const std::vector<ShaderFunction> all{{\n{2}  }};\n"
      "  return all;\n}}\n}}\n",
      language, std::regex_replace(text, std::regex("\\bfloat\\b"), "Real"), table);
}
