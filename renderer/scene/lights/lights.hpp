// Questions to any light. No code outside this folder asks which type it is.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "renderer/scene/lights/catalogue.hpp"

namespace lobelia {

template <class List>
struct VariantOf;
template <class... L>
struct VariantOf<TypeList<L...>> {
  using Type = std::variant<L...>;
};
using Light = VariantOf<Lights>::Type;

const LightInfo& info(const Light& light);
inline bool is_delta(const Light& light) { return info(light).kind == LightKind::kDelta; }
inline bool is_area(const Light& light) { return info(light).kind == LightKind::kArea; }
inline bool is_environment(const Light& light) {
  return info(light).kind == LightKind::kEnvironment;
}

/// Irradiance, intensity or radiance.
Rgb strength(const Light& light);

LightBounds bounds(const Light& light);
/// How far it reaches from the centre of its bounds along a unit vector, to either side. 0 for a delta light.
double reach_along(const Light& light, Vec3 axis);

/// The lamp that a delta light is; none for others.
std::optional<Lamp> find_lamp(const Light& light);
/// The same of a delta light that is not infinitely far away.
std::optional<Lamp> find_near_lamp(const Light& light);
/// Throws Error(kInternal) for a light with a size.
Lamp lamp_of(const Light& light);
inline Illumination illuminate(const Light& light, Vec3 point) {
  return illuminate(lamp_of(light), point);
}
/// A single lamp in place of an area light, of the same power; none for others.
std::optional<Lamp> lamp_of_same_power(const Light& light);
Light light_of(const Lamp& lamp);

/// A parameter as it is written in a scene file.
using LightValue = std::variant<double, Vec3, Rgb, std::string>;
struct WrittenParameter {
  Parameter parameter;
  LightValue value;
};
std::vector<WrittenParameter> written_parameters(const Light& light);
/// The value of a parameter by its name. Throws Error(kInternal) where there is no such one.
LightValue value_of(const Light& light, std::string_view parameter);

/// The file that the light takes its radiance from, as the scene file names it; empty if there is none.
std::string picture_file(const Light& light);
/// That picture; null if there is none.
std::shared_ptr<const Image> picture_of(const Light& light);

}  // namespace lobelia
