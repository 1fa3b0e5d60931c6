#include "compare/layer_type.hpp"

#include <algorithm>
#include <vector>

#include "base/pictures/layer_names.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace {

constexpr std::string_view kIdentifierNames =
    "id objectid objid objectindex indexob materialid matid materialindex indexma instanceid primid "
    "primitiveid shapeid geomid faceid partid assetid renderid";
constexpr std::string_view kDepthNames = "z zback depth zdepth denoisingdepth distance";
constexpr std::string_view kVectorNames =
    "n ng ns normal normals worldnormal denoisingnormal shadingnormal geometricnormal tangent p position positions "
    "worldposition worldpos pworld pref vector motion motionvector motionvectors velocity uv texcoord st";

bool is_in(std::string_view names, std::string_view word) {
  return std::ranges::count(split(names, " "), word) > 0;
}

std::string before_last_dot(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == name.npos ? "" : name.substr(0, dot);
}

std::string after_last_dot(const std::string& name) { return name.substr(name.rfind('.') + 1); }

/// The last part of a dotted name but for a view, in small letters, without blanks, "_", "-" and "#2".
std::string last_word(const std::string& name) {
  std::vector<std::string> words = split(lower_case(name.substr(0, name.rfind('#'))), ".");
  if (words.size() > 1 && (words.back() == "left" || words.back() == "right")) words.pop_back();
  std::string word = words.empty() ? "" : words.back();
  std::erase_if(word, [](char c) { return c == ' ' || c == '_' || c == '-'; });
  return word;
}

LayerType type_by_name(const PictureSource& source) {
  const std::string& first = source.channels.front();
  const bool is_single = source.channels.size() == 1;
  // A single channel's layer has the channel's name in full, unless its part has a name of its own.
  const std::string name = !source.layer.empty() ? source.layer
                           : is_single           ? first
                                                 : before_last_dot(first);
  if (!is_single) {
    const std::string word = last_word(name);
    if (is_in(kVectorNames, word)) return LayerType::kVector;
    if (is_in(kDepthNames, word)) return LayerType::kDepth;
    return lower_case(after_last_dot(first)) == "x" ? LayerType::kVector : LayerType::kColour;
  }
  const std::string channel = last_word(after_last_dot(first)),
                    prefix = last_word(before_last_dot(name));
  if (channel == "a" || channel == "alpha") return LayerType::kAlpha;
  if (is_in(kVectorNames, prefix)) return LayerType::kColour;
  const auto is_either = [&](std::string_view names) {
    return is_in(names, channel) || is_in(names, prefix);
  };
  if (is_either(kIdentifierNames)) return LayerType::kIdentifier;
  return is_either(kDepthNames) ? LayerType::kDepth : LayerType::kColour;
}

}  // namespace

std::optional<CryptomatteRank> cryptomatte_rank(std::string_view layer,
                                                std::span<const std::string> cryptomattes) {
  constexpr std::size_t kDigits = 2;
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (layer.size() <= kDigits ||
      !std::ranges::all_of(layer.substr(layer.size() - kDigits), is_digit))
    return std::nullopt;
  const std::string name(layer.substr(0, layer.size() - kDigits));
  const bool is_announced = std::ranges::any_of(cryptomattes, [&](const std::string& one) {
    return !one.empty() && (name == one || name.ends_with("." + one));
  });
  const std::string last = lower_case(after_last_dot(name));
  if (!is_announced && !last.starts_with("crypto") && !last.starts_with("ucrypto"))
    return std::nullopt;
  const char* const digits = layer.data() + layer.size() - kDigits;
  return CryptomatteRank{name, 10 * (digits[0] - '0') + (digits[1] - '0')};
}

std::optional<CryptomatteRank> cryptomatte_rank(const PictureSource& source) {
  if (source.channels.empty()) return cryptomatte_rank(source.layer, source.cryptomattes);
  const bool is_single = source.channels.size() == 1;
  for (const std::string& name : {is_single ? before_last_dot(source.layer) : source.layer,
                                  before_last_dot(source.channels.front())})
    if (auto rank = cryptomatte_rank(name, source.cryptomattes)) return rank;
  return std::nullopt;
}

LayerType layer_type(const PictureSource& source) {
  if (source.channels.empty()) return LayerType::kColour;
  if (cryptomatte_rank(source)) {
    if (source.channels.size() > 1) return LayerType::kIdentifier;
    const std::string own = lower_case(after_last_dot(source.channels.front()));
    return is_in("g green a alpha", own) ? LayerType::kAlpha : LayerType::kIdentifier;
  }
  if (source.format == "openexr" && source.value_type == "uint") return LayerType::kIdentifier;
  return type_by_name(source);
}

bool is_layer_called(const PictureSource& source, const std::string& name) {
  if (source.layer == name) return true;
  if (name.empty()) return false;
  std::vector<std::string> names{source.layer};
  if (!source.channels.empty())
    names.push_back(source.channels.size() == 1 ? source.channels.front()
                                                : before_last_dot(source.channels.front()));
  if (const auto rank = cryptomatte_rank(source)) names.push_back(rank->name);
  std::erase(names, "");
  return !names.empty() && !layers_meant(name, {&names, 1}, {}).empty();
}

}  // namespace lobelia
