// `lobelia export`: models as shader functions that do not depend on Lobelia.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/highlight.hpp"

namespace lobelia {

/// Position in the catalogue of languages.
struct ShaderLanguage {
  std::uint8_t index = 0;
};
std::span<const std::string_view> shader_language_names();  ///< "glsl", "hlsl", "osl", "povray"
std::optional<ShaderLanguage> find_shader_language(std::string_view name);

struct ShaderExport {
  ShaderLanguage language;
  std::vector<ModelId> models;  ///< not empty
  LobeId lobe;
  Normalisation normalisation = Normalisation::kExact;
  std::optional<double> exponent;  ///< without one it is a parameter of the function
};

/// The text of the file. Throws Error(kUsage) if the language or the lobe needs an exponent or does not allow one,
/// and Error(kInput) if the paper has no coefficient for the lobe.
std::string shader_text(const ShaderExport& request);

}  // namespace lobelia
