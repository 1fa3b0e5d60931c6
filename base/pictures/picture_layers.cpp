#include "base/pictures/picture_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <map>
#include <optional>
#include <ranges>
#include <set>

#include "base/pictures/layer_names.hpp"
#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace {

struct SplitName {
  std::string prefix, suffix;  ///< the suffix in small letters
};

SplitName split_name(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return {dot == name.npos ? "" : name.substr(0, dot),
          lower_case(dot == name.npos ? name : name.substr(dot + 1))};
}

/// The channels of a part with one prefix: position by suffix.
using Group = std::map<std::string, std::size_t>;

std::optional<std::size_t> find_suffix(const Group& group, std::string_view letter,
                                       std::string_view word) {
  for (const std::string_view suffix : {letter, word})
    if (const auto found = group.find(std::string(suffix)); found != group.end())
      return found->second;
  return std::nullopt;
}

using SuffixNames = std::initializer_list<std::pair<std::string_view, std::string_view>>;

/// The channels with these names, or none if one is missing.
std::vector<std::size_t> find_all(const Group& group, SuffixNames names) {
  std::vector<std::size_t> result;
  for (const auto& [letter, word] : names)
    if (const auto at = find_suffix(group, letter, word)) result.push_back(*at);
  return result.size() == names.size() ? result : std::vector<std::size_t>{};
}

/// A layer without the name of its part.
struct RawLayer {
  PictureLayer layer;
  bool is_root = false;              ///< colours without a prefix
  std::optional<std::size_t> alpha;  ///< channel
};

std::vector<RawLayer> layers_of_part(const PicturePart& part, std::size_t index) {
  std::vector<std::string> order;
  std::map<std::string, Group> groups;
  for (std::size_t c = 0; c < part.channels.size(); ++c) {
    const SplitName name = split_name(part.channels[c]);
    if (!groups.contains(name.prefix)) order.push_back(name.prefix);
    groups[name.prefix].emplace(name.suffix, c);
  }
  std::vector<RawLayer> result;
  std::set<std::size_t> used;
  const auto add = [&](std::string name, std::vector<std::size_t> where, bool is_colour,
                       bool is_root) {
    used.insert(where.begin(), where.end());
    const Group& group = groups[name];
    const auto alpha = is_colour ? find_suffix(group, "a", "alpha") : std::nullopt;
    result.push_back({{std::move(name), index, std::move(where), is_colour}, is_root, alpha});
  };
  for (const std::string& prefix : order) {
    const Group& group = groups[prefix];
    const bool root = prefix.empty();
    const auto rgb = find_all(group, {{"r", "red"}, {"g", "green"}, {"b", "blue"}});
    auto vector = find_all(group, {{"x", "x"}, {"y", "y"}, {"z", "z"}});
    if (vector.empty()) vector = find_all(group, {{"x", "x"}, {"y", "y"}});
    const auto luminance_chroma = find_all(group, {{"y", "y"}, {"ry", "ry"}, {"by", "by"}});
    // Y alone would be half a picture.
    const bool chroma = group.contains("ry") || group.contains("by");
    if (!rgb.empty())
      add(prefix, rgb, true, root);
    else if (!luminance_chroma.empty() && vector.empty()) {
      add(prefix, luminance_chroma, true, root);
      result.back().layer.has_chroma = true;
    } else if (!vector.empty() && !root)
      add(prefix, vector, false, false);
    else if (const auto y = find_suffix(group, "y", "y"); y && vector.empty() && !chroma)
      add(prefix, {*y}, true, root);
  }
  for (std::size_t c = 0; c < part.channels.size(); ++c)
    if (!used.contains(c)) add(part.channels[c], {c}, false, false);
  return result;
}

std::string in_part(const PicturePart& part, std::size_t index, const std::string& name) {
  const std::string part_name = part.name.empty() ? fmt::format("part{}", index + 1) : part.name;
  if (name.empty()) return part_name;
  if (name == part_name || name.starts_with(part_name + ".")) return name;
  return part_name + "." + name;
}

constexpr std::size_t kShown = 40;  // a hostile file has thousands

/// The first of `count` names.
std::string list(std::span<const std::string> names, std::size_t count) {
  std::vector<std::string> shown;
  for (const auto& name : names | std::views::take(kShown))
    shown.push_back(fmt::format("'{}'", printable(name)));
  const std::size_t more = count - shown.size();
  return fmt::format("{}{}", fmt::join(shown, ", "),
                     more > 0 ? fmt::format(" and {} more", more) : "");
}

