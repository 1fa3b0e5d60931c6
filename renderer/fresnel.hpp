// The Fresnel factor of a highlight: how its colour changes with the angle.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/vec.hpp"

namespace lobelia {

enum class Fresnel : std::uint8_t {
  kNone,     ///< the same reflectance at every angle
  kSchlick,  ///< F0 + (F90 - F0) (1 - V.H)^5, F0 the reflectance head on; Schlick 1994, eq. (24)
};

std::span<const std::string_view> fresnel_names();  ///< "none", "schlick"
std::string_view name(Fresnel fresnel);
std::optional<Fresnel> find_fresnel(std::string_view name);

/// F90 of a mirror: 1, but in proportion to its largest component where that is below 0.02, as hardly any
/// surface's is, so that a mirror of reflectance 0 is none (Lagarde and de Rousiers 2014, "Moving Frostbite
/// to Physically Based Rendering"). A highlight's F90 is 1.
double mirror_at_grazing(Rgb reflectance);

/// The factor for unit vectors away from the surface; V.H is half the length of L + V.
Rgb fresnel_factor(Fresnel fresnel, Rgb reflectance, Vec3 to_eye, Vec3 to_light,
                   double at_grazing = 1);

}  // namespace lobelia
