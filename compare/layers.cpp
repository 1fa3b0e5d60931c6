#include "compare/layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/pictures/image_io.hpp"
#include "base/pictures/image_values.hpp"
#include "base/pictures/picture_colour.hpp"
#include "base/words/text.hpp"
#include "compare/cryptomatte.hpp"
#include "compare/layer_types.hpp"
#include "compare/mask.hpp"
#include "compare/overscan.hpp"
#include "profile/require_same_size.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

using Names = std::set<std::string>;

std::vector<std::string> without(std::span<const std::string> names,
                                 std::span<const std::string> others) {
  const Names taken(others.begin(), others.end());
  std::vector<std::string> result;
  for (const std::string& name : names)
    if (!taken.contains(name)) result.push_back(name);
  return result;
}

std::string names_text(const std::vector<std::string>& layers) {
  constexpr std::size_t kShown = 40;  // a hostile file has thousands
  std::string text = layers.size() == 1 ? "layer " : "layers ";
  for (std::size_t i = 0; i < std::min(layers.size(), kShown); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ",
                        layers[i].empty() ? "of the picture" : "'" + printable(layers[i]) + "'");
  if (layers.size() > kShown) text += fmt::format(" and {} more", layers.size() - kShown);
  return text;
}

bool are_identical(const Image& a, const Image& b) {
  return have_equal_values(a, b) && is_finite(a);
}

/// Replaces a file's values by those that it stores. An array has no file.
void read_again_as_stored(PicturePair& pair, const std::string& file_a, const std::string& file_b) {
  for (const auto& [picture, file] : {std::pair(&pair.a, &file_a), {&pair.b, &file_b}})
    if (picture->source.format.empty()) return;
  for (const auto& [picture, file] : {std::pair(&pair.a, &file_a), {&pair.b, &file_b}})
    if (!picture->source.as_stored) *picture = read_stored_picture(*file, picture->source.layer);
}

/// Compares a layer that is no Cryptomatte, and its overscan if there is one.
std::vector<LayerComparison> compare_layer(const fs::path& a, const fs::path& b,
                                           const std::string& name, PicturePair pair,
                                           const ComparisonOptions& options) {
  LayerComparison layer{name, pair.a.source, pair.b.source};
  layer.type = type_of_layers(layer.a, layer.b, options);
  const PixelWindow &size_a = layer.a.display, &size_b = layer.b.display;
  if (size_a.width != size_b.width || size_a.height != size_b.height) {
    layer.problem = fmt::format("the sizes differ: {} x {} against {} x {}", size_a.width,
                                size_a.height, size_b.width, size_b.height);
    return {layer};
  }
  if (layer.type == LayerType::kIdentifier) read_again_as_stored(pair, a.string(), b.string());
  take_part(pair, a.string(), b.string(), options);
  layer.comparison = compare_pictures(pair, a.string(), b.string(), options);
  std::vector<LayerComparison> results{std::move(layer)};
  if (options.crop) return results;
  if (const auto overscan = find_overscan(pair.a.source, pair.b.source))
    results.push_back(compare_overscan(name, pair, *overscan, options));
  return results;
}

/// A difference if one side alone has an alpha that is not 1 everywhere: an alpha of 1 equals none.
std::optional<LayerComparison> find_lost_alpha(const fs::path& a, const fs::path& b,
                                               const PictureSource& source_a,
                                               const PictureSource& source_b,
                                               const ComparisonOptions& options) {
  const bool has_a = !source_a.alpha.empty();
  if (has_a != source_b.alpha.empty()) return std::nullopt;
  const std::string& name = has_a ? source_a.alpha : source_b.alpha;
  PicturePair pair{read_picture(has_a ? a : b, name), {}};
  pair.b.image = Image(pair.a.image.width(), pair.a.image.height());
  std::ranges::fill(pair.b.image.values(), 1.0f);
  take_part(pair, a.string(), b.string(), options);
  // Weights of a filter that add up to 1 are off by their rounding.
  constexpr float kRounding = 1e-3f;
  std::int64_t pixels = 0;
  float least = 1;
  for (std::size_t i = 0; i < pair.a.image.values().size(); i += 3) {
    const float value = pair.a.image.values()[i];
    if (std::abs(value - 1) <= kRounding) continue;
    ++pixels;
    least = std::fmin(least, value);
  }
  if (pixels == 0) return std::nullopt;
  LayerComparison layer{name, has_a ? pair.a.source : source_a, has_a ? source_b : pair.a.source};
  layer.type = LayerType::kAlpha;
  layer.problem =
      fmt::format("only {} has this alpha, and {} of it {} not 1, the least {:.3g}",
                  has_a ? 'a' : 'b', pixels == 1 ? "1 pixel" : fmt::format("{} pixels", pixels),
                  pixels == 1 ? "is" : "are", least);
  return layer;
}

