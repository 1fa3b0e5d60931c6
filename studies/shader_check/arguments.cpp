#include "studies/shader_check/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"

namespace lobelia::shader_check {
namespace {

struct ArgumentRow {
  ArgumentInfo info;
  /// Of a scalar in x alone.
  Vec3 (*value)(const Point&, const Geometry&, const Highlight&);
};

double alpha_of(const Point& p) { return std::sqrt(2 / (p.exponent + 2)); }

Vec3 half_of(const Point& p) {
  const Vec3 sum = p.to_light + p.to_eye;
  return length(sum) > 0 ? normalize(sum) : sum;
}

constexpr ArgumentRow kRows[] = {
    {{"N", "normal", 3}, [](auto& p, auto&, auto&) { return p.normal; }},
    {{"V", "direction to the eye; -V to the surface", 3},
     [](auto& p, auto&, auto&) { return p.to_eye; }},
    {{"L", "direction to the light; -L to the surface", 3},
     [](auto& p, auto&, auto&) { return p.to_light; }},
    {{"H", "half vector, (L + V) / |L + V|", 3}, [](auto& p, auto&, auto&) { return half_of(p); }},
    {{"R", "mirror direction of the eye, 2 (N.V) N - V", 3},
     [](auto& p, auto&, auto&) { return 2 * dot(p.normal, p.to_eye) * p.normal - p.to_eye; }},
    {{"n", "exponent", 1}, [](auto& p, auto&, auto&) { return Vec3{p.exponent}; }},
    {{"coefficient", "of the model, for n", 1},
     [](auto&, auto&, auto& h) { return Vec3{radiance_coefficient(h)}; }},
    {{"s", "1 - cosine", 1},
     [](auto&, auto& g, auto& h) {
       return Vec3{info(h.model).angle == LobeAngle::kReflection ? g.s_mirror : g.s_half};
     }},
    {{"cosine", "of the angle that the model's lobe sees: N.H or R.L", 1},
     [](auto&, auto& g, auto& h) {
       return Vec3{info(h.model).angle == LobeAngle::kReflection ? g.mirror : g.n_dot_h};
     }},
    {{"N.L", "cosine", 1}, [](auto&, auto& g, auto&) { return Vec3{g.n_dot_l}; }},
    {{"N.V", "cosine", 1}, [](auto&, auto& g, auto&) { return Vec3{g.n_dot_v}; }},
    {{"N.H", "cosine", 1}, [](auto&, auto& g, auto&) { return Vec3{g.n_dot_h}; }},
    {{"V.H", "cosine", 1}, [](auto&, auto& g, auto&) { return Vec3{g.v_dot_h}; }},
    {{"R.L", "cosine, the same as R.V of the light's mirror direction", 1},
     [](auto&, auto& g, auto&) { return Vec3{g.mirror}; }},
    {{"alpha", "sqrt(2 / (n + 2))", 1}, [](auto& p, auto&, auto&) { return Vec3{alpha_of(p)}; }},
    {{"roughness", "the root of alpha", 1},
     [](auto& p, auto&, auto&) { return Vec3{std::sqrt(alpha_of(p))}; }},
};

constexpr auto kInfos = [] {
  std::array<ArgumentInfo, std::size(kRows)> infos;
  for (std::size_t i = 0; i < infos.size(); ++i) infos[i] = kRows[i].info;
  return infos;
}();

/// N, V, L, n and the coefficient.
constexpr std::size_t kCommon = 11, kExponentAt = 9, kCoefficientAt = 10;

std::string vector_at(std::size_t at, ShaderText language) {
  return fmt::format("{}({}, {}, {})", language == ShaderText::kHlsl ? "float3" : "vec3",
                     shader_component(at), shader_component(at + 1), shader_component(at + 2));
}

}  // namespace

std::span<const ArgumentInfo> argument_infos() { return kInfos; }

Arguments::Arguments(const std::string& list, const Highlight& highlight) : highlight_(highlight) {
  for (const std::string& word : split(list, ",")) {
    Given given;
    std::string name = word;
    if (parse_number(word, given.number)) {
      given.info = kInfos.size();
      given_.push_back(given);
      continue;
    }
    if (name.starts_with('-')) given.negative = true, name.erase(0, 1);
    const auto found = std::ranges::find(kInfos, name, &ArgumentInfo::name);
    if (found == kInfos.end()) {
      std::vector<std::string_view> names;
      for (const ArgumentInfo& one : kInfos) names.push_back(one.name);
      throw Error(ExitCode::kUsage,
                  fmt::format("--arguments: '{}' is unknown; allowed: {}, and numbers{}",
                              printable(word), join(names), did_you_mean(name, names)));
    }
    given.info = std::size_t(found - kInfos.begin());
    given_.push_back(given);
  }
  if (given_.size() > 16) throw Error(ExitCode::kUsage, "--arguments: at most 16 are allowed");
}

void Arguments::append(const Point& point, std::vector<float>& values) const {
  Highlight highlight = highlight_;
  highlight.exponent = point.exponent;
  const auto append_vector = [&](Vec3 v) {
    values.insert(values.end(), {float(v.x), float(v.y), float(v.z)});
  };
  append_vector(point.normal), append_vector(point.to_eye), append_vector(point.to_light);
  values.insert(values.end(), {float(point.exponent), float(radiance_coefficient(highlight))});
  const Geometry geometry(point);
  for (const Given& given : given_) {
    if (given.info == kInfos.size()) {
      values.push_back(float(given.number));
      continue;
    }
    const Vec3 value =
        (given.negative ? -1.0 : 1.0) * kRows[given.info].value(point, geometry, highlight);
    if (kInfos[given.info].components == 3)
      append_vector(value);
    else
      values.push_back(float(value.x));
  }
}

std::size_t Arguments::components() const {
  std::size_t count = kCommon;
  for (const Given& given : given_)
    count += given.info == kInfos.size() ? 1 : std::size_t(kInfos[given.info].components);
  return count;
}

std::string Arguments::call(std::string_view function, ShaderText language) const {
  std::string text;
  std::size_t at = kCommon;
  for (const Given& given : given_) {
    const int components = given.info == kInfos.size() ? 1 : kInfos[given.info].components;
    text += (text.empty() ? "" : ", ") +
            (components == 3 ? vector_at(at, language) : shader_component(at));
    at += std::size_t(components);
  }
  return fmt::format("{}({})", function, text);
}

bool Arguments::is_of_roughness() const {
  const auto has = [&](std::string_view name) {
    return std::ranges::any_of(given_, [&](const Given& given) {
      return given.info < kInfos.size() && kInfos[given.info].name == name;
    });
  };
  return has("alpha") || has("roughness");
}

std::string common_vectors(ShaderText language) {
  return vector_at(0, language) + ", " + vector_at(3, language) + ", " + vector_at(6, language);
}
std::string common_exponent() { return shader_component(kExponentAt); }
std::string common_coefficient() { return shader_component(kCoefficientAt); }

}  // namespace lobelia::shader_check
