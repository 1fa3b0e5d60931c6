// The Fresnel factor: reflectance by angle.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "base/words/vec.hpp"

namespace lobelia {

enum class Fresnel : std::uint8_t {
  kNone,     ///< the same reflectance at every angle
  kSchlick,  ///< F0 + (F90 - F0) (1 - V.H)^5, F0 the reflectance head on; Schlick 1994, eq. (24)
};

std::span<const std::string_view> fresnel_names();  ///< "none", "schlick"
std::string_view name(Fresnel fresnel);
std::optional<Fresnel> find_fresnel(std::string_view name);

/// F90 of a mirror: 1, or 50 times the largest component of a reflectance below 0.02, which hardly any surface has.
/// So a mirror of reflectance 0 is none (Lagarde and de Rousiers 2014, "Moving Frostbite to Physically Based
/// Rendering"). The F90 of a highlight is always 1.
double mirror_at_grazing(Rgb reflectance);

/// The reflectance for unit vectors away from the surface; V.H is half the length of L + V.
Rgb fresnel_factor(Fresnel fresnel, Rgb reflectance, Vec3 to_eye, Vec3 to_light,
                   double at_grazing = 1);

}  // namespace lobelia
