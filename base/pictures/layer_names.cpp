#include "base/pictures/layer_names.hpp"

#include <algorithm>

#include "base/words/text.hpp"

namespace lobelia {
namespace {

/// Names of one pass in Cycles, Arnold, RenderMan, V-Ray, Mitsuba and pbrt; the best comes first. A light pass and its
/// parts (Cycles' DiffDir, DiffInd and DiffCol) are different things, so "diffuse" is none of them.
constexpr std::string_view kSamePass[] = {
    "combined beauty rgba rgb image ci",
    "albedo denoisingalbedo denoisealbedo",
    "normal n normals worldnormal denoisingnormal",
    "depth z zdepth denoisingdepth",
    "position p worldposition pworld",
    "vector motion motionvector motionvectors velocity",
    "diffdir diffusedirect directdiffuse",
    "diffind diffuseindirect indirectdiffuse",
    "diffcol diffusecolor diffusecolour",
    "glossdir glossydirect speculardirect directspecular",
    "glossind glossyindirect specularindirect indirectspecular",
    "glosscol glossycolor glossycolour",
    "transdir transmissiondirect directtransmission",
    "transind transmissionindirect indirecttransmission",
    "transcol transmissioncolor transmissioncolour",
    "specular spec",
    "diffuse diff",
    "emit emission emissive emissiondirect",
    "env environment background",
    "ao ambientocclusion",
    "uv texcoord st",
};
constexpr std::string_view kPictureNames = kSamePass[0];

/// A name in small letters, split at its dots.
using Key = std::vector<std::string>;

Key key_of(std::string_view name) {
  Key key(1);
  for (const char c : lower_case(name)) {
    if (c == '.')
      key.emplace_back();
    else if (c != ' ' && c != '_' && c != '-')
      key.back() += c;
  }
  return key;
}

Key without_views(Key key, std::span<const Key> views) {
  std::erase_if(key,
                [&](const std::string& part) { return std::ranges::count(views, Key{part}) > 0; });
  return key;
}

bool ends_with(const Key& key, const Key& end) {
  return key.size() >= end.size() && std::equal(end.rbegin(), end.rend(), key.rbegin());
}

/// All spellings of `wanted`: itself, then other renderers' names for it. A view is its picture.
std::vector<Key> spellings(const Key& wanted, std::span<const Key> views) {
  std::vector<Key> result;
  if (std::ranges::count(views, wanted) > 0)
    for (const std::string& name : split(kPictureNames, " "))
      result.push_back({name, wanted.front()});
  result.push_back(wanted);
  for (const std::string_view pass : kSamePass) {
    const std::vector<std::string> names = split(pass, " ");
    if (std::ranges::count(names, wanted.back()) == 0) continue;
    for (const std::string& name : names) {
      result.push_back(wanted);
      result.back().back() = name;
    }
  }
  return result;
}

/// Lower is nearer: by the part of the name that is most like the last one of `wanted`.
std::size_t distance(const Key& wanted, std::string_view name) {
  constexpr std::size_t kLongest = 64;  // bounds the work on hostile input
  const std::string& word = wanted.back();
  std::size_t nearest = kLongest;
  for (const std::string& part : key_of(name.substr(0, 4 * kLongest))) {
    if (part.size() > kLongest || word.size() > kLongest) continue;
    const auto shared = std::size_t(std::ranges::mismatch(word, part).in1 - word.begin());
    const std::size_t edits = edit_distance(word, part);
    nearest = std::min(nearest, part.empty() ? kLongest : edits - std::min(edits, shared));
  }
  return nearest;
}

}  // namespace

std::vector<std::size_t> layers_meant(std::string_view wanted,
                                      std::span<const std::vector<std::string>> names,
                                      std::span<const std::string> views) {
  std::vector<Key> view_keys;
  for (const std::string& view : views) view_keys.push_back(key_of(view));
  std::vector<std::vector<Key>> keys;
  for (const auto& of_layer : names) {
    auto& all = keys.emplace_back();
    for (const std::string& name : of_layer) all.push_back(key_of(name));
  }
  const auto find = [&](const auto& fits) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < keys.size(); ++i)
      if (std::ranges::any_of(keys[i], fits)) found.push_back(i);
    return found;
  };
  const Key given = key_of(wanted);
  if (auto found = find([&](const Key& key) { return key == given; }); !found.empty()) return found;
  for (const Key& spelling : spellings(given, view_keys)) {
    if (auto found = find([&](const Key& key) { return ends_with(key, spelling); }); !found.empty())
      return found;
    for (const Key& view : view_keys)
      if (auto found = find([&](const Key& key) {
            return std::ranges::count(key, view.front()) > 0 &&
                   ends_with(without_views(key, view_keys), spelling);
          });
          !found.empty())
        return found;
  }
  return {};
}

bool is_called_picture(std::string_view name, std::span<const std::string> views) {
  std::vector<Key> view_keys;
  for (const std::string& view : views) view_keys.push_back(key_of(view));
  const Key key = without_views(key_of(name), view_keys);
  return !key.empty() && std::ranges::count(split(kPictureNames, " "), key.back()) > 0;
}

std::vector<std::string> nearest_first(std::string_view wanted,
                                       std::span<const std::string_view> names, std::size_t most) {
  constexpr std::size_t kCompared = 4096;  // bounds the work on hostile input
  std::vector<std::pair<std::size_t, std::size_t>> order;
  const Key key = key_of(wanted);
  for (std::size_t i = 0; i < std::min(names.size(), kCompared); ++i)
    order.emplace_back(distance(key, names[i]), i);
  std::ranges::sort(order);
  std::vector<std::string> result;
  for (const auto& [far, i] : order)
    if (result.size() < most) result.emplace_back(names[i]);
  return result;
}

}  // namespace lobelia
