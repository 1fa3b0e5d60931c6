// write_half_exports FUNCTIONS LIST: the exported HLSL of every model and lobe in half floats, as the body of a class of
// C++ in which min16float is an emulated half float, and a line for each function. half_floats.cpp reads both.
#include <fmt/format.h>

#include "base/system/files.hpp"
#include "renderer/export/export.hpp"
#include "renderer/export/names.hpp"

namespace {

/// The parts in half floats: not the coefficients, which are computed in float.
std::string half_parts(const std::string& text) {
  constexpr std::string_view kBegin = "#ifndef ", kEnd = "#endif\n";
  std::string parts;
  for (std::size_t at = 0; (at = text.find(kBegin, at)) != std::string::npos;) {
    const std::size_t end = text.find(kEnd, at) + kEnd.size();
    const std::string part = text.substr(at, end - at);
    if (part.substr(0, part.find('\n')).ends_with("_MIN16FLOAT")) parts += part;
    at = end;
  }
  return parts;
}

}  // namespace

int main(int count, char** arguments) {
  using namespace lobelia;
  if (count != 3) return 2;
  std::string functions, list;
  for (const LobeId& lobe : all_lobes()) {
    ShaderExport request;
    request.language = *find_shader_language("hlsl");
    request.models.assign(all_models().begin(), all_models().end());
    request.lobe = lobe;
    request.coefficient = CoefficientFrom::kArgument;
    request.precision = ShaderPrecision::kMin16Float;
    functions += half_parts(shader_text(request));
    for (const ModelId model : request.models)
      list += fmt::format(
          "{{\"{0}\", \"{1}\", &Self::{2}_min16float, &Self::lobelia_{3}_lobe_min16float}},\n",
          info(model).name, info(lobe).name, function_name({model, lobe, request.normalisation}),
          identifier(lobe));
  }
  write_file(arguments[1], functions);
  write_file(arguments[2], list);
}
