#include "studies/shader_check/meanings.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "base/words/text.hpp"
#include "studies/shader_check/shader_tokens.hpp"

namespace lobelia::shader_check {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The words of a name in lower case: "u", "light", "pos" of uLightPos.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!is_letter(c) && !is_digit(c)) continue;
    const char before = i > 0 ? name[i - 1] : '_';
    const bool begins =
        words.empty() || (!is_letter(before) && !is_digit(before)) ||
        (is_upper(c) && !is_upper(before)) ||
        (is_upper(c) && i + 1 < name.size() && is_letter(name[i + 1]) && !is_upper(name[i + 1]));
    if (begins) words.emplace_back();
    words.back() += lower_case(std::string_view(&c, 1));
  }
  return words;
}

/// A name's words, without the prefix that tells where it is from.
class Name {
 public:
  explicit Name(std::string_view path) : words_(words_of(path)) {
    while (words_.size() > 1 &&
           is_one_of(words_[0], {"u", "v", "g", "a", "f", "i", "m", "in", "fs", "vs", "ps", "var",
                                 "frag", "input", "uniforms", "params", "material", "mat"}) &&
           !(words_.size() > 2 && is_one_of(words_[1], {"dot", "o"})) &&
           !(words_.size() == 2 && is_one_of(words_[1], {"dir", "vec", "vector", "direction"})))
      words_.erase(words_.begin());
    for (const std::string& word : words_) joined_ += word;
  }
  bool has(std::initializer_list<std::string_view> some) const {
    return std::ranges::any_of(words_,
                               [&](const std::string& word) { return is_one_of(word, some); });
  }
  bool is(std::initializer_list<std::string_view> some) const { return is_one_of(joined_, some); }
  bool contains(std::initializer_list<std::string_view> some) const {
    return std::ranges::any_of(
        some, [&](std::string_view part) { return joined_.find(part) != joined_.npos; });
  }
  const std::string& joined() const { return joined_; }

 private:
  std::vector<std::string> words_;
  std::string joined_;
};

Meaning told(std::string value) { return {{std::move(value)}, true}; }

Meaning vector_meaning(const Name& name) {
  if (name.contains({"color", "colour", "radiance", "ambient", "diffuse", "albedo", "tangent",
                     "matrix", "specular", "intensity", "irradiance", "attenuation", "emissi",
                     "scale", "texcoord", "strength"}) ||
      name.has({"col", "uv", "map", "tex", "count", "num"}))
    return {};
  if (name.is({"f0"})) return told("1");
  if (name.is({"h", "hw", "wh", "hv", "hvec", "hdir", "hn"}) || name.contains({"half"}))
    return told("H");
  if (name.is({"r", "rv", "rdir", "rvec"}) || name.contains({"mirrordir", "reflectdir"}) ||
      name.is({"reflect", "reflected", "reflection", "refl", "mirror", "reflectionvector",
               "reflectiondir", "reflectiondirection", "reflectdirection", "reflectvec",
               "reflectedlight"}))
    return told("R");
  if (name.is({"n", "nn", "nor", "nrm", "ng", "ns", "nw", "nvec", "ndir"}) ||
      name.contains({"normal"}) || name.has({"norm", "nrm"}))
    return told("N");
  if (name.is({"l", "ldir", "lvec", "lv", "lw", "lightv", "wi", "incoming", "omegai", "lpos"}) ||
      name.has({"light", "sun", "lamp", "lights"}) || name.contains({"light"}))
    return told("L");
  if (name.is({"v", "e", "vw", "vdir", "vvec", "wo", "outgoing", "omegao", "toeye", "eyev"}) ||
      name.contains({"view", "camera", "eye", "viewer", "observer"}) || name.has({"cam"}))
    return told("V");
  if (name.has({"pos", "position", "point", "wpos", "worldpos"}) ||
      name.is({"p", "fragpos", "hit", "world", "ws"}) ||
      name.contains({"position", "fragpos", "worldpos"}))
    return told("position");
  return {};
}