[[noreturn]] void no_picture(const std::string& where, std::span<const PicturePart> parts,
                             std::span<const PictureLayer> layers) {
  std::vector<std::string> channels, names;
  for (const PicturePart& part : parts)
    channels.insert(channels.end(), part.channels.begin(), part.channels.end());
  for (const PictureLayer& layer : layers) names.push_back(layer.name);
  throw Error(ExitCode::kInput,
              "{}: no channels R, G and B, and no Y: its channels are {}; a layer has to "
              "be chosen: {}",
              where, list(channels, channels.size()), list(names, names.size()));
}

/// The layer that a part's name means: its colours, or its only layer.
const PictureLayer* layer_of_part(std::size_t part, std::span<const PictureLayer> layers) {
  for (const PictureLayer& layer : layers)
    if (layer.part == part && layer.is_colour) return &layer;
  const bool is_only = std::ranges::count(layers, part, &PictureLayer::part) == 1;
  return is_only ? &*std::ranges::find(layers, part, &PictureLayer::part) : nullptr;
}

/// All views of a file, the default one first. A hostile file has thousands.
std::vector<std::string> views_of(std::span<const PicturePart> parts) {
  constexpr std::size_t kMostViews = 16;
  std::vector<std::string> views;
  const auto add = [&](const std::string& view) {
    if (!view.empty() && views.size() < kMostViews && std::ranges::count(views, view) == 0)
      views.push_back(view);
  };
  for (const PicturePart& part : parts) {
    add(part.view);
    std::ranges::for_each(part.views, add);
  }
  return views;
}

/// The end if there is none, or several are possible.
std::vector<RawLayer>::iterator find_picture(std::vector<RawLayer>& layers,
                                             std::span<const PicturePart> parts) {
  const auto first = [&](auto is) { return std::find_if(layers.begin(), layers.end(), is); };
  const auto is_colour = [](const RawLayer& raw) { return raw.layer.is_colour; };
  const auto is_rgb = [](const RawLayer& raw) {
    return raw.is_root && raw.layer.where.size() == 3;
  };
  const auto is_root = [](const RawLayer& raw) { return raw.is_root; };
  if (const auto rgb = first(is_rgb); rgb != layers.end()) return rgb;
  if (const auto grey = first(is_root); grey != layers.end()) return grey;
  if (std::ranges::count_if(layers, is_colour) == 1) return first(is_colour);
  const std::vector<std::string> views = views_of(parts);
  const auto has_other_view = [&](const RawLayer& raw) {
    const std::string& name = raw.layer.name;
    return std::ranges::any_of(views | std::views::drop(1), [&](const std::string& view) {
      return name.ends_with("." + view) || parts[raw.layer.part].view == view;
    });
  };
  const auto is_beauty = [&](const RawLayer& raw) {
    return raw.layer.is_colour && is_called_picture(raw.layer.name, views) && !has_other_view(raw);
  };
  if (std::ranges::count_if(layers, is_beauty) == 1) return first(is_beauty);
  return layers.size() == 1 && layers[0].layer.where.size() == 1 ? layers.begin() : layers.end();
}

/// All dotted names that a layer has: its own, and by part, view and the prefix of its channels.
std::vector<std::string> names_of(const PictureLayer& layer, const PicturePart& part) {
  const auto& channels = part.channels;
  const SplitName channel = split_name(channels[layer.where[0]]);
  const auto shares_prefix = [&](const std::string& other) {
    return split_name(other).prefix == channel.prefix;
  };
  std::vector<std::string> names{layer.name, in_part(part, layer.part, layer.name)};
  const bool is_whole_prefix = layer.is_colour || layer.where.size() > 1 ||
                               std::ranges::count_if(channels, shares_prefix) == 1;
  if (is_whole_prefix && !channel.prefix.empty()) {
    names.push_back(channel.prefix);
    if (!part.view.empty()) names.push_back(channel.prefix + "." + part.view);
  }
  if (!part.view.empty()) {
    names.push_back(part.view + "." + layer.name);
    if (layer.is_colour && channel.prefix.empty()) names.push_back(part.view);
  }
  std::erase(names, "");
  if (layer.name.empty()) {
    names.emplace_back("beauty");  // found by all names for it
    if (!part.views.empty()) names.push_back(part.views.front());
  }
  return names;
}

