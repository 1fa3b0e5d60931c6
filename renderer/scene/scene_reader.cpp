#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <set>

#include "core/files.hpp"
#include "core/text.hpp"
#include "renderer/scene/scene_format.hpp"
#include "renderer/scene/scene_io.hpp"
#include "renderer/scene/xml_source.hpp"

namespace lobelia {
namespace {

constexpr std::string_view kParameterTags[] = {"float", "integer", "string",
                                               "point", "vector",  "rgb"};

bool is_parameter(pugi::xml_node node) {
  return std::find(std::begin(kParameterTags), std::end(kParameterTags), node.name()) !=
         std::end(kParameterTags);
}

/// The value of one parameter and where it stands.
struct Value {
  std::array<double, 3> numbers{};
  std::string text;
  pugi::xml_node node;  ///< empty if it is the default
};

class Values {
 public:
  void set(std::string_view name, Value value) { values_[name] = std::move(value); }
  bool contains(std::string_view name) const { return values_.contains(name); }
  const Value& operator[](std::string_view name) const { return values_.at(name); }
  double number(std::string_view name) const { return values_.at(name).numbers[0]; }
  Vec3 vec3(std::string_view name) const {
    const auto& n = values_.at(name).numbers;
    return {n[0], n[1], n[2]};
  }
  Rgb rgb(std::string_view name) const {
    const auto& n = values_.at(name).numbers;
    return {n[0], n[1], n[2]};
  }

 private:
  std::map<std::string_view, Value> values_;
};

/// Without line breaks and runs of spaces.
std::string join_words(std::string_view text) {
  std::string result;
  for (const auto& word : split(text, " \t\n\r")) result += (result.empty() ? "" : " ") + word;
  return result;
}

/// Normalised, but left alone where it is a unit vector already: a scene that is written and read
/// again stays the same to the last bit.
Vec3 unit(Vec3 direction) {
  return std::abs(length(direction) - 1) < 1e-15 ? direction : normalize(direction);
}

std::string allowed_range(const Parameter& p) {
  return fmt::format("{:g} to {:g}{}{}", p.min, p.max, p.unit.empty() ? "" : " ", p.unit);
}

class SceneReader {
 public:
  explicit SceneReader(XmlSource& source) : source_(source) {}

  Scene read() {
    const auto root = source_.root();
    if (std::string_view(root.name()) != "scene") {
      source_.error(root, fmt::format("the root element is <{}>; a scene file begins with <scene>",
                                      printable(root.name())));
      source_.throw_if_errors();
    }
    source_.check_attributes(root, {"version"});
    if (const auto version = source_.required(root, "version");
        !version.empty() && version != kSceneFormatVersion)
      source_.error(root.attribute("version"), root,
                    fmt::format("format version '{}'; this program reads version {}",
                                printable(version), kSceneFormatVersion));
    // Materials first, so that a shape may refer to one that stands below it.
    for (const auto node : root.children("bsdf")) add_material(node, true);
    for (const auto node : elements(root)) {
      const std::string_view tag = node.name();
      if (tag == "sensor") read_sensor(node);
      if (tag == "emitter") read_emitter(node);
      if (tag == "shape") read_shape(node);
      expect_tag(node, {"sensor", "emitter", "bsdf", "shape"});
    }
    if (sensors_ == 0) source_.error(root, "the scene has no <sensor>; it needs one");
    source_.throw_if_errors();
    return std::move(scene_);
  }

 private:
  /// Children that are elements; text between them is an error (a forgotten bracket).
  std::vector<pugi::xml_node> elements(pugi::xml_node parent) {
    std::vector<pugi::xml_node> result;
    for (const auto node : parent.children()) {
      if (node.type() == pugi::node_element)
        result.push_back(node);
      else if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata)
        source_.error(
            node, fmt::format("text '{}' inside <{}>; values stand in attributes",
                              printable(join_words(node.value()), 20), printable(parent.name())));
    }
    return result;
  }

  void expect_tag(pugi::xml_node node, std::initializer_list<std::string_view> allowed) {
    if (std::find(allowed.begin(), allowed.end(), std::string_view(node.name())) != allowed.end())
      return;
    const std::span<const std::string_view> tags(allowed.begin(), allowed.size());
    source_.error(node, fmt::format("unknown element <{}> in <{}>; allowed: {}{}",
                                    printable(node.name()), printable(node.parent().name()),
                                    join(tags), did_you_mean(node.name(), tags)));
  }

