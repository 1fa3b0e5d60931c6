
#include "base/system/files.hpp"
#include "renderer/formula.hpp"
#include "renderer/scene/lights/light_reader.hpp"
#include "renderer/scene/scene_io.hpp"
#include "renderer/scene/sphere_lattice.hpp"
#include "renderer/shipped_files.hpp"

namespace lobelia {
namespace {

class SceneReader {
 public:
  SceneReader(XmlSource& source, const std::filesystem::path& directory)
      : source_(source), reader_(source), lights_(reader_, directory) {}

  Scene read() {
    const auto root = source_.root();
    if (std::string_view(root.name()) != "scene") {
      source_.error(
          root,
          fmt::format(
              "the root element is <{}>; a scene file begins with <scene>{}",
              printable(root.name()),
              std::string_view(root.name()) == "grid" ? ". For a grid, type lobelia farm" : ""));
      source_.throw_if_errors();
    }
    reader_.check_attributes(root);
    if (const auto version = source_.required(root, "version");
        !version.empty() && version != kSceneFormatVersion) {
      const bool is_mitsuba = version.find('.') != version.npos;
      source_.error(root.attribute("version"), root,
                    fmt::format("format version '{}'; this program reads version {}{}",
                                printable(version), kSceneFormatVersion,
                                is_mitsuba ? ". If it is a scene of Mitsuba, type lobelia scene "
                                             "FILE --from mitsuba -o OUT.xml"
                                           : ""));
      if (is_mitsuba) source_.throw_if_errors();
    }
    // Materials first, so that a shape may refer to a later one.
    for (const auto node : root.children("bsdf")) add_material(node, true);
    for (const auto node : reader_.elements(root)) {
      const std::string_view tag = node.name();
      if (tag == "sensor") read_sensor(node);
      if (tag == "emitter") read_emitter(node);
      if (tag == "shape") read_shape(node);
      if (tag == "integrator" && reader_.once(node, integrators_)) read_integrator(node);
      reader_.expect_tag(node);
    }
    if (integrators_ == 0 && std::ranges::any_of(scene_.materials, is_mirror))
      scene_.depth.mirror = kDefaultMirrorDepth;
    lights_.check_pairs(root, scene_.lights.size(), std::size_t(spheres_seen_ + planes_seen_));
    if (sensors_ == 0) source_.error(root, "the scene has no <sensor>; it needs one");
    source_.throw_if_errors();
    return std::move(scene_);
  }

 private:
  void read_sensor(pugi::xml_node node) {
    reader_.check_attributes(node);
    if (!reader_.once(node, sensors_)) return;
    const ElementFormat* format = reader_.format_of(node, kSensors);
    if (!format) return;
    const Values values = reader_.read_parameters(node, format->parameters);
    scene_.camera.fov_degrees = values.number("fov");
    scene_.camera.principal_point_offset_x = values.number("principal_point_offset_x");
    scene_.camera.principal_point_offset_y = values.number("principal_point_offset_y");
    if (format->type == kThinLens.type) {
      scene_.camera.aperture_radius = values.number("aperture_radius");
      scene_.camera.focus_distance = values.number("focus_distance");
    }
    int films = 0, samplers = 0, transforms = 0;
    for (const auto child : node.children()) {
      const std::string_view tag = child.name();
      if (tag == "film" && reader_.once(child, films)) read_film(child);
      if (tag == "sampler" && reader_.once(child, samplers)) read_sampler(child);
      if (tag == "transform" && reader_.once(child, transforms)) read_view(child);
    }
    if (transforms == 0)
      source_.error(node, "<sensor> needs <transform name=\"to_world\"> with a <lookat> in it");
  }

  void read_film(pugi::xml_node node) {
    reader_.check_attributes(node);
    if (!reader_.format_of(node, std::span(&kFilm, 1))) return;
    const Values values = reader_.read_parameters(node, kFilm.parameters);
    scene_.film.width = int(values.number("width"));
    scene_.film.height = int(values.number("height"));
    int filters = 0;
    for (const auto child : node.children("rfilter"))
      if (reader_.once(child, filters)) read_filter(child);
    if (std::int64_t{scene_.film.width} * scene_.film.height > kMaxFilmPixels)
      source_.error(node, fmt::format("{} x {} pixels; allowed: {} in all", scene_.film.width,
                                      scene_.film.height, kMaxFilmPixels));
  }