/// The layer that people call so. Throws Error(kInput) if it may be several.
const PictureLayer* layer_called(const std::string& where, std::span<const PicturePart> parts,
                                 std::span<const PictureLayer> layers, const std::string& name) {
  std::vector<std::vector<std::string>> names;
  for (const PictureLayer& layer : layers) names.push_back(names_of(layer, parts[layer.part]));
  const std::vector<std::size_t> found = layers_meant(name, names, views_of(parts));
  if (found.empty()) return nullptr;
  if (found.size() == 1) return &layers[found[0]];
  std::vector<std::string> several;
  for (const std::size_t i : found) several.push_back(layers[i].name);
  throw Error(ExitCode::kInput, "{}: layer '{}' may be {}; give more of its name", where,
              printable(name), list(several, several.size()));
}

}  // namespace

std::vector<PictureLayer> picture_layers(std::span<const PicturePart> parts) {
  std::vector<RawLayer> all;
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (RawLayer& raw : layers_of_part(parts[p], p)) all.push_back(std::move(raw));

  const auto picture = find_picture(all, parts);
  const bool has_picture = picture != all.end();
  if (has_picture) std::rotate(all.begin(), picture, picture + 1);

  std::vector<PictureLayer> result;
  std::set<std::string> names;
  std::map<std::string, int> copies;  // of a name, besides the first
  for (RawLayer& raw : all) {
    PictureLayer& layer = raw.layer;
    if (has_picture && result.empty())
      layer.name = "";
    else if (parts.size() > 1 && !(has_picture && layer.part == result[0].part))
      layer.name = in_part(parts[layer.part], layer.part, layer.name);
    const std::string name = layer.name;
    while (!names.insert(layer.name).second)
      layer.name = fmt::format("{}#{}", name, ++copies[name] + 1);
    result.push_back(std::move(layer));
  }
  std::map<std::pair<std::size_t, std::size_t>, std::string> single;  // by part and channel
  for (const PictureLayer& layer : result)
    if (layer.where.size() == 1) single[{layer.part, layer.where[0]}] = layer.name;
  for (std::size_t i = 0; i < result.size(); ++i)
    if (all[i].alpha) result[i].alpha = single[{result[i].part, *all[i].alpha}];
  return result;
}

std::vector<std::string> picture_layer_names(std::span<const PicturePart> parts) {
  std::vector<std::string> names;
  for (PictureLayer& layer : picture_layers(parts)) names.push_back(std::move(layer.name));
  return names;
}

PictureLayer find_layer(const std::string& where, std::span<const PicturePart> parts,
                        const std::string& name) {
  const std::vector<PictureLayer> layers = picture_layers(parts);
  for (const PictureLayer& layer : layers)
    if (layer.name == name) return layer;
  if (name.empty()) no_picture(where, parts, layers);
  bool is_part = false;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].name != name) continue;
    is_part = true;
    if (const PictureLayer* layer = layer_of_part(p, layers)) return *layer;
  }
  // The only layer of colours is the picture, but can also be found by the name of its channels.
  for (const PictureLayer& layer : layers) {
    const std::string& first = parts[layer.part].channels[layer.where[0]];
    const bool is_group = layer.is_colour || layer.where.size() > 1;
    if (!is_part && is_group && split_name(first).prefix == name) return layer;
  }
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& channels = parts[p].channels;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if (channels[c] != name && in_part(parts[p], p, channels[c]) != name) continue;
      const auto owner = std::find_if(layers.begin(), layers.end(), [&](const PictureLayer& layer) {
        return layer.part == p && std::ranges::count(layer.where, c) != 0;
      });
      return {name, p, {c}, owner->is_colour, ""};
    }
  }
  if (!is_part)
    if (const PictureLayer* layer = layer_called(where, parts, layers, name)) return *layer;
  std::vector<std::string_view> names;
  for (const PictureLayer& layer : layers)
    if (!layer.name.empty()) names.push_back(layer.name);
  throw Error(
      ExitCode::kInput,

      "{}: no layer '{}'{}; {}", where, printable(name), printable(did_you_mean(name, names)),
      names.empty() ? "there is the picture alone"
                    : "there are " + list(nearest_first(name, names, kShown), names.size()));
}

}  // namespace lobelia
