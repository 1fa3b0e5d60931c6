// The Fresnel factor of a highlight: how its colour changes with the angle.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "core/vec.hpp"

namespace lobelia {

enum class Fresnel : std::uint8_t {
  kNone,     ///< the specular reflectance at every angle
  kSchlick,  ///< F0 + (1 - F0) (1 - V.H)^5, F0 the specular reflectance; Schlick 1994, eq. (24)
};

std::span<const std::string_view> fresnel_names();  ///< "none", "schlick"
std::string_view name(Fresnel fresnel);
std::optional<Fresnel> find_fresnel(std::string_view name);

/// The factor for unit vectors away from the surface; V.H is half the length of L + V.
Rgb fresnel_factor(Fresnel fresnel, Rgb reflectance, Vec3 to_eye, Vec3 to_light);

}  // namespace lobelia
