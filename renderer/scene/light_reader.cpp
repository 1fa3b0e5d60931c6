#include "renderer/scene/light_reader.hpp"

#include <cmath>

#include "core/error.hpp"

namespace lobelia {

std::optional<Light> LightReader::read(pugi::xml_node node) {
  reader_.source().check_attributes(node, {"type", "id"});
  const ElementFormat* format = reader_.format_of(node, kEmitters);
  if (!format) return std::nullopt;
  const Values values = reader_.read_parameters(node, format->parameters, {});
  if (format->type == kPoint.type)
    return PointLight{values.vec3("position"), values.rgb("intensity"),
                      reader_.direction_or_none(values, "normal")};
  if (format->type == kSphereLight.type)
    return SphereLight{values.vec3("center"), values.number("radius"), values.rgb("radiance")};
  if (format->type == kRectangle.type) return rectangle(node, values);
  if (format->type == kConstant.type) return EnvironmentLight{values.rgb("radiance"), {}, {}};
  if (format->type == kEnvmap.type) return envmap(values);
  return DirectionalLight{reader_.direction(node, values, "direction"), values.rgb("irradiance")};
}

std::optional<Light> LightReader::rectangle(pugi::xml_node node, const Values& values) {
  const Vec3 u = values.vec3("half_u"), v = values.vec3("half_v");
  // After an error both are (1, 1, 1), which would be another one.
  const bool good = values["half_u"].node && values["half_v"].node;
  const double cosine = dot(u, v) / (length(u) * length(v));
  for (const char* name : {"half_u", "half_v"})
    if (const double l = length(values.vec3(name)); good && l < kNear) {
      const pugi::xml_node where = values[name].node;
      reader_.source().error(where.attribute("value"), where,
                             fmt::format("{} is {:g} long; allowed: {:g} or more", name, l, kNear));
      return std::nullopt;
    }
  if (good && std::abs(cosine) > 1e-6) {
    reader_.source().error(
        node,
        fmt::format("half_u and half_v are not perpendicular: the cosine between them is {:g}; "
                    "allowed: -1e-06 to 1e-06",
                    cosine));
    return std::nullopt;
  }
  return RectangleLight{values.vec3("center"), u, v, values.rgb("radiance")};
}

std::optional<Light> LightReader::envmap(const Values& values) {
  const Values::Value& file = values["filename"];
  if (!file.node) return std::nullopt;  // it is missing, which was said
  try {
    return EnvironmentLight{values.rgb("radiance"), maps_.read(file.text), file.text};
  } catch (const Error& error) {
    if (error.code() != ExitCode::kInput) throw;
    reader_.source().error(file.node.attribute("value"), file.node, error.what());
  }
  return std::nullopt;
}

}  // namespace lobelia