/// A cosine of two directions: "ndotl", "NoL", "dotNL", "nl".
std::string cosine_meaning(const std::string& joined) {
  static const std::map<std::set<char>, std::string> kPairs{
      {{'n', 'l'}, "N.L"}, {{'n', 'v'}, "N.V"}, {{'n', 'h'}, "N.H"}, {{'v', 'h'}, "V.H"},
      {{'l', 'h'}, "V.H"}, {{'r', 'v'}, "R.L"}, {{'r', 'l'}, "R.L"}, {{'l', 'v'}, "L.V"},
      {{'n', 'e'}, "N.V"}, {{'r', 'e'}, "R.L"}, {{'e', 'h'}, "V.H"}};
  const auto pair = [&](char a, char b) {
    const auto found = kPairs.find({a, b});
    return found == kPairs.end() ? std::string() : found->second;
  };
  const std::size_t dot = joined.find("dot");
  if (joined.size() == 2) return pair(joined[0], joined[1]);
  if (joined.size() == 3 && (joined[1] == 'o' || joined[1] == 'd'))
    return pair(joined[0], joined[2]);
  if (dot == joined.npos) return "";
  if (dot > 0 && dot + 4 == joined.size()) return pair(joined[dot - 1], joined[dot + 3]);
  if (dot + 5 == joined.size()) return pair(joined[dot + 3], joined[dot + 4]);
  return "";
}

Meaning scalar_meaning(const Name& name) {
  if (const std::string cosine = cosine_meaning(name.joined()); !cosine.empty())
    return told(cosine);
  if (name.is({"costhetai", "cosi", "costhetal", "cosl", "cosnl", "costhetain"}))
    return told("N.L");
  if (name.is({"costhetao", "coso", "costhetav", "cosv", "cosnv", "costhetaout"}))
    return told("N.V");
  if (name.is({"costhetah", "cosh", "cosnh", "costhetam"})) return told("N.H");
  if (name.is({"costheta", "cosine", "cosalpha", "cosangle", "costh"})) return told("cosine");
  if (name.is({"c", "x", "angle", "d", "dot"})) return {{"cosine", "N.H", "N.L"}, false};
  if (name.contains({"alpha2", "alphasq", "alphasquared"}) || name.is({"a2", "asq", "roughness4"}))
    return told("alpha2");
  if (name.is({"alpha", "a", "ag", "ggxalpha", "alphag", "alphaggx", "roughness2", "roughnesssq",
               "roughnesssquared", "rough2", "r2"}) ||
      name.contains({"alpharough", "roughnessalpha"}))
    return told("alpha");
  if (name.contains({"linearroughness"})) return {{"roughness", "alpha"}, false};
  if (name.contains({"rough"})) return told("roughness");
  if (name.contains({"smoothness"})) return told("smoothness");
  if (name.contains({"gloss"})) return {{"gloss", "smoothness", "n", "n/128"}, false};
  if (name.is({"n", "ns", "exp", "pow", "power", "shine", "shiny", "hardness"}) ||
      name.contains({"shininess", "exponent", "shinyness", "specularpower", "specpower",
                     "specularhardness", "specpow", "phongpower", "blinnpower", "phongexp",
                     "specexp", "specularexp", "highlightsize"}))
    return told("n");
  if (name.is({"coefficient", "coeff", "normalisation", "normalization", "normfactor"}))
    return told("coefficient");
  if (name.is({"f0", "fresnel0", "reflectance0"})) return told("1");
  if (name.is({"m", "k"})) return {{"n", "alpha", "roughness"}, false};
  if (name.is({"s"})) return {{"n", "s"}, false};
  return {};
}

}  // namespace

