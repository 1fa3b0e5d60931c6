#include "studies/shader_check/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia::shader_check {
namespace {

/// The facts about a point from which arguments are computed.
struct Known {
  const Point& point;
  Geometry geometry;
  double coefficient;
  bool is_mirror;

  double s() const { return is_mirror ? geometry.s_mirror : geometry.s_half; }
  double cosine() const { return is_mirror ? geometry.mirror : geometry.n_dot_h; }
  double alpha() const { return std::sqrt(2 / (point.exponent + 2)); }
  Vec3 half() const {
    const Vec3 sum = point.to_light + point.to_eye;
    return length(sum) > 0 ? normalize(sum) : sum;
  }
  Vec3 mirrored() const {
    return 2 * dot(point.normal, point.to_eye) * point.normal - point.to_eye;
  }
};

struct ArgumentRow {
  ArgumentInfo info;
  Vec3 (*value)(const Known&);  ///< of a number in x alone
};

constexpr ArgumentRow kRows[] = {
    {{"N", "normal", 3}, [](const Known& k) { return k.point.normal; }},
    {{"V", "direction to the eye", 3}, [](const Known& k) { return k.point.to_eye; }},
    {{"L", "direction to the light", 3}, [](const Known& k) { return k.point.to_light; }},
    {{"H", "half vector, (L + V) / |L + V|", 3}, [](const Known& k) { return k.half(); }},
    {{"R", "mirror direction of the eye, 2 (N.V) N - V", 3},
     [](const Known& k) { return k.mirrored(); }},
    {{"n", "exponent"}, [](const Known& k) { return Vec3{k.point.exponent}; }},
    {{"coefficient", "of the model, for n"}, [](const Known& k) { return Vec3{k.coefficient}; }},
    {{"s", "1 - cosine of the angle that the lobe sees"},
     [](const Known& k) { return Vec3{k.s()}; }},
    {{"cosine", "of the angle that the lobe sees: N.H or R.L"},
     [](const Known& k) { return Vec3{k.cosine()}; }},
    {{"N.L", "cosine of the light"}, [](const Known& k) { return Vec3{k.geometry.n_dot_l}; }},
    {{"N.V", "cosine of the eye"}, [](const Known& k) { return Vec3{k.geometry.n_dot_v}; }},
    {{"N.H", "cosine of the half vector"}, [](const Known& k) { return Vec3{k.geometry.n_dot_h}; }},
    {{"V.H", "cosine between eye and half vector"},
     [](const Known& k) { return Vec3{k.geometry.v_dot_h}; }},
    {{"R.L", "cosine between mirror direction and light"},
     [](const Known& k) { return Vec3{k.geometry.mirror}; }},
    {{"alpha", "sqrt(2 / (n + 2))"}, [](const Known& k) { return Vec3{k.alpha()}; }},
    {{"roughness", "the root of alpha"}, [](const Known& k) { return Vec3{std::sqrt(k.alpha())}; }},
};

constexpr auto kInfos = [] {
  std::array<ArgumentInfo, std::size(kRows)> infos;
  for (std::size_t i = 0; i < infos.size(); ++i) infos[i] = kRows[i].info;
  return infos;
}();

/// N, V, L, n and the coefficient.
constexpr std::size_t kCommon = 11, kExponentAt = 9, kCoefficientAt = 10;

std::string vector_at(std::size_t at, ShaderText language) {
  return fmt::format("{}({}, {}, {})", vector_type(language), shader_component(at),
                     shader_component(at + 1), shader_component(at + 2));
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
      throw Error(ExitCode::kUsage, "--arguments: '{}' is unknown; allowed: {}, and numbers{}",
                  printable(word), join(names), did_you_mean(name, names));
    }
    given.info = std::size_t(found - kInfos.begin());
    given_.push_back(given);
  }
  if (given_.size() > 16) throw Error(ExitCode::kUsage, "--arguments: at most 16 are allowed");
}

ShaderPoints Arguments::of(const std::vector<Point>& points) const {
  ShaderPoints all{components(), {}};
  all.values.reserve(points.size() * all.components);
  const auto append = [&](Vec3 v, int components) {
    for (const double x : std::array{v.x, v.y, v.z} | std::views::take(components))
      all.values.push_back(float(x));
  };
  Coefficients coefficients(highlight_);
  for (const Point& point : points) {
    const Known known{point, Geometry(point), coefficients.at(point.exponent),
                      info(highlight_.model).angle == LobeAngle::kReflection};
    for (const Vec3 v : {point.normal, point.to_eye, point.to_light}) append(v, 3);
    append({point.exponent, known.coefficient}, 2);
    for (const Given& given : given_)
      if (given.info == kInfos.size())
        append({given.number}, 1);
      else
        append((given.negative ? -1.0 : 1.0) * kRows[given.info].value(known),
               kInfos[given.info].components);
  }
  return all;
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
