#include "compare/layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "compare/overscan.hpp"
#include "compare/require_same_size.hpp"
#include "core/error.hpp"
#include "core/image_io.hpp"
#include "core/image_values.hpp"
#include "core/text.hpp"

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

records::Window window_record(const PixelWindow& window) {
  return {window.x, window.y, window.width, window.height};
}

records::PictureRead picture_record(const PictureSource& source) {
  records::PictureRead record;
  record.format = source.format;
  record.layer = source.layer;
  record.channels = source.channels;
  record.value_type = source.value_type;
  record.transfer = source.transfer;
  record.multiplied_by_alpha = source.multiplied_by_alpha;
  record.data_window = window_record(source.data);
  record.display_window = window_record(source.display);
  record.chromaticities = source.chromaticities;
  record.icc_profile = source.icc_profile;
  if (!source.icc_profile.empty()) record.icc_profile_is_srgb = source.icc_is_srgb;
  return record;
}

records::LayerComparison layer_record(const LayerComparison& layer) {
  records::LayerComparison record;
  record.layer = layer.name;
  record.verdict = verdict_name(layer.verdict());
  if (layer.overscan) record.overscan = window_record(*layer.overscan);
  if (layer.identical) record.identical = true;
  record.problem = layer.problem;
  if (layer.comparison) {
    records::Comparison whole = comparison_record(*layer.comparison, "", "");
    record.nonfinite = std::move(whole.nonfinite);
    record.metrics = std::move(whole.metrics);
    record.limits = std::move(whole.limits);
    record.disagreement = std::move(whole.disagreement);
    record.not_measured = std::move(whole.not_measured);
  }
  record.pictures = pictures_record(layer.a, layer.b);
  return record;
}

bool are_identical(const Image& a, const Image& b) {
  return std::ranges::equal(a.values(), b.values()) && is_finite(a);
}

LayerComparison compare_overscan(const std::string& name, const PicturePair& pair,
                                 const Overscan& overscan, const ComparisonOptions& options) {
  LayerComparison result{name, pair.a.source, pair.b.source, {}, {}};
  const PixelWindow& window = *(result.overscan = overscan.window);
  result.problem = window_problem("the window of all data", window);
  if (!result.problem.empty()) return result;
  OverscanPictures pictures = on_window(pair.a, pair.b, window);
  if (allows_equal_nonfinite(options, pair.b.source)) clear_equal_nonfinite(pictures.a, pictures.b);
  if (pictures.only_a + pictures.only_b > 0)
    result.problem = fmt::format("pixels that are not 0 where the other has none: {} of a, {} of b",
                                 pictures.only_a, pictures.only_b);
  else if (pictures.identical)
    result.identical = true;
  else
    result.comparison =
        compare(pictures.a, pictures.b, on_window(options, pair.a.source.display, window));
  return result;
}

/// The layer and, where there is one, its overscan.
std::vector<LayerComparison> compare_layer(const fs::path& a, const fs::path& b,
                                           const std::string& name,
                                           const ComparisonOptions& options) {
  PicturePair pair = read_pair(a, b, name);
  LayerComparison layer{name, pair.a.source, pair.b.source, {}, {}};
  const PixelWindow &size_a = layer.a.display, &size_b = layer.b.display;
  if (size_a.width != size_b.width || size_a.height != size_b.height) {
    layer.problem = fmt::format("the sizes differ: {} x {} against {} x {}", size_a.width,
                                size_a.height, size_b.width, size_b.height);
    return {layer};
  }
  layer.comparison = compare_pictures(pair, a.string(), b.string(), options);
  std::vector<LayerComparison> results{std::move(layer)};
  if (const auto overscan = find_overscan(pair.a.source, pair.b.source))
    results.push_back(compare_overscan(name, pair, *overscan, options));
  return results;
}

bool is_opaque(const fs::path& file, const std::string& alpha) {
  return std::ranges::all_of(read_picture(file, alpha).image.values(),
                             [](float value) { return value == 1; });
}