/// Removes alphas from the list of unpaired layers if they were judged with their colours, or are not judged.
void take_out_alpha(const PictureSource& layer_a, const PictureSource& layer_b,
                    CommonLayers& common) {
  if (!layer_a.alpha.empty()) std::erase(common.only_a, layer_a.alpha);
  if (!layer_b.alpha.empty()) std::erase(common.only_b, layer_b.alpha);
}

Names layer_and_alpha(const PictureSource& source) {
  Names names{source.layer};
  if (!source.alpha.empty()) names.insert(source.alpha);
  return names;
}

/// Throws Error(kInput) where a type was given for a layer that neither file has.
void require_layers_of_types(const PictureSource& a, const PictureSource& b,
                             const ComparisonOptions& options) {
  for (const LayerTypeChoice& choice : options.layer_types) {
    const auto is_it = [&](const PictureSource& source) {
      if (is_layer_called(source, choice.layer)) return true;
      PictureSource other;
      other.cryptomattes = source.cryptomattes;
      return std::ranges::any_of(source.layers, [&](const std::string& layer) {
        other.layer = layer;
        return is_layer_called(other, choice.layer);
      });
    };
    if (is_it(a) || is_it(b)) continue;
    std::vector<std::string_view> names(b.layers.begin(), b.layers.end());
    std::erase(names, "");
    throw Error(ExitCode::kInput, "--layer-type: no layer '{}'{}", printable(choice.layer),
                printable(did_you_mean(choice.layer, names)));
  }
}

/// Layers of both files without the compared ones; a name once.
std::vector<std::string> layers_left(const PicturePair& picture, const Names& compared_in_a,
                                     const Names& compared_in_b) {
  std::vector<std::string> left;
  Names taken;
  for (const auto& [source, compared] :
       {std::pair(&picture.a.source, &compared_in_a), {&picture.b.source, &compared_in_b}})
    for (const std::string& name : source->layers)
      if (!compared->contains(name) && taken.insert(name).second) left.push_back(name);
  return left;
}

}  // namespace

Verdict LayerComparison::verdict() const {
  if (!problem.empty()) return Verdict::kDiffers;
  return identical ? Verdict::kPass : comparison->verdict;
}

std::string LayerComparison::title() const {
  std::string title = overscan ? "overscan of " : "";
  title += name.empty() ? (overscan ? "the picture" : "layer of the picture")
                        : "layer " + printable(name);
  if (type != LayerType::kColour) title += fmt::format(" ({})", layer_type_name(type));
  return title;
}

LayerNames parse_layer_names(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos) return {text, text};
  LayerNames names{text.substr(0, equals), text.substr(equals + 1)};
  if (names.a.empty() || names.b.empty())
    throw Error(ExitCode::kUsage,
                "--layer {}: expected NAME, or NAME=NAME where the files call it "
                "differently",
                printable(text));
  return names;
}

// One after the other: a second reader would load its libraries again, which takes longer than most pictures.
PicturePair read_pair(const fs::path& a, const fs::path& b, const LayerNames& layer) {
  return {read_picture(a, layer.a), read_picture(b, layer.b)};
}

void take_part(PicturePair& pair, const std::string& file_a, const std::string& file_b,
               const ComparisonOptions& options) {
  Image &a = pair.a.image, &b = pair.b.image;
  require_same_size(a, b, file_a, file_b);
  if (options.crop) b = cut(std::move(b), *options.crop);
  take_part(a, b, options);
}

void take_part(Image& a, Image& b, const ComparisonOptions& options) {
  if (options.crop) a = cut(std::move(a), *options.crop);
  if (options.ignored.empty()) return;
  if (options.ignored.size() != b.pixel_count())
    throw Error(ExitCode::kInput, "a layer has {} x {} pixels, the ignored part belongs to {}",
                b.width(), b.height(), options.ignored.size());
  for (std::size_t i = 0; i < b.values().size(); ++i) {
    if (options.ignored[i / 3] == 0) continue;
    float& value = b.values()[i];
    if (!std::isfinite(value)) value = 0;
    a.values()[i] = value;
  }
}

bool allows_equal_nonfinite(const ComparisonOptions& options, const PictureSource& source) {
  // A picture without a layer's name is known by the name of its only channel.
  const bool has_depth = is_depth_like(source.layer) ||
                         (source.channels.size() == 1 && is_depth_like(source.channels[0]));
  return options.allow_equal_nonfinite || (has_depth && !options.noise);
}

