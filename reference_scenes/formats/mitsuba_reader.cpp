// Reads Mitsuba's scene files. What stands in them is untrusted: sizes, depths and numbers are bounded.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/system/error.hpp"
#include "reference_scenes/formats/mitsuba.hpp"
#include "reference_scenes/formats/mitsuba_source.hpp"
#include "renderer/scene/lights/light_reader.hpp"

namespace lobelia {
namespace {

constexpr int kUnlimitedDepth = kMaxDepth;

constexpr Parameter kMitsubaIntegratorParameters[] = {
    {"max_depth", ParameterType::kInteger, "-1", -1, 1e6, "", ""},
};
constexpr Parameter kMitsubaPhongParameters[] = {
    {"exponent", ParameterType::kFloat, "30", kMinExponent, kMaxExponent, "", ""},
    {"specular_reflectance", ParameterType::kRgb, "0.2", 0, 1, "", ""},
    {"diffuse_reflectance", ParameterType::kRgb, "0.5", 0, 1, "", ""},
};
/// The exponent is 2 / alpha^2 - 2, and may be 0 to 1e8.
constexpr double kLeastAlpha = 1.5e-4, kMostAlpha = 1;
constexpr Parameter kMitsubaConductorParameters[] = {
    {"distribution", ParameterType::kString, "beckmann", 0, 0, "", ""},
    {"material", ParameterType::kString, "none", 0, 0, "", ""},
    {"alpha", ParameterType::kFloat, "0.1", kLeastAlpha, kMostAlpha, "", ""},
    {"specular_reflectance", ParameterType::kRgb, "1", 0, 1, "", ""},
};
constexpr Parameter kMitsubaDiffuseParameters[] = {
    {"reflectance", ParameterType::kRgb, "0.5", 0, 1, "", ""},
};
constexpr Parameter kMitsubaEnvmapParameters[] = {
    {"filename", ParameterType::kString, "", 0, 0, "", "the picture"},
    {"scale", ParameterType::kFloat, "1", 0, kBrightest, "", ""},
};
constexpr Parameter kMitsubaAreaParameters[] = {
    {"radiance", ParameterType::kRgb, "1", 0, kBrightest, "W/(m^2 sr)", ""},
};
class MitsubaReader {
 public:
  MitsubaReader(MitsubaSource& source, const std::filesystem::path& directory)
      : file_(source),
        source_(source.xml()),
        reader_(source.reader()),
        lights_(reader_, directory),
        maps_(directory) {}

  Scene read() {
    const auto root = source_.root();
    // Materials first, so that a shape may refer to a later one.
    for (const auto node : root.children("bsdf")) name_material(node);
    for (const auto node : reader_.elements(root)) {
      const std::string_view tag = node.name();
      if (tag == "bsdf" || tag == "default") continue;
      if (tag == "sensor") {
        if (reader_.once(node, sensors_)) has_camera_ = read_mitsuba_sensor(file_, node, scene_);
      } else if (tag == "emitter")
        read_emitter(node);
      else if (tag == "shape")
        read_shape(node);
      else if (tag == "integrator")
        read_integrator(node);
      else if (tag == "include")
        file_.unsupported(node, "other files are not read: put its contents here");
      else
        file_.unsupported(node, "it is left out");
    }
    lights_.check_pairs(root, scene_.lights.size(), scene_.spheres.size() + scene_.planes.size());
    if (!has_camera_)
      source_.error(root, "what remains is no scene: it has no <sensor> that can be read");
    if (scene_.spheres.empty() && scene_.planes.empty())
      source_.error(root, "what remains is no scene: it has no <shape> that can be read");
    if (!has_camera_ || (scene_.spheres.empty() && scene_.planes.empty()))
      source_.throw_if_errors();
    return std::move(scene_);
  }

 private:
  /// Whether reading reported nothing.
  template <class Read>
  bool without_problem(Read read) {
    const std::size_t before = source_.error_count();
    read();
    return source_.error_count() == before;
  }

