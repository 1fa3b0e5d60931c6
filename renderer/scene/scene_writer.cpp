#include <fmt/format.h>

#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

// fmt writes the shortest digits that read back to the same double.
std::string text(Vec3 v) { return fmt::format("{}, {}, {}", v.x, v.y, v.z); }
std::string text(Rgb c) {
  return c.r == c.g && c.g == c.b ? fmt::format("{}", c.r)
                                  : fmt::format("{}, {}, {}", c.r, c.g, c.b);
}

std::string emitter(const DirectionalLight& light) {
  return fmt::format(
      "  <emitter type=\"directional\">\n"
      "    <vector name=\"direction\" value=\"{}\"/>\n"
      "    <rgb name=\"irradiance\" value=\"{}\"/>\n"
      "  </emitter>\n",
      text(light.direction), text(light.irradiance));
}

std::string emitter(const PointLight& light) {
  return fmt::format(
      "  <emitter type=\"point\">\n"
      "    <point name=\"position\" value=\"{}\"/>\n"
      "    <rgb name=\"intensity\" value=\"{}\"/>\n"
      "  </emitter>\n",
      text(light.position), text(light.intensity));
}

std::string emitter(const SphereLight& light) {
  return fmt::format(
      "  <emitter type=\"sphere\">\n"
      "    <point name=\"center\" value=\"{}\"/>\n"
      "    <float name=\"radius\" value=\"{}\"/>\n"
      "    <rgb name=\"radiance\" value=\"{}\"/>\n"
      "  </emitter>\n",
      text(light.center), light.radius, text(light.radiance));
}

std::string emitter(const RectangleLight& light) {
  return fmt::format(
      "  <emitter type=\"rectangle\">\n"
      "    <point name=\"center\" value=\"{}\"/>\n"
      "    <vector name=\"half_u\" value=\"{}\"/>\n"
      "    <vector name=\"half_v\" value=\"{}\"/>\n"
      "    <rgb name=\"radiance\" value=\"{}\"/>\n"
      "  </emitter>\n",
      text(light.center), text(light.half_u), text(light.half_v), text(light.radiance));
}

std::string emitter(const EnvironmentLight& light) {
  return fmt::format(
      "  <emitter type=\"constant\">\n"
      "    <rgb name=\"radiance\" value=\"{}\"/>\n"
      "  </emitter>\n",
      text(light.radiance));
}

std::string bsdf(const Material& material, std::size_t index) {
  const Highlight& h = material.highlight;
  return fmt::format(
      "  <bsdf type=\"{}\" id=\"material_{}\">\n"
      "    <string name=\"lobe\" value=\"{}\"/>\n"
      "    <string name=\"normalisation\" value=\"{}\"/>\n"
      "    <float name=\"exponent\" value=\"{}\"/>\n"
      "    <string name=\"fresnel\" value=\"{}\"/>\n"
      "    <rgb name=\"specular_reflectance\" value=\"{}\"/>\n"
      "    <rgb name=\"diffuse_reflectance\" value=\"{}\"/>\n"
      "  </bsdf>\n",
      info(h.model).name, index, info(h.lobe).name, name(h.normalisation), h.exponent,
      name(material.fresnel), text(material.specular_reflectance),
      text(material.diffuse_reflectance));
}

}  // namespace

std::string scene_to_xml(const Scene& scene) {
  std::string xml = fmt::format(
      "<scene version=\"{}\">\n"
      "  <sensor type=\"perspective\">\n"
      "    <float name=\"fov\" value=\"{}\"/>\n"
      "    <transform name=\"to_world\">\n"
      "      <lookat origin=\"{}\" target=\"{}\" up=\"{}\"/>\n"
      "    </transform>\n"
      "    <film type=\"hdrfilm\">\n"
      "      <integer name=\"width\" value=\"{}\"/>\n"
      "      <integer name=\"height\" value=\"{}\"/>\n"
      "    </film>\n"
      "    <sampler type=\"independent\">\n"
      "      <integer name=\"sample_count\" value=\"{}\"/>\n"
      "      <integer name=\"seed\" value=\"{}\"/>\n"
      "    </sampler>\n"
      "  </sensor>\n",
      kSceneFormatVersion, scene.camera.fov_degrees, text(scene.camera.origin),
      text(scene.camera.target), text(scene.camera.up), scene.film.width, scene.film.height,
      scene.sampler.sample_count, scene.sampler.seed);
  for (const auto& light : scene.lights)
    xml += std::visit([](const auto& l) { return emitter(l); }, light);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) xml += bsdf(scene.materials[i], i);
  for (const auto& sphere : scene.spheres)
    xml += fmt::format(
        "  <shape type=\"sphere\">\n"
        "    <point name=\"center\" value=\"{}\"/>\n"
        "    <float name=\"radius\" value=\"{}\"/>\n"
        "    <ref id=\"material_{}\"/>\n"
        "  </shape>\n",
        text(sphere.center), sphere.radius, sphere.material);
  return xml + "</scene>\n";
}

}  // namespace lobelia
