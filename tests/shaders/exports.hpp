// All that can be exported: what the tests of this room go through.
#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"
#include "shaders/export.hpp"
#include "shaders/names.hpp"

namespace lobelia {

inline constexpr double kFixedExponents[] = {1, 16, 64, 1024, 1e5};

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

/// Every model with every lobe and normalisation, with a run-time exponent where that is possible and
/// with fixed ones. All of them can stand in one shader.
inline std::vector<ShaderExport> every_export(const std::string& language) {
  std::vector<ShaderExport> exports;
  for (const LobeId lobe : every_lobe())
    for (const Normalisation normalisation : {Normalisation::kExact, Normalisation::kPaper}) {
      if (normalisation == Normalisation::kPaper && !has_paper_coefficient(lobe)) continue;
      ShaderExport request{*find_shader_language(language),
                           {all_models().begin(), all_models().end()},
                           lobe,
                           normalisation,
                           {}};
      if (can_be_made(request)) exports.push_back(request);
      for (const double n : kFixedExponents) {
        request.exponent = n;
        exports.push_back(request);
      }
    }
  return exports;
}

inline std::string function_name_of(const ShaderExport& request, ModelId model) {
  return function_name({model, request.lobe, request.normalisation, request.exponent.value_or(1)},
                       request.exponent.has_value());
}

}  // namespace lobelia