  void read_integrator(pugi::xml_node node) {
    if (file_.flag(node, "hide_emitters"))
      source_.error(node, "hide_emitters is not supported: the camera sees lights with a size");
    if (MitsubaSource::type(node) == "direct") return;
    if (MitsubaSource::type(node) != "path")
      return file_.unsupported(node, "light is followed straight from the lights only");
    const int depth =
        int(file_.values(node, kMitsubaIntegratorParameters, {"boolean"}).number("max_depth"));
    scene_.depth.glossy =
        depth < 0 ? kUnlimitedDepth : std::clamp(depth - kMitsubaDirectDepth, 0, kMaxDepth);
    if (depth < 0 || depth - kMitsubaDirectDepth > kMaxDepth)
      source_.error(
          node,
          fmt::format("light is followed {} times at most, not without limit; give a max_depth",
                      kUnlimitedDepth));
    if (depth == 0 || depth == 1)
      source_.error(node, fmt::format("max_depth {} leaves the surfaces black; it is read as {}",
                                      depth, kMitsubaDirectDepth));
  }

  void read_emitter(pugi::xml_node node) {
    if (!reader_.within(node, "emitters", kMaxLights, std::int64_t(scene_.lights.size()))) return;
    const std::string_view type = MitsubaSource::type(node);
    std::optional<Light> light;
    if (!without_problem([&] {
          if (type == "directional")
            light = placed(node, "vector", "direction", {0, 0, 1});
          else if (type == "point")
            light = placed(node, "point", "position", {});
          else if (type == "constant")
            light = lights_.read(node);
          else if (type == "envmap")
            light = envmap(node);
          else
            file_.unsupported(node, "it is left out");
        }))
      return;
    if (light) scene_.lights.push_back(*light);
  }

  /// A light without a size, whose place or direction may be `original` turned and moved by to_world.
  std::optional<Light> placed(pugi::xml_node node, const char* tag, const char* parameter,
                              Vec3 original) {
    const auto transform = file_.transform(node);
    if (!transform) return std::nullopt;
    const bool has_parameter(node.find_child_by_attribute("name", parameter));
    if (has_parameter && node.child("transform")) {
      source_.error(node,
                    fmt::format("it has both a to_world and a {}; one is allowed", parameter));
      return std::nullopt;
    }
    if (!has_parameter) {
      while (node.remove_child("transform")) {
      }
      const bool is_place = std::string_view(tag) == "point";
      const Vec3 v =
          is_place ? transform->matrix.of_point(original) : transform->matrix.of_vector(original);
      auto made = node.append_child(tag);
      made.append_attribute("name").set_value(parameter);
      made.append_attribute("value").set_value(
          fmt::format("{:.17g}, {:.17g}, {:.17g}", v.x, v.y, v.z).c_str());
    }
    return lights_.read(node);
  }

  std::optional<Light> envmap(pugi::xml_node node) {
    if (!lights_.count_environment(node)) return std::nullopt;
    const Values values = file_.values(node, kMitsubaEnvmapParameters, {"transform", "boolean"});
    const auto transform = file_.transform(node);
    if (!transform || !values.contains("filename") || !values["filename"].node) return std::nullopt;
    const auto stays = [&](Vec3 axis, Vec3 to) {
      return length(transform->matrix.of_vector(axis) - to) < 1e-6;
    };
    if (!stays({0, 1, 0}, {0, 1, 0}) || !stays({0, 0, 1}, {0, 0, -1}) ||
        !stays({1, 0, 0}, {-1, 0, 0})) {
      source_.error(
          node,
          "its picture is not turned by 180 degrees about y; Lobelia has -z in the middle of the picture and "
          "Mitsuba at its edge, so the picture would have to be moved by half of its width");
      return std::nullopt;
    }
    const double scale = values.number("scale");
    EnvmapLight light{{scale, scale, scale}, nullptr, values["filename"].text};
    try {
      light.image = maps_.read(light.file);
    } catch (const Error& problem) {
      if (problem.code() != ExitCode::kInput) throw;
      source_.error(values["filename"].node, problem.what());
      return std::nullopt;
    }
    return light;
  }

