#include <fmt/format.h>

#include "base/words/text.hpp"
#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/scene_io.hpp"

namespace lobelia {
namespace {

// fmt writes the shortest digits that read back to the same double.
std::string text(double value) { return fmt::format("{}", value); }
std::string text(Vec3 v) { return fmt::format("{}, {}, {}", v.x, v.y, v.z); }
std::string text(Rgb c) {
  return c.r == c.g && c.g == c.b ? text(c.r) : fmt::format("{}, {}, {}", c.r, c.g, c.b);
}
std::string text(std::string_view value) { return escape_markup(value); }

std::string line(int indent, const Parameter& parameter, std::string_view value) {
  return fmt::format("{:{}}<{} name=\"{}\" value=\"{}\"/>\n", "", indent,
                     parameter_tag(parameter.type), parameter.name, value);
}

/// The parameters of a table with their values, in its order.
std::string lines(int indent, std::span<const Parameter> table,
                  std::initializer_list<std::string> values) {
  std::string xml;
  for (std::size_t i = 0; i < table.size(); ++i) xml += line(indent, table[i], values.begin()[i]);
  return xml;
}

std::string emitter(const Light& light) {
  std::string xml = fmt::format("  <emitter type=\"{}\">\n", info(light).type);
  for (const auto& [parameter, value] : written_parameters(light))
    xml += line(4, parameter, std::visit([](const auto& v) { return text(v); }, value));
  return xml + "  </emitter>\n";
}

std::string bsdf(const Material& material, std::size_t index) {
  const Highlight& h = material.highlight;
  const std::span<const Parameter> all(kHighlightParameters), lobe = all.first(2),
                                                              others = all.subspan(2);
  return fmt::format("  <bsdf type=\"{}\" id=\"material_{}\">\n", info(h.model).name, index) +
         lines(4, lobe.first(h.lobe.formula ? 2 : 1),
               {text(info(h.lobe).name), text(info(h.lobe).formula)}) +
         lines(4, is_mirror(material) ? others : others.first(others.size() - 1),
               {text(name(h.normalisation)), text(h.exponent), text(name(material.fresnel)),
                text(material.specular_reflectance), text(material.diffuse_reflectance),
                text(material.mirror_reflectance)}) +
         "  </bsdf>\n";
}

std::string shape(const ElementFormat& format, std::initializer_list<std::string> values,
                  std::initializer_list<int> materials) {
  std::string xml = fmt::format("  <shape type=\"{}\">\n", format.type);
  xml += lines(4, format.parameters, values);
  for (const int material : materials)
    xml += fmt::format("    <ref id=\"material_{}\"/>\n", material);
  return xml + "  </shape>\n";
}

std::string plane_shape(const Plane& plane) {
  const auto of = [&](std::initializer_list<int> materials) {
    return shape(kPlane, {text(plane.point), text(plane.normal), text(plane.checker_size)},
                 materials);
  };
  return plane.checker_material == plane.material ? of({plane.material})
                                                  : of({plane.material, plane.checker_material});
}

// Defaults are not written, to keep plain scenes short.

std::string filter(Filter filter) {
  if (filter == Filter{}) return "";
  return fmt::format("      <rfilter type=\"{}\">\n{}      </rfilter>\n", name(filter),
                     lines(8, filter_formats().front().parameters, {text(filter.radius)}));
}

std::string integrator(const Scene& scene) {
  // The reader's default is not 0 with a mirror.
  if (scene.depth.mirror == 0 && scene.depth.glossy == 0 &&
      std::ranges::none_of(scene.materials, is_mirror))
    return "";
  return "  <integrator type=\"path\">\n" +
         lines(4, kIntegrator.parameters,
               {std::to_string(scene.depth.mirror), std::to_string(scene.depth.glossy)}) +
         "  </integrator>\n";
}

std::string sensor(const Scene& scene) {
  const Camera& c = scene.camera;
  const bool lens = c.aperture_radius != 0 || c.focus_distance != Camera{}.focus_distance;
  const bool offset = c.principal_point_offset_x != 0 || c.principal_point_offset_y != 0;
  return fmt::format("  <sensor type=\"{}\">\n", lens ? kThinLens.type : kPerspective.type) +
         lines(4, kThinLens.parameters.first(lens ? 3 : 1),
               {text(c.fov_degrees), text(c.aperture_radius), text(c.focus_distance)}) +
         lines(4, kThinLens.parameters.last(offset ? 2 : 0),
               {text(c.principal_point_offset_x), text(c.principal_point_offset_y)}) +
         fmt::format(
             "    <transform name=\"to_world\">\n"
             "      <lookat origin=\"{}\" target=\"{}\" up=\"{}\"/>\n"
             "    </transform>\n"
             "    <film type=\"hdrfilm\">\n",
             text(c.origin), text(c.target), text(c.up)) +
         lines(6, kFilm.parameters,
               {std::to_string(scene.film.width), std::to_string(scene.film.height)}) +
         filter(scene.film.filter) + "    </film>\n    <sampler type=\"independent\">\n" +
         lines(6, kSampler.parameters,
               {std::to_string(scene.sampler.sample_count), std::to_string(scene.sampler.seed)}) +
         "    </sampler>\n  </sensor>\n";
}

}  // namespace

std::string scene_to_xml(const Scene& scene) {
  std::string xml = fmt::format("<scene version=\"{}\">\n", kSceneFormatVersion);
  xml += sensor(scene) + integrator(scene);
  for (const Light& light : scene.lights) xml += emitter(light);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) xml += bsdf(scene.materials[i], i);
  for (const Sphere& sphere : scene.spheres)
    xml += shape(kSphere, {text(sphere.center), text(sphere.radius)}, {sphere.material});
  for (const Plane& plane : scene.planes) xml += plane_shape(plane);
  return xml + "</scene>\n";
}

}  // namespace lobelia
