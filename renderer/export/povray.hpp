// A highlight in POV-Ray's scene description language: an include file with the lobe as a pattern function and the
// coefficient as a macro.
//
// The formulas in renderer/export/povray/ are written by hand from the models' definitions and not from renderer/, so that
// a mistake on either side shows in the pictures. The exponent is not fixed: POV-Ray computes the coefficient when
// it reads the scene.
#pragma once

#include "renderer/highlight.hpp"

namespace lobelia {

/// The names that the include file of `highlight` defines; its exponent does not matter.
struct PovrayNames {
  std::string file;         ///< "lobelia_modified_phong_cs16.inc"
  std::string pattern;      ///< "Lobelia_Modified_Phong_Cs16", of normal, light, eye and exponent
  std::string coefficient;  ///< "Lobelia_Modified_Phong_Cs16_Coefficient", of the exponent
  std::string brilliance;   ///< "Lobelia_Modified_Phong_Brilliance": the power of N.L, 0 or 1
};
PovrayNames povray_names(const Highlight& highlight);

/// The include file. Throws Error(kInput) if the paper has no coefficient for the lobe, and Error(kInternal) if
/// renderer/export/povray/ has no formula.
std::string povray_text(std::span<const Highlight> highlights);

}  // namespace lobelia
