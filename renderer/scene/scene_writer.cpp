#include <fmt/format.h>

#include <algorithm>

#include "core/text.hpp"
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

std::string text(double value) { return fmt::format("{}", value); }
std::string text(const std::string& value) { return escape_markup(value); }

std::string emitter(const Light& light) {
  std::string xml = fmt::format("  <emitter type=\"{}\">\n", info(light).type);
  for (const auto& [parameter, value] : written_parameters(light))
    xml += fmt::format("    <{} name=\"{}\" value=\"{}\"/>\n", parameter_tag(parameter.type),
                       parameter.name, std::visit([](const auto& v) { return text(v); }, value));
  return xml + "  </emitter>\n";
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
      "{}"
      "  </bsdf>\n",
      info(h.model).name, index, info(h.lobe).name, name(h.normalisation), h.exponent,
      name(material.fresnel), text(material.specular_reflectance),
      text(material.diffuse_reflectance),
      is_black(material.mirror_reflectance)
          ? ""
          : fmt::format("    <rgb name=\"mirror_reflectance\" value=\"{}\"/>\n",
                        text(material.mirror_reflectance)));
}

std::string plane_shape(const Plane& plane) {
  return fmt::format(
      "  <shape type=\"plane\">\n"
      "    <point name=\"point\" value=\"{}\"/>\n"
      "    <vector name=\"normal\" value=\"{}\"/>\n"
      "    <float name=\"checker_size\" value=\"{}\"/>\n"
      "    <ref id=\"material_{}\"/>\n"
      "{}"
      "  </shape>\n",
      text(plane.point), text(plane.normal), plane.checker_size, plane.material,
      plane.checker_material == plane.material
          ? ""
          : fmt::format("    <ref id=\"material_{}\"/>\n", plane.checker_material));
}

// Defaults are not written, so the text of a plain scene is short.

std::string lens(const Camera& camera) {
  if (camera.aperture_radius == 0 && camera.focus_distance == Camera{}.focus_distance) return "";
  return fmt::format(
      "    <float name=\"aperture_radius\" value=\"{}\"/>\n"
      "    <float name=\"focus_distance\" value=\"{}\"/>\n",
      camera.aperture_radius, camera.focus_distance);
}

std::string principal_point(const Camera& camera) {
  if (camera.principal_point_offset_x == 0 && camera.principal_point_offset_y == 0) return "";
  return fmt::format(
      "    <float name=\"principal_point_offset_x\" value=\"{}\"/>\n"
      "    <float name=\"principal_point_offset_y\" value=\"{}\"/>\n",
      camera.principal_point_offset_x, camera.principal_point_offset_y);
}

std::string filter(Filter filter) {
  if (filter == Filter{}) return "";
  return fmt::format(
      "      <rfilter type=\"{}\">\n"
      "        <float name=\"radius\" value=\"{}\"/>\n"
      "      </rfilter>\n",
      name(filter), filter.radius);
}

std::string integrator(const Scene& scene) {
  const auto is_mirror = [](const Material& m) { return !is_black(m.mirror_reflectance); };
  // With a mirror the reader has a default of its own.
  if (scene.depth.mirror == 0 && scene.depth.glossy == 0 &&
      std::none_of(scene.materials.begin(), scene.materials.end(), is_mirror))
    return "";
  return fmt::format(
      "  <integrator type=\"path\">\n"
      "    <integer name=\"mirror_depth\" value=\"{}\"/>\n"
      "    <integer name=\"glossy_depth\" value=\"{}\"/>\n"
      "  </integrator>\n",
      scene.depth.mirror, scene.depth.glossy);
}

}  // namespace

std::string scene_to_xml(const Scene& scene) {
  const std::string lens_text = lens(scene.camera);
  std::string xml = fmt::format(
      "<scene version=\"{}\">\n"
      "  <sensor type=\"{}\">\n"
      "    <float name=\"fov\" value=\"{}\"/>\n"
      "{}{}"
      "    <transform name=\"to_world\">\n"
      "      <lookat origin=\"{}\" target=\"{}\" up=\"{}\"/>\n"
      "    </transform>\n"
      "    <film type=\"hdrfilm\">\n"
      "      <integer name=\"width\" value=\"{}\"/>\n"
      "      <integer name=\"height\" value=\"{}\"/>\n"
      "{}"
      "    </film>\n"
      "    <sampler type=\"independent\">\n"
      "      <integer name=\"sample_count\" value=\"{}\"/>\n"
      "      <integer name=\"seed\" value=\"{}\"/>\n"
      "    </sampler>\n"
      "  </sensor>\n",
      kSceneFormatVersion, lens_text.empty() ? kPerspective.type : kThinLens.type,
      scene.camera.fov_degrees, lens_text, principal_point(scene.camera), text(scene.camera.origin),
      text(scene.camera.target), text(scene.camera.up), scene.film.width, scene.film.height,
      filter(scene.film.filter), scene.sampler.sample_count, scene.sampler.seed);
  xml += integrator(scene);
  for (const Light& light : scene.lights) xml += emitter(light);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) xml += bsdf(scene.materials[i], i);
  for (const auto& sphere : scene.spheres)
    xml += fmt::format(
        "  <shape type=\"sphere\">\n"
        "    <point name=\"center\" value=\"{}\"/>\n"
        "    <float name=\"radius\" value=\"{}\"/>\n"
        "    <ref id=\"material_{}\"/>\n"
        "  </shape>\n",
        text(sphere.center), sphere.radius, sphere.material);
  for (const auto& plane : scene.planes) xml += plane_shape(plane);
  return xml + "</scene>\n";
}

}  // namespace lobelia