  void read_filter(pugi::xml_node node) {
    reader_.check_attributes(node);
    const ElementFormat* format = reader_.format_of(node, filter_formats());
    if (!format) return;
    scene_.film.filter = *find_filter(format->type);
    scene_.film.filter.radius = reader_.read_parameters(node, format->parameters).number("radius");
  }

  void read_integrator(pugi::xml_node node) {
    reader_.check_attributes(node);
    if (!reader_.format_of(node, std::span(&kIntegrator, 1))) return;
    const Values values = reader_.read_parameters(node, kIntegrator.parameters);
    scene_.depth = {int(values.number("mirror_depth")), int(values.number("glossy_depth"))};
  }

  void read_sampler(pugi::xml_node node) {
    reader_.check_attributes(node);
    if (!reader_.format_of(node, std::span(&kSampler, 1))) return;
    const Values values = reader_.read_parameters(node, kSampler.parameters);
    scene_.sampler = {int(values.number("sample_count")), std::uint64_t(values.number("seed"))};
  }

  void read_view(pugi::xml_node node) {
    reader_.check_attributes(node);
    if (const auto name = source_.required(node, "name"); name != "to_world" && !name.empty())
      source_.error(node.attribute("name"), node,
                    fmt::format("transform '{}'; allowed: to_world", printable(name)));
    int lookats = 0;
    for (const auto child : reader_.elements(node)) {
      reader_.expect_tag(child);
      if (std::string_view(child.name()) != "lookat" || !reader_.once(child, lookats)) continue;
      reader_.check_attributes(child);
      read_lookat(child);
    }
    if (lookats == 0) source_.error(node, "<transform> needs a <lookat origin= target= up=>");
  }

  void read_lookat(pugi::xml_node node) {
    const auto triple = [&](const XmlAttribute& attribute) -> std::optional<Vec3> {
      const Parameter& place = attribute.parameter;
      const char* const name = place.name.data();
      const std::string text = source_.required(node, name);
      if (!node.attribute(name)) return std::nullopt;
      const auto parts = split_numbers(text);
      std::array<double, 3> n{};
      bool good = parts.size() == 3;
      for (std::size_t i = 0; good && i < 3; ++i)
        good = parse_number(parts[i], n[i]) && n[i] >= place.min && n[i] <= place.max;
      if (good) return Vec3{n[0], n[1], n[2]};
      source_.error(node.attribute(name), node,
                    fmt::format("{} '{}' is not three numbers; allowed: {:g} to {:g} each", name,
                                printable(text), place.min, place.max));
      return std::nullopt;
    };
    const auto& places = find_element(scene_elements(), "lookat").attributes;
    const auto origin = triple(places[0]), target = triple(places[1]), up = triple(places[2]);
    if (!origin || !target || !up) return;
    scene_.camera.origin = *origin;
    scene_.camera.target = *target;
    scene_.camera.up = *up;
    const Vec3 view = *target - *origin;
    if (length(view) == 0)
      source_.error(node, "origin and target are the same point: the camera looks nowhere");
    else if (length(*up) == 0 || length(cross(normalize(view), normalize(*up))) < 1e-6)
      source_.error(node, "up is zero or along the view: the camera has no upright");
  }

  void read_emitter(pugi::xml_node node) {
    if (!reader_.within(node, "emitters", kMaxLights, emitters_seen_)) return;
    ++emitters_seen_;
    if (const auto light = lights_.read(node)) scene_.lights.push_back(*light);
  }

