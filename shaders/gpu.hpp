// Highlights as functions in GLSL, HLSL and OSL: one text in what the three have in common, whose
// lobes and coefficients come from renderer/.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "renderer/highlight.hpp"

namespace lobelia {

/// The words in which the three languages differ.
struct GpuLanguage {
  std::string_view vec3;    ///< the type of a vector
  std::string_view normal;  ///< name of a parameter; "normal" is a word of OSL's own
};

/// The functions of `highlights`, without the head. With `fixed_exponent` each has its own exponent in
/// it; otherwise the exponent is a parameter. Throws Error(kUsage) where that needs a coefficient
/// without a closed form, Error(kInput) where the paper has none.
std::string gpu_text(const GpuLanguage& language, std::span<const Highlight> highlights,
                     bool fixed_exponent);

}  // namespace lobelia