  Material material_of(pugi::xml_node node) {
    Material material;
    material.id = node.attribute("id").value();
    material.highlight = {*find_model(kMitsubaModel), *find_lobe(kMitsubaLobe)};
    material.diffuse_reflectance = kGrey;
    // Surfaces are lit from both sides anyway.
    for (int depth = 0; MitsubaSource::type(node) == "twosided" && node.child("bsdf") && depth < 4;
         ++depth)
      node = node.child("bsdf");
    if (MitsubaSource::type(node) == "phong") {
      const Values values = file_.values(node, kMitsubaPhongParameters, {"boolean"});
      material.highlight.exponent = values.number("exponent");
      material.specular_reflectance = values.rgb("specular_reflectance");
      material.diffuse_reflectance = values.rgb("diffuse_reflectance");
    } else if (is_plain_ggx(node)) {
      const Values values = file_.values(node, kMitsubaConductorParameters, {"boolean"});
      set_model(material.highlight, kGgx);
      material.highlight.exponent = exponent_of_alpha(values.number("alpha"));
      material.specular_reflectance = values.rgb("specular_reflectance");
      material.diffuse_reflectance = {};
    } else if (MitsubaSource::type(node) == "diffuse") {
      material.diffuse_reflectance =
          file_.values(node, kMitsubaDiffuseParameters).rgb("reflectance");
    } else {
      file_.unsupported(node, "its surfaces are diffuse with a reflectance of 0.5 instead");
    }
    return material;
  }

  /// A rough mirror with GGX and without a metal's Fresnel factor. Versions before 2 take copper if no material is named.
  bool is_plain_ggx(pugi::xml_node node) const {
    const auto text = [&](const char* name) -> std::string_view {
      return node.find_child_by_attribute("string", "name", name).attribute("value").value();
    };
    return MitsubaSource::type(node) == "roughconductor" && text("distribution") == "ggx" &&
           (text("material") == "none" || (text("material").empty() && !file_.is_old())) &&
           !node.find_child_by_attribute("name", "eta") &&
           !node.find_child_by_attribute("name", "k");
  }

  /// The new material's place, or 0 if there are too many.
  int add_material(Material material, pugi::xml_node node) {
    if (!reader_.within(node, "materials", kMaxMaterials, std::int64_t(scene_.materials.size())))
      return 0;
    scene_.materials.push_back(std::move(material));
    return int(scene_.materials.size()) - 1;
  }

  void name_material(pugi::xml_node node) {
    const std::string id = node.attribute("id").value();
    if (MitsubaSource::type(node) == "null") {
      invisible_.insert(id);
      return;
    }
    const int index = add_material(material_of(node), node);
    if (id.empty())
      source_.error(node, "<bsdf> outside a shape has no id to be referred to");
    else if (!material_by_id_.emplace(id, index).second)
      source_.error(node, fmt::format("a second <bsdf> with the id '{}'", printable(id)));
  }

  /// The material of a shape; nothing if the shape cannot be seen or its material is missing.
  std::optional<int> material_of_shape(pugi::xml_node shape) {
    for (const auto child : shape.children()) {
      const std::string_view tag = child.name();
      if (tag == "bsdf") {
        if (MitsubaSource::type(child) == "null") return std::nullopt;
        return add_material(material_of(child), child);
      }
      if (tag != "ref") continue;
      const std::string id = child.attribute("id").value();
      if (invisible_.contains(id)) return std::nullopt;
      const auto found = material_by_id_.find(id);
      if (found != material_by_id_.end()) return found->second;
      source_.error(child,
                    fmt::format("no <bsdf> has the id '{}'; its shape is left out", printable(id)));
      return std::nullopt;
    }
    if (!default_material_) {
      Material grey;
      grey.highlight = {*find_model(kMitsubaModel), *find_lobe(kMitsubaLobe)};
      grey.diffuse_reflectance = kGrey;
      default_material_ = add_material(grey, shape);
    }
    return default_material_;
  }

  void read_shape(pugi::xml_node node) {
    const std::string_view type = MitsubaSource::type(node);
    if (type != "sphere" && type != "rectangle") return file_.unsupported(node, "it is left out");
    const bool is_sphere = type == "sphere";
    std::optional<Values> values;
    std::optional<Transform> transform;
    if (!without_problem([&] {
          values = file_.values(node,
                                is_sphere ? std::span<const Parameter>(kSphere.parameters)
                                          : std::span<const Parameter>(),
                                {"transform", "bsdf", "ref", "emitter", "boolean"});
          transform = file_.transform(node);
        }))
      return;
    const auto emitter = node.child("emitter");
    Rgb radiance;
    if (emitter && !without_problem([&] {
          if (MitsubaSource::type(emitter) != "area")
            file_.unsupported(emitter, "its shape is left out");
          else
            radiance = file_.values(emitter, kMitsubaAreaParameters).rgb("radiance");
        }))
      return;
    if (is_sphere)
      read_sphere(node, *values, *transform, emitter, radiance);
    else
      read_rectangle(node, *transform, emitter, radiance);
  }