  /// Returns the material's index, or 0 after an error.
  int add_material(pugi::xml_node node, bool needs_id) {
    if (!reader_.within(node, "materials", kMaxMaterials, materials_seen_)) return 0;
    reader_.check_attributes(node);
    Material material;
    material.id = node.attribute("id").value();
    if (needs_id && material.id.empty())
      source_.error(node, "<bsdf> outside a shape needs an id to be referred to");
    if (!material.id.empty() && !material_by_id_.emplace(material.id, materials_seen_).second)
      source_.error(node, fmt::format("a second <bsdf> with the id '{}'", printable(material.id)));
    ++materials_seen_;
    if (const ElementFormat* format = reader_.format_of(node, material_formats())) {
      const Values values = reader_.read_parameters(node, format->parameters);
      set_model(material.highlight, format->type);
      if (format->type == kGgx) {
        read_roughness(values, node, material.highlight);
      } else {
        material.highlight.exponent = values.number("exponent");
        read_lobe(values, node, material.highlight);
        reader_.choose(values["normalisation"], node, "normalisation", normalisation_names(),
                       join(normalisation_names()), find_normalisation,
                       material.highlight.normalisation);
      }
      reader_.choose(values["fresnel"], node, "fresnel", fresnel_names(), join(fresnel_names()),
                     find_fresnel, material.fresnel);
      material.specular_reflectance = values.rgb("specular_reflectance");
      material.diffuse_reflectance = values.rgb("diffuse_reflectance");
      material.mirror_reflectance = values.rgb("mirror_reflectance");
    }
    scene_.materials.push_back(std::move(material));
    return materials_seen_ - 1;
  }

  void read_roughness(const Values& values, pugi::xml_node material, Highlight& highlight) {
    const auto is_given = [&](const char* name) {
      return bool(material.find_child_by_attribute("name", name));
    };
    const bool by_alpha = is_given("alpha");
    if (by_alpha == is_given("roughness"))
      source_.error(material, by_alpha ? "<bsdf type=\"ggx\"> has roughness and alpha; allowed: one"
                                       : "<bsdf type=\"ggx\"> needs roughness, or alpha");
    highlight.exponent = by_alpha ? exponent_of_alpha(values.number("alpha"))
                                  : exponent_of_roughness(values.number("roughness"));
  }

  void read_lobe(const Values& values, pugi::xml_node material, Highlight& highlight) {
    const Values::Value &lobe = values["lobe"], &formula = values["formula"];
    const auto refuse = [&](const Values::Value& value, const std::string& what) {
      const pugi::xml_node where = value.node ? value.node : material;
      source_.error(where.attribute("value"), where, what);
    };
    const bool given = formula.text != kNoFormula, asked_for = lobe.text == kFormulaLobe;
    if (!given && asked_for)
      return refuse(lobe, fmt::format("the lobe '{}' needs a formula", kFormulaLobe));
    if (given && !asked_for)
      return refuse(formula, fmt::format("a formula is for the lobe '{}', not for '{}'",
                                         kFormulaLobe, printable(lobe.text)));
    if (!given)
      return reader_.choose(lobe, material, "lobe", lobe_names(), allowed_lobes(true), find_lobe,
                            highlight.lobe);
    try {
      highlight.lobe = formula_lobe(formula.text);
    } catch (const FormulaError& e) {
      return refuse(formula, e.what());
    }
    if (const std::string why = why_not_a_lobe(highlight); !why.empty()) refuse(formula, why);
  }

  void read_shape(pugi::xml_node node) {
    reader_.check_attributes(node);
    const ElementFormat* format = reader_.format_of(node, kShapes);
    if (!format) return;
    if (format->type == kPlane.type) read_plane(node);
    if (format->type == kLattice.type) read_lattice(node);
    if (format->type == kSphere.type) read_sphere(node);
  }

  void read_sphere(pugi::xml_node node) {
    if (!reader_.within(node, "spheres", kMaxSpheres, spheres_seen_)) return;
    ++spheres_seen_;
    const Values values = reader_.read_parameters(node, kSphere.parameters);
    scene_.spheres.push_back(
        {values.vec3("center"), values.number("radius"), read_materials(node, 1).front()});
  }

  void read_plane(pugi::xml_node node) {
    if (!reader_.within(node, "planes", kMaxPlanes, planes_seen_)) return;
    ++planes_seen_;
    const Values values = reader_.read_parameters(node, kPlane.parameters);
    const auto materials = read_materials(node, 2);
    scene_.planes.push_back({values.vec3("point"), reader_.direction(node, values, "normal"),
                             materials.front(), materials.back(), values.number("checker_size")});
  }

