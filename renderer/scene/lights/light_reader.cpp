#include "renderer/scene/lights/light_reader.hpp"

#include "core/error.hpp"

namespace lobelia {
namespace {

class ElementOfLight final : public LightSource {
 public:
  ElementOfLight(pugi::xml_node node, const Values& values, XmlSource& source,
                 EnvironmentMaps& maps)
      : node_(node), values_(values), source_(source), maps_(maps) {}

  bool has(std::string_view parameter) const override { return bool(values_[parameter].node); }

  void error(std::string_view parameter, const std::string& message) override {
    if (parameter.empty()) return source_.error(node_, message);
    const pugi::xml_node where = values_[parameter].node;
    source_.error(where.attribute("value"), where, message);
  }

  std::shared_ptr<const Image> picture(std::string_view parameter) override {
    if (!has(parameter)) return nullptr;
    try {
      return maps_.read(values_[parameter].text);
    } catch (const Error& problem) {
      if (problem.code() != ExitCode::kInput) throw;
      error(parameter, problem.what());
    }
    return nullptr;
  }

 private:
  pugi::xml_node node_;
  const Values& values_;
  XmlSource& source_;
  EnvironmentMaps& maps_;
};

void take(const Values& values, std::string_view name, double& to) { to = values.number(name); }
void take(const Values& values, std::string_view name, Vec3& to) { to = values.vec3(name); }
void take(const Values& values, std::string_view name, Rgb& to) { to = values.rgb(name); }
void take(const Values& values, std::string_view name, std::string& to) { to = values[name].text; }

template <class L>
Light make_light(const Values& values, LightSource& source) {
  L light;
  for (const LightParameter<L>& p : L::parameters())
    std::visit([&](auto member) { take(values, p.parameter.name, light.*member); }, p.member);
  if constexpr (requires { light.finish(source); }) light.finish(source);
  return light;
}

}  // namespace

std::optional<Light> LightReader::read(pugi::xml_node node) {
  static constexpr auto kMake = map_types<Light (*)(const Values&, LightSource&)>(
      Lights{}, []<class L>() { return &make_light<L>; });
  reader_.source().check_attributes(node, {"type", "id"});
  const auto formats = emitter_formats();
  const ElementFormat* format = reader_.format_of(node, formats);
  if (!format) return std::nullopt;
  const Values values = reader_.read_parameters(node, format->parameters, {});
  ElementOfLight element(node, values, reader_.source(), maps_);
  return kMake[std::size_t(format - formats.data())](values, element);
}

}  // namespace lobelia