TypeShape shape_of(std::string_view type) {
  std::string name;
  for (const char c : type)
    if (c > ' ') name += c;
  TypeShape shape;
  using Element = TypeShape::Element;
  const auto element_of = [&](std::string_view word) {
    if (is_one_of(word, {"float", "half", "double", "fixed", "real", "f32", "f16", "min16float",
                         "min10float"}))
      return std::optional(Element::kFloat);
    if (is_one_of(word, {"int", "i32", "min16int"})) return std::optional(Element::kInt);
    if (is_one_of(word, {"uint", "u32", "min16uint"})) return std::optional(Element::kUint);
    if (word == "bool") return std::optional(Element::kBool);
    return std::optional<Element>();
  };
  // HLSL's vector<float, 3> and WGSL's vec3<f32>.
  if (const std::size_t open = name.find('<'); open != name.npos && name.ends_with('>')) {
    const auto parts = split(name.substr(open + 1, name.size() - open - 2), ",");
    std::string digits = name.substr(0, open);
    if (parts.empty() || !element_of(parts[0])) return {};
    shape.element = *element_of(parts[0]);
    if (digits == "vector" || digits == "matrix")
      digits =
          "vec" + (parts.size() > 1 ? parts[1] : "4") + (parts.size() > 2 ? "x" + parts[2] : "");
    name = digits;
  } else {
    static const std::pair<const char*, Element> kPrefixes[] = {
        {"ivec", Element::kInt},   {"uvec", Element::kUint}, {"bvec", Element::kBool},
        {"dvec", Element::kFloat}, {"vec", Element::kFloat}, {"dmat", Element::kFloat},
        {"mat", Element::kFloat}};
    if (const auto scalar = element_of(name)) return {*scalar, 1, 1};
    bool found = false;
    for (const auto& [prefix, element] : kPrefixes)
      if (name.starts_with(prefix)) {
        shape.element = element;
        name.erase(0, std::string_view(prefix).find_first_of("vm"));
        found = true;
        break;
      }
    if (!found) {
      const std::size_t digit = name.find_first_of("1234", name.starts_with("min1") ? 5 : 0);
      if (digit == name.npos || !element_of(name.substr(0, digit))) return {};
      shape.element = *element_of(name.substr(0, digit));
      name = "vec" + name.substr(digit);
    } else if (is_one_of(name.substr(name.size() - 1), {"f", "h", "i", "u"})) {
      // vec3f
      shape.element = name.ends_with('i')   ? Element::kInt
                      : name.ends_with('u') ? Element::kUint
                                            : Element::kFloat;
      name.pop_back();
    }
  }
  const std::size_t digit = name.find_first_of("1234");
  if (digit == name.npos) return {};
  shape.rows = name[digit] - '0';
  const bool is_matrix = name.starts_with("mat") || name.find('x', digit) != name.npos;
  shape.columns = digit + 2 < name.size() && name[digit + 1] == 'x' ? name[digit + 2] - '0'
                  : is_matrix                                       ? shape.rows
                                                                    : 1;
  return shape.columns >= 1 && shape.columns <= 4 ? shape : TypeShape{};
}

Meaning meaning_of(std::string_view path, const TypeShape& shape) {
  if (shape.columns != 1 || shape.element == TypeShape::Element::kBool) return {};
  constexpr std::size_t kLongest = 200;
  if (path.size() > kLongest) return {};
  const auto of = [&](const Name& name) {
    return shape.rows == 1                      ? scalar_meaning(name)
           : shape.rows == 3 || shape.rows == 4 ? vector_meaning(name)
                                                : Meaning{};
  };
  const Meaning whole = of(Name(path));
  const std::size_t dot = path.rfind('.');
  if (whole.is_told || dot == path.npos) return whole;
  const Meaning last = of(Name(path.substr(dot + 1)));
  return last.is_told || whole.values.empty() ? last : whole;
}

std::string suggested_value(std::string_view path, const TypeShape& shape) {
  if (shape.columns > 1) return "1";
  const Name name(path);
  const Meaning meaning = meaning_of(path, shape);
  if (!meaning.values.empty()) return meaning.values.front();
  const bool is_dark = name.contains({"ambient", "diffuse", "emissi", "albedo", "count", "time",
                                      "fog", "metal", "shadowbias"}) ||
                       name.is({"ka", "kd", "ke", "basecolor"}) ||
                       shape.element == TypeShape::Element::kBool;
  std::string value = is_dark ? "0" : "1";
  for (int i = 1; i < shape.components(); ++i) value += is_dark ? ",0" : ",1";
  return value;
}

}  // namespace lobelia::shader_check