  /// The format among `formats` that the element's type attribute names.
  const ElementFormat* format_of(pugi::xml_node node, std::span<const ElementFormat> formats) {
    std::vector<std::string_view> types;
    for (const auto& format : formats) types.push_back(format.type);
    const std::string type = source_.required(node, "type");
    if (!node.attribute("type")) return nullptr;
    for (const auto& format : formats)
      if (format.type == type) return &format;
    source_.error(node.attribute("type"), node,
                  fmt::format("unknown {} type '{}'; allowed: {}{}", node.name(), printable(type),
                              join(types), did_you_mean(type, types)));
    return nullptr;
  }

  std::optional<Value> parse(pugi::xml_node node, const Parameter& parameter,
                             const std::string& text) {
    Value value{{}, text, node};
    if (parameter.type == ParameterType::kString) return value;
    const auto complain = [&](const std::string& what) {
      const auto attribute = node.attribute("value");
      source_.error(attribute ? attribute : node.first_attribute(), node,
                    fmt::format("{} '{}' {}; allowed: {}", parameter.name, printable(text), what,
                                allowed_range(parameter)));
      return std::nullopt;
    };
    const auto parts = split(text, ", \t\n\r");
    const bool triple =
        parameter.type != ParameterType::kFloat && parameter.type != ParameterType::kInteger;
    const bool grey = parameter.type == ParameterType::kRgb && parts.size() == 1;
    if (parts.size() != (triple && !grey ? 3 : 1))
      return complain(parameter.type == ParameterType::kRgb ? "is not one or three numbers"
                      : triple                              ? "is not three numbers"
                                                            : "is not one number");
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (!parse_number(parts[i], value.numbers[i])) return complain("is not a finite number");
      if (value.numbers[i] < parameter.min || value.numbers[i] > parameter.max)
        return complain("is out of range");
      if (parameter.type == ParameterType::kInteger &&
          value.numbers[i] != std::floor(value.numbers[i]))
        return complain("is not a whole number");
    }
    if (grey) value.numbers[1] = value.numbers[2] = value.numbers[0];
    return value;
  }

  /// The text of a parameter: value="..." or, for points and vectors, x= y= z= as in Mitsuba.
  std::string value_text(pugi::xml_node node) {
    const auto x = node.attribute("x"), y = node.attribute("y"), z = node.attribute("z");
    if (!node.attribute("value") && (x || y || z)) {
      source_.check_attributes(node, {"name", "x", "y", "z"});
      return fmt::format("{}, {}, {}", x.as_string("0"), y.as_string("0"), z.as_string("0"));
    }
    source_.check_attributes(node, {"name", "value"});
    return source_.required(node, "value");
  }

  /// Reads the parameters of an element; what is not a parameter is left to the caller.
  Values read_parameters(pugi::xml_node element, std::span<const Parameter> table,
                         std::initializer_list<std::string_view> nested) {
    Values values;
    std::vector<std::string_view> names;
    for (const auto& parameter : table) names.push_back(parameter.name);
    for (const auto node : elements(element)) {
      if (!is_parameter(node)) {
        if (std::find(nested.begin(), nested.end(), std::string_view(node.name())) == nested.end())
          unknown_child(node, nested);
        continue;
      }
      const std::string name = source_.required(node, "name");
      if (name.empty()) continue;
      const auto parameter = std::find_if(table.begin(), table.end(),
                                          [&](const Parameter& p) { return p.name == name; });
      if (parameter == table.end()) {
        source_.error(node.attribute("name"), node,
                      fmt::format("<{}> has no parameter '{}'; allowed: {}{}", element.name(),
                                  printable(name), join(names), did_you_mean(name, names)));
        continue;
      }
      if (node.name() != parameter_tag(parameter->type)) {
        source_.error(node, fmt::format("parameter '{}' is written <{}>, not <{}>", name,
                                        parameter_tag(parameter->type), node.name()));
        continue;
      }
      if (values.contains(parameter->name)) {
        source_.error(node, fmt::format("parameter '{}' is given twice", name));
        continue;
      }
      const std::string text = value_text(node);
      // A value that was complained about is replaced by anything, to find the errors after it.
      values.set(parameter->name, parse(node, *parameter, text).value_or(Value{{1, 1, 1}, "", {}}));
    }
    for (const auto& parameter : table) {
      if (values.contains(parameter.name)) continue;
      if (parameter.default_value.empty())
        source_.error(element,
                      fmt::format("<{} type=\"{}\"> needs the parameter '{}' ({})", element.name(),
                                  printable(element.attribute("type").value()), parameter.name,
                                  parameter.meaning));
      values.set(parameter.name, default_of(parameter));
    }
    return values;
  }

  Value default_of(const Parameter& parameter) {
    if (parameter.default_value.empty()) return {{1, 1, 1}, "", {}};  // after an error: anything
    return parse({}, parameter, std::string(parameter.default_value)).value();
  }