/// A share of the pixel and no light: seen as it is.
ComparisonOptions options_of_alpha(ComparisonOptions options) {
  options.viewing.exposure_stops = 0;
  options.viewing.display = nullptr;
  return options;
}

LayerComparison compare_alpha(const fs::path& a, const fs::path& b, const PicturePair& picture,
                              const ComparisonOptions& options) {
  PicturePair pair{read_picture(a, picture.a.source.alpha),
                   read_picture(b, picture.b.source.alpha)};
  LayerComparison layer{picture.a.source.alpha, pair.a.source, pair.b.source, {}, {}};
  layer.identical = are_identical(pair.a.image, pair.b.image);
  if (!layer.identical)
    layer.comparison = compare_pictures(pair, a.string(), b.string(), options_of_alpha(options));
  return layer;
}

/// Takes out of the layers of one file those that say of common layers that they are opaque, as no alpha does.
void drop_opaque_alpha(const fs::path& a, const fs::path& b, const PictureSource& layer_a,
                       const PictureSource& layer_b, CommonLayers& common) {
  const auto drop = [](const fs::path& file, const std::string& alpha, const std::string& other,
                       std::vector<std::string>& names) {
    const auto found = std::ranges::find(names, alpha);
    if (!alpha.empty() && other.empty() && found != names.end() && is_opaque(file, alpha))
      names.erase(found);
  };
  drop(a, layer_a.alpha, layer_b.alpha, common.only_a);
  drop(b, layer_b.alpha, layer_a.alpha, common.only_b);
}

Names layer_and_alpha(const PictureSource& source) {
  Names names{source.layer};
  if (!source.alpha.empty()) names.insert(source.alpha);
  return names;
}

/// Layers of both files that are not among those that were looked at.
std::vector<std::string> layers_left(const PicturePair& picture, const Names& looked_at_in_a,
                                     const Names& looked_at_in_b) {
  std::vector<std::string> left;
  Names taken;
  for (const auto& [source, looked_at] :
       {std::pair(&picture.a.source, &looked_at_in_a), {&picture.b.source, &looked_at_in_b}})
    for (const std::string& name : source->layers)
      if (!looked_at->contains(name) && taken.insert(name).second) left.push_back(name);
  return left;
}

}  // namespace

Verdict LayerComparison::verdict() const {
  if (!problem.empty()) return Verdict::kDiffers;
  return identical ? Verdict::kPass : comparison->verdict;
}

std::string LayerComparison::title() const {
  if (name.empty()) return overscan ? "overscan of the picture" : "layer of the picture";
  return (overscan ? "overscan of layer " : "layer ") + printable(name);
}

PicturePair read_pair(const fs::path& a, const fs::path& b, const std::string& layer) {
  return {read_picture(a, layer), read_picture(b, layer)};
}

bool allows_equal_nonfinite(const ComparisonOptions& options, const PictureSource& source) {
  // The only channel's name stands for a picture without a layer's.
  const bool has_depth = is_depth_like(source.layer) ||
                         (source.channels.size() == 1 && is_depth_like(source.channels[0]));
  return options.allow_equal_nonfinite || (has_depth && !options.noise);
}

Comparison compare_pictures(PicturePair& pair, const std::string& file_a, const std::string& file_b,
                            const ComparisonOptions& options) {
  require_same_size(pair.a.image, pair.b.image, file_a, file_b);
  std::optional<std::int64_t> equal;
  if (allows_equal_nonfinite(options, pair.b.source))
    equal = clear_equal_nonfinite(pair.a.image, pair.b.image);
  Comparison comparison = compare(pair.a.image, pair.b.image, options);
  comparison.equal_nonfinite = equal;
  if (auto& place = comparison.first_nonfinite_a) name_channel(*place, pair.a.source);
  if (auto& place = comparison.first_nonfinite_b) name_channel(*place, pair.b.source);
  return comparison;
}

