// `lobelia export`: models as shader functions that do not depend on Lobelia.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/fresnel.hpp"
#include "renderer/highlight.hpp"

namespace lobelia {

/// Position in the catalogue of languages.
struct ShaderLanguage {
  std::uint8_t index = 0;
};
std::span<const std::string_view> shader_language_names();  ///< "glsl", ..., "povray"
std::optional<ShaderLanguage> find_shader_language(std::string_view name);

/// Where a function with an exponent as a parameter has its coefficient from.
enum class CoefficientFrom : std::uint8_t {
  kComputed,  ///< it computes it whenever it is called
  kArgument,  ///< it is given it; another function computes it, where there is a closed form
};
inline constexpr std::string_view kCoefficientNames[] = {"computed", "argument"};

/// The numbers of the functions; a coefficient is always computed in float32.
enum class ShaderPrecision : std::uint8_t {
  kFloat32,
  kMediump,     ///< GLSL's
  kMin16Float,  ///< HLSL's
};
inline constexpr std::string_view kShaderPrecisionNames[] = {"float32", "mediump", "min16float"};

struct ShaderExport {
  ShaderLanguage language;
  std::vector<ModelId> models;  ///< not empty
  LobeId lobe;
  Normalisation normalisation = Normalisation::kExact;
  std::optional<double> exponent;  ///< without one it is a parameter of the function
  CoefficientFrom coefficient = CoefficientFrom::kComputed;
  /// With Schlick's, the functions take F0 in red, green and blue, and return such a colour.
  Fresnel fresnel = Fresnel::kNone;
  /// With half floats, names of functions end in "_mediump" or "_min16float".
  ShaderPrecision precision = ShaderPrecision::kFloat32;
};

/// The text of the file. Throws Error(kUsage) if the language or the lobe does not go with the other members, and
/// Error(kInput) if the paper has no coefficient for the lobe.
std::string shader_text(const ShaderExport& request);

}  // namespace lobelia
