// All that can be exported: what the tests of this room go through.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/system/error.hpp"
#include "renderer/export/export.hpp"
#include "renderer/export/names.hpp"

namespace lobelia {

inline constexpr double kFixedExponents[] = {1, 12.5, 64, 1024, 1e5};

inline std::vector<LobeId> every_lobe() {
  std::vector<LobeId> lobes(all_lobes().begin(), all_lobes().end());
  for (const char* name : {"cs12", "cs1024"}) lobes.push_back(*find_lobe(name));
  return lobes;
}

inline bool can_be_made(const ShaderExport& request) {
  try {
    shader_text(request);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Every model with every lobe and normalisation: with a run-time exponent, with the coefficient computed where that
/// is possible and as an argument, and with fixed exponents; without and with the Fresnel factor. All of them can stand
/// in one shader, but for WGSL.
inline std::vector<ShaderExport> every_export(const std::string& language) {
  std::vector<ShaderExport> exports;
  for (const LobeId& lobe : every_lobe())
    for (const Normalisation normalisation : {Normalisation::kExact, Normalisation::kPaper}) {
      if (normalisation == Normalisation::kPaper && !has_paper_coefficient(lobe)) continue;
      ShaderExport request{*find_shader_language(language),
                           {all_models().begin(), all_models().end()},
                           lobe,
                           normalisation,
                           {}};
      for (const Fresnel fresnel : {Fresnel::kNone, Fresnel::kSchlick}) {
        request.fresnel = fresnel;
        request.exponent.reset();
        for (const auto from : {CoefficientFrom::kComputed, CoefficientFrom::kArgument}) {
          request.coefficient = from;
          if (can_be_made(request)) exports.push_back(request);
        }
        request.coefficient = CoefficientFrom::kComputed;
        for (const double n : kFixedExponents) {
          if (fresnel != Fresnel::kNone && n != 64) continue;
          request.exponent = n;
          exports.push_back(request);
        }
      }
    }
  return exports;
}

/// The same in half floats, with exponents for which that is meant.
inline std::vector<ShaderExport> every_half_export(const std::string& language) {
  std::vector<ShaderExport> exports = every_export(language);
  std::erase_if(exports, [](const ShaderExport& e) { return e.exponent.value_or(8) > 1024; });
  for (ShaderExport& request : exports)
    request.precision =
        language == "glsl" ? ShaderPrecision::kMediump : ShaderPrecision::kMin16Float;
  return exports;
}

inline std::string function_name_of(const ShaderExport& request, ModelId model) {
  const std::string name =
      function_name({model, request.lobe, request.normalisation, request.exponent.value_or(1)},
                    request.exponent.has_value(), request.fresnel != Fresnel::kNone);
  return request.precision == ShaderPrecision::kFloat32
             ? name
             : fmt::format("{}_{}", name, kShaderPrecisionNames[int(request.precision)]);
}

/// A call of the exported function, with expressions for what it may take. `vectors` is "N, V, L".
inline std::string call_of(const ShaderExport& request, ModelId model, const std::string& vectors,
                           const std::string& exponent, const std::string& coefficient,
                           const std::string& reflectance) {
  std::string call = function_name_of(request, model) + "(" + vectors;
  if (!request.exponent) call += ", " + exponent;
  if (request.coefficient == CoefficientFrom::kArgument) call += ", " + coefficient;
  if (request.fresnel != Fresnel::kNone) call += ", " + reflectance;
  return call + ")";
}

/// The name of the function that computes the coefficient; "" if the export has none.
inline std::string coefficient_name_of(const ShaderExport& request, ModelId model) {
  const std::string name =
      function_name({model, request.lobe, request.normalisation}) + "_coefficient";
  return shader_text(request).find(name + "(float n)") == std::string::npos &&
                 shader_text(request).find(name + "(n: f32)") == std::string::npos
             ? ""
             : name;
}

}  // namespace lobelia