  void add_light(pugi::xml_node shape, const Light& light) {
    if (!reader_.within(shape, "emitters", kMaxLights, std::int64_t(scene_.lights.size()))) return;
    if (const auto bsdf = shape.child("bsdf"); MitsubaSource::type(bsdf) != "null")
      source_.error(
          shape, "it is a light only: it reflects no light and casts no shadow, whatever its bsdf");
    scene_.lights.push_back(light);
  }

  void read_sphere(pugi::xml_node node, const Values& values, const Transform& transform,
                   pugi::xml_node emitter, Rgb radiance) {
    Vec3 center = values.vec3("center");
    double radius = values.number("radius");
    if (!transform.is_identity) {
      const Affine& t = transform.matrix;
      const double x = length(t.x), y = length(t.y), z = length(t.z);
      const double odd = std::max({std::abs(y - x), std::abs(z - x), std::abs(dot(t.x, t.y)) / x,
                                   std::abs(dot(t.x, t.z)) / x, std::abs(dot(t.y, t.z)) / x});
      if (!(odd <= 1e-6 * x))
        return source_.error(
            node,
            "its transform makes the sphere an ellipsoid, which is not supported; it is left out");
      center = t.of_point(center);
      radius *= x;
    }
    if (!within_reach(node, center) || !(radius >= kNear && radius <= kFar)) {
      if (within_reach(node, center))
        source_.error(
            node, fmt::format("its radius is {:g}; allowed: {:g} to {:g}", radius, kNear, kFar));
      return;
    }
    if (file_.flag(node, "flip_normals"))
      return source_.error(node,
                           "its normals point inwards, which is not supported; it is left out");
    if (emitter) return add_light(node, SphereLight{center, radius, radiance});
    if (!reader_.within(node, "spheres", kMaxSpheres, std::int64_t(scene_.spheres.size()))) return;
    if (const auto material = material_of_shape(node))
      scene_.spheres.push_back({center, radius, *material});
  }

  void read_rectangle(pugi::xml_node node, const Transform& transform, pugi::xml_node emitter,
                      Rgb radiance) {
    const Affine& t = transform.matrix;
    const bool flipped = (dot(cross(t.x, t.y), t.z) < 0) != file_.flag(node, "flip_normals");
    const Vec3 u = t.x, v = flipped ? -t.y : t.y;
    const double width = length(u), height = length(v);
    if (!within_reach(node, t.origin) || !within_reach(node, u) || !within_reach(node, v)) return;
    if (!(width >= kNear && height >= kNear && std::abs(dot(u, v)) <= 1e-6 * width * height))
      return source_.error(
          node,
          "its transform makes the rectangle slanted or flat, which is not supported; it is left out");
    if (emitter) return add_light(node, RectangleLight{t.origin, u, v, radiance});
    if (!reader_.within(node, "planes", kMaxPlanes, std::int64_t(scene_.planes.size()))) return;
    const auto material = material_of_shape(node);
    if (!material) return;
    source_.error(node, "the rectangle is read as an infinite plane");
    scene_.planes.push_back({t.origin, as_unit(cross(u, v)), *material, *material});
  }

  bool within_reach(pugi::xml_node node, Vec3 v) {
    if (std::abs(v.x) <= kFar && std::abs(v.y) <= kFar && std::abs(v.z) <= kFar) return true;
    source_.error(node, fmt::format("it reaches beyond {:g}; it is left out", kFar));
    return false;
  }

  static constexpr Rgb kGrey{0.5, 0.5, 0.5};

  MitsubaSource& file_;
  XmlSource& source_;
  ElementReader& reader_;
  LightReader lights_;
  EnvironmentMaps maps_;
  Scene scene_;
  std::map<std::string, int> material_by_id_;
  std::set<std::string> invisible_;
  std::optional<int> default_material_;
  int sensors_ = 0;
  bool has_camera_ = false;
};

}  // namespace

ImportedScene parse_mitsuba(std::string text, const std::string& file_name,
                            const std::filesystem::path& directory) {
  MitsubaSource source(std::move(text), file_name);
  ImportedScene imported;
  imported.scene = MitsubaReader(source, directory).read();
  imported.problems = source.xml().error_lines();
  return imported;
}

}  // namespace lobelia
