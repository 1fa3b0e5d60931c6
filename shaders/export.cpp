#include "shaders/export.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/version.hpp"
#include "shaders/gpu.hpp"
#include "shaders/names.hpp"
#include "shaders/povray.hpp"

namespace lobelia {
namespace embedded {
extern const std::string_view gpu_head;
}
namespace {

struct Language {
  std::string_view name, title, note;
  GpuLanguage gpu;
};
constexpr Language kLanguages[] = {
    {"glsl",
     "GLSL",
     "For every version of GLSL and GLSL ES (WebGL); ask for highp floats where there is a choice.",
     {"vec3", "normal"}},
    {"hlsl", "HLSL", "For every shader model.", {"float3", "normal"}},
    {"osl",
     "OSL",
     "To be included before a shader, where to_eye is -I and surface_normal is N.",
     {"vector", "surface_normal"}}};
constexpr std::string_view kNames[] = {"glsl", "hlsl", "osl", "povray"};
constexpr std::size_t kPovray = 3;

std::string command_of(const ShaderExport& request) {
  std::string command = fmt::format("lobelia export --language {}", kNames[request.language.index]);
  for (const ModelId model : request.models) command += fmt::format(" {}", info(model).name);
  command += fmt::format(" --lobe {} --normalisation {}", info(request.lobe).name,
                         name(request.normalisation));
  return command + (request.exponent ? fmt::format(" --exponent {}", *request.exponent) : "");
}

}  // namespace

std::span<const std::string_view> shader_language_names() { return kNames; }
std::optional<ShaderLanguage> find_shader_language(std::string_view name) {
  return find_id<ShaderLanguage>(kNames, name);
}

std::string shader_text(const ShaderExport& request) {
  std::vector<Highlight> highlights;
  for (const ModelId model : request.models)
    highlights.push_back(
        {model, request.lobe, request.normalisation, request.exponent.value_or(1)});
  if (request.language.index == kPovray) {
    if (request.exponent)
      throw Error(
          ExitCode::kUsage,
          "for POV-Ray the exponent is an argument of what is exported; leave --exponent out");
    return povray_text(highlights);
  }
  const Language& language = kLanguages[request.language.index];
  const std::string text = gpu_text(language.gpu, highlights, request.exponent.has_value());
  return fill(embedded::gpu_head, {{"language", language.title},
                                   {"version", kNameAndVersion},
                                   {"command", command_of(request)},
                                   {"paper", kPaper},
                                   {"normal", language.gpu.normal},
                                   {"note", language.note}}) +
         text;
}

}  // namespace lobelia
