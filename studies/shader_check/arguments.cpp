#include "studies/shader_check/arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <ranges>

#include "base/system/error.hpp"
#include "base/words/text.hpp"
#include "studies/shader_check/meanings.hpp"

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
  Vec3 mirrored(Vec3 v) const { return 2 * dot(point.normal, v) * point.normal - v; }
  double roughness() const { return std::sqrt(alpha()); }
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
     [](const Known& k) { return k.mirrored(k.point.to_eye); }},
    {{"RL", "mirror direction of the light, 2 (N.L) N - L", 3},
     [](const Known& k) { return k.mirrored(k.point.to_light); }},
    {{"position", "of the surface: 0, 0, 0", 3}, [](const Known&) { return Vec3{}; }},
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
    {{"L.V", "cosine between light and eye"},
     [](const Known& k) { return Vec3{k.geometry.l_dot_v}; }},
    {{"alpha", "sqrt(2 / (n + 2))"}, [](const Known& k) { return Vec3{k.alpha()}; }},
    {{"alpha2", "alpha squared"}, [](const Known& k) { return Vec3{k.alpha() * k.alpha()}; }},
    {{"roughness", "the root of alpha"}, [](const Known& k) { return Vec3{k.roughness()}; }},
    {{"smoothness", "1 - roughness"}, [](const Known& k) { return Vec3{1 - k.roughness()}; }},
    {{"gloss", "(log2(n) - 1) / 10"},
     [](const Known& k) { return Vec3{(std::log2(k.point.exponent) - 1) / 10}; }},
    {{"n/128", "n / 128"}, [](const Known& k) { return Vec3{k.point.exponent / 128}; }},
    {{"n/1000", "n / 1000"}, [](const Known& k) { return Vec3{k.point.exponent / 1000}; }},
};

constexpr auto kInfos = [] {
  std::array<ArgumentInfo, std::size(kRows)> infos;
  for (std::size_t i = 0; i < infos.size(); ++i) infos[i] = kRows[i].info;
  return infos;
}();

/// N, V, L, n and the coefficient.
constexpr std::size_t kCommon = 11, kExponentAt = 9, kCoefficientAt = 10;
struct CommonWord {
  std::string_view word;
  std::size_t first, components;
};
constexpr CommonWord kCommonWords[] = {{"N", 0, 3},
                                       {"V", 3, 3},
                                       {"L", 6, 3},
                                       {"n", kExponentAt, 1},
                                       {"coefficient", kCoefficientAt, 1}};

std::string vector_at(std::size_t at, ShaderText language) {
  return fmt::format("{}({}, {}, {})", vector_type(language), shader_component(at),
                     shader_component(at + 1), shader_component(at + 2));
}

std::vector<std::string> components_from(std::size_t first, std::size_t count) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < count; ++i) texts.push_back(shader_component(first + i));
  return texts;
}

}  // namespace

std::span<const ArgumentInfo> argument_infos() { return kInfos; }

