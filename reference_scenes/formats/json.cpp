// A scene as a flat record: everything resolved to numbers, nothing to look up.
#include "base/records/record.hpp"
#include "reference_scenes/formats/catalogue.hpp"

namespace lobelia {
namespace {

records::Triple triple(Vec3 v) { return {v.x, v.y, v.z}; }
records::Triple triple(Rgb c) { return {c.r, c.g, c.b}; }

records::SceneCamera camera_record(const Scene& scene) {
  const CameraFrame frame = camera_frame(scene.camera, scene.film);
  return {triple(frame.origin),
          triple(frame.right),
          triple(frame.up),
          triple(frame.forward),
          frame.half_width,
          frame.half_height,
          frame.shift_u,
          frame.shift_v,
          scene.camera.aperture_radius,
          scene.camera.focus_distance};
}

/// Where the record has a parameter of that name; why_not_spelled_out() refuses lights with others.
std::optional<records::Triple>* place_of(records::SceneLight& record, std::string_view parameter) {
  const std::pair<std::string_view, std::optional<records::Triple>*> places[] = {
      {"position", &record.position}, {"direction", &record.direction}, {"normal", &record.normal},
      {"center", &record.center},     {"half_u", &record.half_u},       {"half_v", &record.half_v},
  };
  for (const auto& [name, place] : places)
    if (name == parameter) return place;
  return nullptr;
}

records::SceneLight light_record(const Light& light) {
  constexpr std::string_view kKinds[] = {"delta", "area", "environment"};
  records::SceneLight record;
  record.type = info(light).type;
  record.kind = kKinds[std::size_t(info(light).kind)];
  record.strength = triple(strength(light));
  record.filename = picture_file(light);
  for (const auto& [parameter, value] : written_parameters(light)) {
    if (std::holds_alternative<Rgb>(value)) record.unit = parameter.unit;
    if (const auto* number = std::get_if<double>(&value))
      (parameter.name == "cutoff_angle" ? record.cutoff_degrees
       : parameter.name == "beam_width" ? record.beam_degrees
                                        : record.radius) = *number;
    const auto* vector = std::get_if<Vec3>(&value);
    if (auto* const place = place_of(record, parameter.name); place && vector)
      *place = triple(*vector);
  }
  return record;
}

records::ScenePlane plane_record(const Plane& plane) {
  records::ScenePlane record{triple(plane.point), triple(plane.normal), plane.material, {}, {}};
  if (plane.checker_material != plane.material) {
    record.checker_material = plane.checker_material;
    record.checker_size = plane.checker_size;
  }
  return record;
}

records::SceneMaterial material_record(const Material& material) {
  const Highlight& highlight = material.highlight;
  const ModelInfo& model = info(highlight.model);
  records::SceneMaterial record;
  record.id = material.id;
  record.model = model.name;
  record.lobe = info(highlight.lobe).name;
  record.normalisation = name(highlight.normalisation);
  record.lobe_formula = info(highlight.lobe).formula;
  record.angle = model.angle == LobeAngle::kReflection ? "reflection" : "halfVector";
  record.applies_cosine = model.applies_cosine;
  record.has_shadowing = model.has_shadowing;
  record.exponent = highlight.exponent;
  record.coefficient = radiance_coefficient(highlight);
  record.specular = triple(material.specular_reflectance);
  record.diffuse = triple(material.diffuse_reflectance);
  record.mirror = triple(material.mirror_reflectance);
  record.fresnel = name(material.fresnel);
  record.mirror_at_grazing = mirror_at_grazing(material.mirror_reflectance);
  return record;
}

}  // namespace

records::Scene scene_record(const Scene& scene) {
  records::Scene record;
  record.camera = camera_record(scene);
  record.film = {scene.film.width,
                 scene.film.height,
                 scene.sampler.sample_count,
                 scene.sampler.seed,
                 std::string(name(scene.film.filter)),
                 scene.film.filter.radius};
  record.depth = {scene.depth.mirror, scene.depth.glossy};
  for (const Light& light : scene.lights) record.lights.push_back(light_record(light));
  for (const Material& material : scene.materials)
    record.materials.push_back(material_record(material));
  for (const Sphere& sphere : scene.spheres)
    record.spheres.push_back({triple(sphere.center), sphere.radius, sphere.material});
  for (const Plane& plane : scene.planes) record.planes.push_back(plane_record(plane));
  return record;
}

constinit const SceneFormat kJsonFormat{
    "json",
    "JSON",
    "scene.json",
    "a flat record of numbers (lobelia records scene): axes of the camera, coefficients, lights with their units",
    why_not_spelled_out,
    [](const Scene& scene) {
      return std::map<std::string, std::string>{{"scene.json", record_text(scene_record(scene))}};
    },
};

}  // namespace lobelia