  void unknown_child(pugi::xml_node node, std::initializer_list<std::string_view> nested) {
    std::vector<std::string_view> allowed(std::begin(kParameterTags), std::end(kParameterTags));
    allowed.insert(allowed.end(), nested.begin(), nested.end());
    source_.error(node, fmt::format("unknown element <{}> in <{}>; allowed: {}{}",
                                    printable(node.name()), printable(node.parent().name()),
                                    join(allowed), did_you_mean(node.name(), allowed)));
  }

  void read_sensor(pugi::xml_node node) {
    source_.check_attributes(node, {"type"});
    if (++sensors_ > 1) {
      source_.error(node, "a second <sensor>; one is allowed");
      return;
    }
    if (!format_of(node, std::span(&kPerspective, 1))) return;
    const Values values =
        read_parameters(node, kPerspective.parameters, {"transform", "film", "sampler"});
    scene_.camera.fov_degrees = values.number("fov");
    int films = 0, samplers = 0, transforms = 0;
    for (const auto child : node.children()) {
      const std::string_view tag = child.name();
      if (tag == "film" && once(child, films)) read_film(child);
      if (tag == "sampler" && once(child, samplers)) read_sampler(child);
      if (tag == "transform" && once(child, transforms)) read_view(child);
    }
    if (transforms == 0)
      source_.error(node, "<sensor> needs <transform name=\"to_world\"> with a <lookat> in it");
  }

  /// Whether one more may be read; says so once where not. What is over the limit is not looked at.
  bool within(pugi::xml_node node, std::string_view what, int limit, int seen) {
    if (seen < limit) return true;
    if (over_limit_.insert(std::string(what)).second)
      source_.error(node, fmt::format("over {} {}; allowed: {}", limit, what, limit));
    return false;
  }

  bool once(pugi::xml_node node, int& count) {
    if (++count > 1) source_.error(node, fmt::format("a second <{}>; one is allowed", node.name()));
    return count == 1;
  }

  void read_film(pugi::xml_node node) {
    source_.check_attributes(node, {"type"});
    if (!format_of(node, std::span(&kFilm, 1))) return;
    const Values values = read_parameters(node, kFilm.parameters, {});
    scene_.film = {int(values.number("width")), int(values.number("height"))};
    if (std::int64_t{scene_.film.width} * scene_.film.height > kMaxImagePixels)
      source_.error(node, fmt::format("{} x {} pixels; allowed: {} in all", scene_.film.width,
                                      scene_.film.height, kMaxImagePixels));
  }

  void read_sampler(pugi::xml_node node) {
    source_.check_attributes(node, {"type"});
    if (!format_of(node, std::span(&kSampler, 1))) return;
    const Values values = read_parameters(node, kSampler.parameters, {});
    scene_.sampler = {int(values.number("sample_count")), std::uint64_t(values.number("seed"))};
  }

  void read_view(pugi::xml_node node) {
    source_.check_attributes(node, {"name"});
    if (const auto name = source_.required(node, "name"); name != "to_world" && !name.empty())
      source_.error(node.attribute("name"), node,
                    fmt::format("transform '{}'; allowed: to_world", printable(name)));
    int lookats = 0;
    for (const auto child : elements(node)) {
      expect_tag(child, {"lookat"});
      if (std::string_view(child.name()) != "lookat" || !once(child, lookats)) continue;
      source_.check_attributes(child, {"origin", "target", "up"});
      read_lookat(child);
    }
    if (lookats == 0) source_.error(node, "<transform> needs a <lookat origin= target= up=>");
  }

  void read_lookat(pugi::xml_node node) {
    const auto triple = [&](const char* name) -> std::optional<Vec3> {
      const std::string text = source_.required(node, name);
      if (!node.attribute(name)) return std::nullopt;
      const auto parts = split(text, ", \t\n\r");
      std::array<double, 3> n{};
      bool good = parts.size() == 3;
      for (std::size_t i = 0; good && i < 3; ++i)
        good = parse_number(parts[i], n[i]) && std::abs(n[i]) <= kFar;
      if (good) return Vec3{n[0], n[1], n[2]};
      source_.error(node.attribute(name), node,
                    fmt::format("{} '{}' is not three numbers; allowed: {:g} to {:g} each", name,
                                printable(text), -kFar, kFar));
      return std::nullopt;
    };
    const auto origin = triple("origin"), target = triple("target"), up = triple("up");
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
    if (!within(node, "emitters", kMaxLights, emitters_seen_)) return;
    ++emitters_seen_;
    source_.check_attributes(node, {"type", "id"});
    static constexpr ElementFormat kEmitters[] = {kDirectional, kPoint};
    const ElementFormat* format = format_of(node, kEmitters);
    if (!format) return;
    const Values values = read_parameters(node, format->parameters, {});
    if (format->type == kPoint.type) {
      scene_.lights.push_back(PointLight{values.vec3("position"), values.rgb("intensity")});
      return;
    }
    const Vec3 direction = values.vec3("direction");
    if (length(direction) == 0)
      source_.error(node, "direction is zero; allowed: any other vector");
    else
      scene_.lights.push_back(DirectionalLight{unit(direction), values.rgb("irradiance")});
  }