std::vector<std::string> Arguments::add(const std::string& word, std::string_view option) {
  const auto common = std::ranges::find(kCommonWords, word, &CommonWord::word);
  if (common != std::end(kCommonWords) && (knows_model_ || !depends_on_model({&word, 1})))
    return components_from(common->first, common->components);
  auto given = std::ranges::find(given_, word, &Given::word);
  if (given == given_.end()) {
    Given made{word, kInfos.size(), components(), false, 0};
    if (!parse_number(word, made.number)) {
      made.negative = word.starts_with('-');
      const std::string name = word.substr(made.negative ? 1 : 0);
      const auto found = std::ranges::find(kInfos, name, &ArgumentInfo::name);
      if (found == kInfos.end()) {
        std::vector<std::string_view> names;
        for (const ArgumentInfo& one : kInfos) names.push_back(one.name);
        throw Error(ExitCode::kUsage, "{}: '{}' is unknown; allowed: {}, and numbers{}", option,
                    printable(word), join(names), did_you_mean(name, names));
      }
      if (!knows_model_ && depends_on_model({&name, 1}))
        throw Error(ExitCode::kUsage, "{}: '{}' depends on the model; give --model", option, name);
      made.info = std::size_t(found - kInfos.begin());
    }
    constexpr std::size_t kMost = 40;
    if (given_.size() >= kMost)
      throw Error(ExitCode::kUsage, "{}: at most {} different values are allowed", option, kMost);
    given = given_.insert(given_.end(), std::move(made));
  }
  return components_from(
      given->first, given->info == kInfos.size() ? 1 : std::size_t(kInfos[given->info].components));
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

bool is_of_roughness(std::span<const std::string> words) {
  return std::ranges::any_of(words, [](const std::string& word) {
    return is_one_of(word, {"alpha", "alpha2", "roughness", "smoothness"});
  });
}

bool depends_on_model(std::span<const std::string> words) {
  return std::ranges::any_of(words, [](const std::string& word) {
    return is_one_of(word, {"coefficient", "s", "cosine"});
  });
}

bool takes_word(const Declared& parameter) {
  return parameter.is_in && parameter.dimensions.empty() && shape_of(parameter.type).is_number();
}

std::vector<std::string> likely_arguments(const FunctionDeclaration& function, std::size_t most) {
  std::vector<std::vector<std::string>> choices;
  for (const Declared& one : function.parameters) {
    if (!takes_word(one)) continue;
    const TypeShape shape = shape_of(one.type);
    Meaning meaning = meaning_of(one.name, shape);
    // A parameter that the function only adds to begins at 0.
    if (one.is_out && !meaning.is_told) meaning.values = {"0"};
    if (meaning.values.empty() && (shape.rows == 3 || shape.rows == 4) && shape.columns == 1)
      meaning.values = {"N", "V", "L", "H", "R"};
    if (meaning.values.empty() && shape.rows == 1)
      meaning.values = {"n",      "roughness", "alpha", "gloss", "coefficient", "1",
                        "cosine", "N.H",       "N.L",   "N.V",   "V.H"};
    if (meaning.values.empty()) meaning.values = {"0"};
    choices.push_back(std::move(meaning.values));
  }
  std::vector<std::string> lists;
  std::vector<std::string> words;
  int left = 200'000;  // of steps
  // The places of the words in their choices add up to `rank`.
  const std::function<void(std::size_t)> fill_in = [&](std::size_t rank) {
    if (lists.size() >= most || --left < 0) return;
    const std::size_t k = words.size();
    if (k == choices.size()) {
      if (rank > 0) return;
      const auto has = [&](std::string_view word) { return std::ranges::count(words, word) > 0; };
      std::vector<std::string_view> made(words.begin(), words.end());
      // R beside the eye is the light's.
      if (has("V") && !has("L")) std::ranges::replace(made, "R", "RL");
      lists.push_back(join(made, ","));
      return;
    }
    for (std::size_t i = 0; i < std::min(choices[k].size(), rank + 1); ++i) {
      double number = 0;
      if (std::ranges::count(words, choices[k][i]) > 0 && !parse_number(choices[k][i], number))
        continue;
      words.push_back(choices[k][i]);
      fill_in(rank - i);
      words.pop_back();
    }
  };
  for (std::size_t rank = 0; rank < 30 && lists.size() < most && left > 0; ++rank) fill_in(rank);
  if (lists.empty()) {  // two parameters of one meaning
    std::vector<std::string_view> first;
    for (const auto& choice : choices) first.push_back(choice.front());
    lists.push_back(join(first, ","));
  }
  return lists;
}

std::string common_vectors(ShaderText language) {
  return vector_at(0, language) + ", " + vector_at(3, language) + ", " + vector_at(6, language);
}
std::string common_exponent() { return shader_component(kExponentAt); }
std::string common_coefficient() { return shader_component(kCoefficientAt); }

}  // namespace lobelia::shader_check
