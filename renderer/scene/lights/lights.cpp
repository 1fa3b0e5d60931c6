#include "renderer/scene/lights/lights.hpp"

#include "base/system/error.hpp"

namespace lobelia {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;  // Clang 14 deduces none for an aggregate

/// f(parameter, value) for each parameter of the light's table.
template <class F>
void for_each_parameter(const Light& light, const F& f) {
  std::visit(
      [&]<class L>(const L& l) {
        for (const LightParameter<L>& parameter : L::parameters())
          std::visit([&](auto member) { f(parameter, LightValue(l.*member)); }, parameter.member);
      },
      light);
}

}  // namespace

const LightInfo& info(const Light& light) {
  return std::visit([]<class L>(const L&) -> const LightInfo& { return L::kInfo; }, light);
}

Rgb strength(const Light& light) {
  return std::visit([](const auto& l) { return l.strength(); }, light);
}

LightBounds bounds(const Light& light) {
  return std::visit([](const auto& l) { return l.bounds(); }, light);
}

double reach_along(const Light& light, Vec3 axis) {
  return std::visit(Overloaded{[&](const AreaLight auto& l) { return l.reach_along(axis); },
                               [](const auto&) { return 0.0; }},
                    light);
}

std::optional<Lamp> find_lamp(const Light& light) {
  return std::visit(Overloaded{[](const DeltaLight auto& l) { return std::optional(l.lamp()); },
                               [](const auto&) { return std::optional<Lamp>(); }},
                    light);
}

std::optional<Lamp> find_near_lamp(const Light& light) {
  auto lamp = find_lamp(light);
  if (lamp && lamp->is_distant) lamp.reset();
  return lamp;
}

Lamp lamp_of(const Light& light) {
  if (const auto lamp = find_lamp(light)) return *lamp;
  throw Error(ExitCode::kInternal, "a light with a size has no single direction");
}

std::optional<Lamp> lamp_of_same_power(const Light& light) {
  return std::visit(
      Overloaded{[](const AreaLight auto& l) { return std::optional(l.whole_lamp()); },
                 [](const auto&) { return std::optional<Lamp>(); }},
      light);
}

Light light_of(const Lamp& lamp) {
  if (lamp.is_distant) return DirectionalLight{lamp.direction, lamp.strength};
  if (lamp.spot)
    return SpotLight{lamp.position, lamp.normal, lamp.strength, lamp.spot->cutoff, lamp.spot->beam};
  return PointLight{lamp.position, lamp.strength, lamp.normal};
}

std::vector<WrittenParameter> written_parameters(const Light& light) {
  std::vector<WrittenParameter> written;
  for_each_parameter(light, [&](const auto& parameter, const LightValue& value) {
    if (!parameter.is_optional || value != LightValue(Vec3{}))
      written.push_back({parameter.parameter, value});
  });
  return written;
}

LightValue value_of(const Light& light, std::string_view name) {
  std::optional<LightValue> found;
  for_each_parameter(light, [&](const auto& parameter, const LightValue& value) {
    if (parameter.parameter.name == name) found = value;
  });
  if (found) return *found;
  throw Error(ExitCode::kInternal, "a {} light has no parameter {}", info(light).type, name);
}

std::string picture_file(const Light& light) {
  std::string file;
  for_each_parameter(light, [&](const auto&, const LightValue& value) {
    if (const auto* text = std::get_if<std::string>(&value)) file = *text;
  });
  return file;
}

std::shared_ptr<const Image> picture_of(const Light& light) {
  return std::visit(Overloaded{[](const auto& l) requires requires { l.image;
}
{ return l.image; }
, [](const auto&) { return std::shared_ptr<const Image>(); }
}  // namespace lobelia
,
                    light);
}

}  // namespace lobelia