double rounding_of(const PictureSource& source, double value) {
  const double steps = source.value_type == "uint8"    ? 255
                       : source.value_type == "uint16" ? 65535
                                                       : 0;
  if (steps == 0) return 0;
  // A profile's curve is taken for that of sRGB: most are near it.
  const auto named = named_curve(source.transfer), srgb = named_curve("sRGB");
  const auto decoded = [&](double code) {
    Image one(1, 1);
    std::ranges::fill(one.values(), float(std::clamp(code, 0.0, 1.0)));
    decode(named ? *named : *srgb, one);
    return double(one.values()[0]);
  };
  if (!(value >= 0 && value <= decoded(1))) return 0;
  double below = 0, above = 1;
  for (int i = 0; i < 40; ++i) {
    const double middle = (below + above) / 2;
    (decoded(middle) < value ? below : above) = middle;
  }
  return std::max(
      {0.0, decoded(above + 0.5 / steps) - value, value - decoded(above - 0.5 / steps)});
}

Comparison compare_pictures(PicturePair& pair, const std::string& file_a, const std::string& file_b,
                            const ComparisonOptions& options) {
  require_same_size(pair.a.image, pair.b.image, file_a, file_b);
  const PictureSource &source_a = pair.a.source, &source_b = pair.b.source;
  const LayerType type = type_of_layers(source_a, source_b, options);
  if (const auto rank = cryptomatte_of(source_a, source_b, options))
    return compare_cryptomattes(read_cryptomatte(file_a, source_a, *rank, options),
                                read_cryptomatte(file_b, source_b, *rank, options), options);
  const bool is_stored = source_a.as_stored && source_b.as_stored;
  if (type == LayerType::kIdentifier && !is_stored && !source_a.format.empty() &&
      !source_b.format.empty()) {
    PicturePair stored = pair;
    read_again_as_stored(stored, file_a, file_b);
    take_part(stored, file_a, file_b, options);
    return compare_values(stored.a.image, stored.b.image, source_a, source_b, type, options);
  }
  ComparisonOptions rounded = options;
  const double peak = peak_value(pair.b.image);
  for (const Picture* one : {&pair.a, &pair.b})
    rounded.rounding = std::max(rounded.rounding, rounding_of(one->source, peak));
  Comparison comparison =
      compare_values(pair.a.image, pair.b.image, source_a, source_b, type, rounded);
  if (auto& first = comparison.nonfinite.first) {
    if (first->a) name_channel(*first->a, pair.a.source);
    if (first->b) name_channel(*first->b, pair.b.source);
  }
  return comparison;
}

LayerComparison compare_alpha(const std::string& name, PicturePair pair, const std::string& file_a,
                              const std::string& file_b, const ComparisonOptions& options) {
  LayerComparison layer{name, pair.a.source, pair.b.source};
  layer.type = type_of_layers(layer.a, layer.b, options);
  take_part(pair, file_a, file_b, options);
  layer.identical = are_identical(pair.a.image, pair.b.image);
  if (!layer.identical) layer.comparison = compare_pictures(pair, file_a, file_b, options);
  return layer;
}

CommonLayers common_layers(const fs::path& a, const fs::path& b) {
  const std::vector<std::string> in_a = layer_names(a), in_b = layer_names(b);
  CommonLayers result;
  result.only_a = without(in_a, in_b);
  result.only_b = without(in_b, in_a);
  result.both = without(in_a, result.only_a);
  if (result.both.empty())
    throw Error(ExitCode::kInput, "{} and {} have no layer of one name", a.string(), b.string());
  return result;
}

