// Functions for any light. No code outside this folder depends on its type.
#pragma once

#include <optional>
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
/// Half of the light's extent along a unit vector, from the centre of its bounds. 0 for a delta light.
double reach_along(const Light& light, Vec3 axis);

/// The lamp of a delta light; none for others.
std::optional<Lamp> find_lamp(const Light& light);
/// The lamp of a delta light that is not infinitely far away; none for others.
std::optional<Lamp> find_near_lamp(const Light& light);
/// Throws Error(kInternal) for a light with a size.
Lamp lamp_of(const Light& light);
inline Illumination illuminate(const Light& light, Vec3 point) {
  return illuminate(lamp_of(light), point);
}
/// A single lamp with the power of an area light; none for others.
std::optional<Lamp> lamp_of_same_power(const Light& light);
Light light_of(const Lamp& lamp);

/// A parameter as it is written in a scene file.
using LightValue = std::variant<double, Vec3, Rgb, std::string>;
struct WrittenParameter {
  Parameter parameter;
  LightValue value;
};
std::vector<WrittenParameter> written_parameters(const Light& light);
/// The value of a parameter. Throws Error(kInternal) if there is no such parameter.
LightValue value_of(const Light& light, std::string_view parameter);

/// The light's picture file, as the scene file names it; empty if it has none.
std::string picture_file(const Light& light);
/// The picture; null if the light has none.
std::shared_ptr<const Image> picture_of(const Light& light);

}  // namespace lobelia