CommonLayers common_layers(const fs::path& a, const fs::path& b) {
  const std::vector<std::string> in_a = layer_names(a), in_b = layer_names(b);
  CommonLayers result;
  result.only_a = without(in_a, in_b);
  result.only_b = without(in_b, in_a);
  result.both = without(in_a, result.only_a);
  if (result.both.empty())
    throw Error(ExitCode::kInput,
                fmt::format("{} and {} have no layer of one name", a.string(), b.string()));
  return result;
}

OtherLayers compare_others(const fs::path& a, const fs::path& b, const PicturePair& picture,
                           const LayerOptions& layers, const ComparisonOptions& options) {
  const PictureSource &source_a = picture.a.source, &source_b = picture.b.source;
  const bool alpha_in_a = !source_a.alpha.empty(), alpha_in_b = !source_b.alpha.empty();
  OtherLayers result;
  NotCompared& left = result.not_compared;
  left.mip_levels = std::max(source_a.mip_levels, source_b.mip_levels) - 1;
  const auto overscan = find_overscan(source_a, source_b);
  if (options.noise) {
    left.overscan_pixels = overscan ? overscan->pixels : 0;
  } else if (overscan) {
    result.compared.push_back(compare_overscan(source_a.layer, picture, *overscan, options));
  }
  if (options.noise || layers.ignore_alpha)
    left.alpha = alpha_in_a || alpha_in_b;
  else if (alpha_in_a && alpha_in_b)
    result.compared.push_back(compare_alpha(a, b, picture, options));
  else if (alpha_in_a || alpha_in_b)
    left.alpha = !(alpha_in_a ? is_opaque(a, source_a.alpha) : is_opaque(b, source_b.alpha));

  Names in_a = layer_and_alpha(source_a), in_b = layer_and_alpha(source_b);
  if (layers.all) {
    CommonLayers& common = result.common.emplace(common_layers(a, b));
    if (layers.ignore_alpha || (alpha_in_a && alpha_in_b)) {
      std::erase(common.only_a, source_a.alpha);
      std::erase(common.only_b, source_b.alpha);
    } else {
      left.alpha = left.alpha && alpha_in_a;  // that of b is missing, and fails
      drop_opaque_alpha(a, b, source_a, source_b, common);
    }
    for (const std::string& name : common.both) {
      if (in_a.contains(name) || in_b.contains(name)) continue;
      for (LayerComparison& layer : compare_layer(a, b, name, options)) {
        drop_opaque_alpha(a, b, layer.a, layer.b, common);
        left.mip_levels =
            std::max({left.mip_levels, layer.a.mip_levels - 1, layer.b.mip_levels - 1});
        result.compared.push_back(std::move(layer));
      }
    }
    in_a.insert(common.both.begin(), common.both.end());
    in_b.insert(source_b.layers.begin(), source_b.layers.end());
  }
  left.layers = layers_left(picture, in_a, in_b);
  return result;
}

Verdict worst_verdict(Verdict picture, const OtherLayers& others) {
  Verdict worst = picture;
  for (const LayerComparison& layer : others.compared) worst = std::max(worst, layer.verdict());
  if (others.common && !others.common->only_b.empty()) worst = std::max(worst, Verdict::kDiffers);
  return worst;
}

records::PicturesRead pictures_record(const PictureSource& a, const PictureSource& b) {
  return {picture_record(a), picture_record(b)};
}

void add_layers(records::Comparison& record, Verdict worst, const OtherLayers& others) {
  record.verdict = verdict_name(worst);
  record.not_compared = others.not_compared;
  auto& layers = record.layers.emplace();
  for (const LayerComparison& layer : others.compared) layers.push_back(layer_record(layer));
  if (others.common)
    record.layers_in_one = records::LayersInOne{others.common->only_a, others.common->only_b};
}

}  // namespace lobelia