  /// Returns the material's index, or 0 after an error.
  int add_material(pugi::xml_node node, bool needs_id) {
    if (!within(node, "materials", kMaxMaterials, materials_seen_)) return 0;
    source_.check_attributes(node, {"type", "id"});
    std::vector<ElementFormat> formats;
    for (const auto& model : models())
      formats.push_back({"bsdf", model.name, model.title, kHighlightParameters});
    Material material;
    material.id = node.attribute("id").value();
    if (needs_id && material.id.empty())
      source_.error(node, "<bsdf> outside a shape needs an id to be referred to");
    if (!material.id.empty() && !material_by_id_.emplace(material.id, materials_seen_).second)
      source_.error(node, fmt::format("a second <bsdf> with the id '{}'", printable(material.id)));
    ++materials_seen_;
    if (const ElementFormat* format = format_of(node, formats)) {
      const Values values = read_parameters(node, format->parameters, {});
      material.highlight.model = *find_model(format->type);
      material.highlight.exponent = values.number("exponent");
      choose(values["lobe"], node, "lobe", lobe_names(), allowed_lobes(), find_lobe,
             material.highlight.lobe);
      choose(values["normalisation"], node, "normalisation", normalisation_names(),
             join(normalisation_names()), find_normalisation, material.highlight.normalisation);
      choose(values["fresnel"], node, "fresnel", fresnel_names(), join(fresnel_names()),
             find_fresnel, material.fresnel);
      material.specular_reflectance = values.rgb("specular_reflectance");
      material.diffuse_reflectance = values.rgb("diffuse_reflectance");
    }
    scene_.materials.push_back(std::move(material));
    return materials_seen_ - 1;
  }

  template <class Id, class Find>
  void choose(const Value& value, pugi::xml_node element, std::string_view what,
              std::span<const std::string_view> names, const std::string& allowed, Find find,
              Id& id) {
    if (const auto found = find(value.text)) {
      id = *found;
      return;
    }
    const pugi::xml_node where = value.node ? value.node : element;
    source_.error(where.attribute("value"), where,
                  fmt::format("unknown {} '{}'; allowed: {}{}", what, printable(value.text),
                              allowed, did_you_mean(value.text, names)));
  }

  void read_shape(pugi::xml_node node) {
    if (!within(node, "shapes", kMaxSpheres, shapes_seen_)) return;
    ++shapes_seen_;
    source_.check_attributes(node, {"type", "id"});
    if (!format_of(node, std::span(&kSphere, 1))) return;
    const Values values = read_parameters(node, kSphere.parameters, {"bsdf", "ref"});
    Sphere sphere{values.vec3("center"), values.number("radius"), 0};
    int materials = 0;
    for (const auto child : node.children()) {
      const std::string_view tag = child.name();
      if (tag == "bsdf" && one_material(child, materials))
        sphere.material = add_material(child, false);
      if (tag == "ref" && one_material(child, materials)) sphere.material = refer(child);
    }
    if (materials == 0) source_.error(node, "<shape> needs a <bsdf> or a <ref id=\"...\"/> to one");
    scene_.spheres.push_back(sphere);
  }

  bool one_material(pugi::xml_node node, int& count) {
    if (++count > 1) source_.error(node, "a second material in one <shape>; one is allowed");
    return count == 1;
  }

  int refer(pugi::xml_node node) {
    source_.check_attributes(node, {"id"});
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
  Scene scene_;
  std::map<std::string, int> material_by_id_;
  std::set<std::string> over_limit_;
  int sensors_ = 0, emitters_seen_ = 0, materials_seen_ = 0, shapes_seen_ = 0;
};

}  // namespace

Scene parse_scene(std::string text, const std::string& file_name) {
  XmlSource source(std::move(text), file_name, kMaxSceneBytes);
  return SceneReader(source).read();
}

Scene read_scene(const std::filesystem::path& path) {
  return parse_scene(read_file(path, kMaxSceneBytes), path.string());
}

}  // namespace lobelia