  void read_lattice(pugi::xml_node node) {
    const Values values = reader_.read_parameters(node, kLattice.parameters);
    const auto whole = [&](const char* name) { return int(values.number(name)); };
    SphereLattice lattice{whole("columns"),
                          whole("rows"),
                          whole("layers"),
                          values.vec3("step"),
                          values.vec3("center"),
                          values.number("radius"),
                          values.number("jitter"),
                          std::uint64_t(values.number("seed")),
                          read_materials(node, 1).front()};
    const Vec3 step = lattice.step;
    if ((lattice.columns > 1 && step.x == 0) || (lattice.rows > 1 && step.y == 0) ||
        (lattice.layers > 1 && step.z == 0))
      source_.error(node, fmt::format("step '{}' puts spheres in one place; allowed: over 0 along "
                                      "every axis with more than one sphere",
                                      printable(values["step"].text)));
    if (lattice.reach() > kFar)
      source_.error(node, fmt::format("the lattice reaches to {:g}; allowed: {:g} to {:g}",
                                      lattice.reach(), -kFar, kFar));
    // Counted first: spheres over the limit are not made.
    if (!reader_.within(node, "spheres", kMaxSpheres, spheres_seen_ + lattice.count() - 1)) return;
    spheres_seen_ += lattice.count();
    if (!source_.has_errors()) lattice.append_to(scene_.spheres);
  }

  /// Indices of the materials in a shape, at least one: 0 after an error.
  std::vector<int> read_materials(pugi::xml_node shape, std::size_t allowed) {
    std::vector<int> materials;
    for (const auto child : shape.children()) {
      const std::string_view tag = child.name();
      if (tag != "bsdf" && tag != "ref") continue;
      if (materials.size() == allowed) {
        source_.error(child, allowed == 1 ? "a second material in one <shape>; one is allowed"
                                          : "a third material in one <shape>; two are allowed");
        break;
      }
      materials.push_back(tag == "bsdf" ? add_material(child, false) : refer(child));
    }
    if (materials.empty()) {
      source_.error(shape, "<shape> needs a <bsdf> or a <ref id=\"...\"/> to one");
      materials.push_back(0);
    }
    return materials;
  }

  int refer(pugi::xml_node node) {
    reader_.check_attributes(node);
    const std::string id = source_.required(node, "id");
    const auto found = material_by_id_.find(id);
    if (found != material_by_id_.end()) return found->second;
    std::vector<std::string_view> ids;
    if (!source_.full())
      for (const auto& [known, index] : material_by_id_) ids.push_back(known);
    if (!id.empty())
      source_.error(
          node.attribute("id"), node,
          fmt::format("no <bsdf> has the id '{}'{}", printable(id), did_you_mean(id, ids)));
    return 0;
  }

  XmlSource& source_;
  ElementReader reader_;
  LightReader lights_;
  Scene scene_;
  std::map<std::string, int> material_by_id_;
  std::int64_t spheres_seen_ = 0;
  int sensors_ = 0, integrators_ = 0, emitters_seen_ = 0, materials_seen_ = 0, planes_seen_ = 0;
};

}  // namespace

Scene parse_scene(std::string text, const std::string& file_name,
                  const std::filesystem::path& directory) {
  // Many take the file of another program for a scene.
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != text.npos && std::isgraph(static_cast<unsigned char>(text[first])) &&
      text[first] != '<')
    throw Error(ExitCode::kInput,
                "{}: is no XML; Lobelia reads scenes in its own XML (lobelia scene-format) "
                "and, with lobelia scene --from mitsuba, those of Mitsuba",
                file_name);
  XmlSource source(std::move(text), file_name, kMaxSceneBytes);
  return SceneReader(source, directory).read();
}

Scene read_scene(const std::filesystem::path& named) {
  const std::filesystem::path path = or_shipped(named);
  const std::filesystem::path directory = path.parent_path();
  return parse_scene(read_file(path, kMaxSceneBytes), path.string(),
                     directory.empty() ? "." : directory);
}

}  // namespace lobelia