OtherLayers compare_others(const fs::path& a, const fs::path& b, const PicturePair& picture,
                           const LayerOptions& layers, const ComparisonOptions& options) {
  const PictureSource &source_a = picture.a.source, &source_b = picture.b.source;
  require_layers_of_types(source_a, source_b, options);
  const bool alpha_in_a = !source_a.alpha.empty(), alpha_in_b = !source_b.alpha.empty();
  const bool is_identifier = type_of_layers(source_a, source_b, options) == LayerType::kIdentifier;
  OtherLayers result;
  NotCompared& left = result.not_compared;
  left.mip_levels = std::max(source_a.mip_levels, source_b.mip_levels) - 1;
  const auto overscan = find_overscan(source_a, source_b);
  const auto rank = cryptomatte_of(source_a, source_b, options);
  if (options.noise || options.crop) {
    left.overscan_pixels = overscan ? overscan->pixels : 0;
  } else if (overscan && rank) {
    result.compared.push_back(
        compare_cryptomatte_overscan(*rank, a, b, {source_a, source_b}, *overscan, options));
  } else if (overscan) {
    PicturePair stored = picture;
    if (is_identifier) read_again_as_stored(stored, a.string(), b.string());
    result.compared.push_back(compare_overscan(source_a.layer, stored, *overscan, options));
  }
  if (!is_identifier) {
    if (layers.ignore_alpha || (options.noise && alpha_in_a && alpha_in_b))
      left.alpha = alpha_in_a || alpha_in_b;
    else if (alpha_in_a && alpha_in_b)
      result.compared.push_back(compare_alpha(
          source_a.alpha, {read_picture(a, source_a.alpha), read_picture(b, source_b.alpha)},
          a.string(), b.string(), options));
    else if (auto lost = find_lost_alpha(a, b, source_a, source_b, options))
      result.compared.push_back(std::move(*lost));
  }

  Names in_a = layer_and_alpha(source_a), in_b = layer_and_alpha(source_b);
  const auto take_ranks = [&](const PicturePairSource& of, const CryptomatteRank& of_rank) {
    for (const auto& [source, names] : {std::pair(&of.a, &in_a), {&of.b, &in_b}})
      for (const std::string& name : cryptomatte_layers(*source, of_rank)) names->insert(name);
  };
  if (rank) take_ranks({source_a, source_b}, *rank);
  if (layers.all) {
    CommonLayers& common = result.common.emplace(common_layers(a, b));
    if (!is_identifier) take_out_alpha(source_a, source_b, common);
    for (const std::string& name : common.both) {
      if (in_a.contains(name) || in_b.contains(name)) continue;
      PicturePair pair = read_pair(a, b, {name, name});
      const PicturePairSource of{pair.a.source, pair.b.source};
      left.mip_levels = std::max({left.mip_levels, of.a.mip_levels - 1, of.b.mip_levels - 1});
      if (const auto of_rank = cryptomatte_of(of.a, of.b, options)) {
        LayerComparison layer{of_rank->name, of.a, of.b};
        layer.type = LayerType::kIdentifier;
        layer.comparison = compare_pictures(pair, a.string(), b.string(), options);
        result.compared.push_back(std::move(layer));
        const auto outside = options.crop ? std::nullopt : find_overscan(of.a, of.b);
        if (outside)
          result.compared.push_back(
              compare_cryptomatte_overscan(*of_rank, a, b, of, *outside, options));
        take_ranks(of, *of_rank);
        continue;
      }
      std::vector<LayerComparison> made = compare_layer(a, b, name, std::move(pair), options);
      const bool has_alpha = made.front().type != LayerType::kIdentifier;
      const bool is_comparable = made.front().problem.empty();
      std::ranges::move(made, std::back_inserter(result.compared));
      if (!has_alpha) continue;
      if (auto lost = is_comparable ? find_lost_alpha(a, b, of.a, of.b, options)
                                    : std::optional<LayerComparison>())
        result.compared.push_back(std::move(*lost));
      if (of.a.alpha.empty() != of.b.alpha.empty()) take_out_alpha(of.a, of.b, common);
      in_a.insert(of.a.alpha);
    }
    in_a.insert(common.both.begin(), common.both.end());
    in_b.insert(source_b.layers.begin(), source_b.layers.end());
  }
  left.layers = layers_left(picture, in_a, in_b);
  return result;
}

bool is_empty(const NotCompared& not_compared) {
  return not_compared.layers.empty() && !not_compared.alpha && not_compared.overscan_pixels == 0 &&
         not_compared.mip_levels == 0;
}

std::string to_text(const NotCompared& not_compared) {
  std::vector<std::string> parts;
  if (!not_compared.layers.empty()) parts.push_back(names_text(not_compared.layers));
  if (not_compared.alpha) parts.emplace_back("alpha");
  if (not_compared.overscan_pixels > 0)
    parts.push_back(
        fmt::format("{} pixels outside of the display window", not_compared.overscan_pixels));
  if (not_compared.mip_levels > 0)
    parts.push_back(fmt::format("{} smaller MIP level{}", not_compared.mip_levels,
                                not_compared.mip_levels == 1 ? "" : "s"));
  if (parts.empty()) return "nothing";
  return fmt::format("{}", fmt::join(parts, "; "));
}

Verdict worst_verdict(Verdict picture, const OtherLayers& others) {
  // Where noise is known a difference has another name, and comes after kSame.
  const Verdict differs = picture >= Verdict::kSame ? Verdict::kDifferent : Verdict::kDiffers;
  Verdict worst = picture;
  const auto count = [&](Verdict verdict) {
    worst = std::max(worst, verdict == Verdict::kDiffers ? differs : verdict);
  };
  for (const LayerComparison& layer : others.compared) count(layer.verdict());
  if (others.common && !others.common->only_b.empty()) count(Verdict::kDiffers);
  return worst;
}

}  // namespace lobelia
