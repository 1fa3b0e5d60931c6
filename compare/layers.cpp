#include "compare/layers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/image_io.hpp"

namespace lobelia {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> without(std::span<const std::string> names,
                                 std::span<const std::string> others) {
  std::vector<std::string> result;
  for (const std::string& name : names)
    if (std::ranges::find(others, name) == others.end()) result.push_back(name);
  return result;
}

Json sources_json(const PictureSource& a, const PictureSource& b) {
  return {{"a", to_json(a)}, {"b", to_json(b)}};
}

}  // namespace

PicturePair read_pair(const fs::path& a, const fs::path& b, const std::string& layer) {
  return {read_picture(a, layer), read_picture(b, layer)};
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

std::vector<LayerComparison> compare_layers(const fs::path& a, const fs::path& b,
                                            std::span<const std::string> names,
                                            const ComparisonOptions& options) {
  std::vector<LayerComparison> results;
  for (const std::string& name : names) {
    const PicturePair pair = read_pair(a, b, name);
    LayerComparison layer{name, pair.a.source, pair.b.source, {}, {}};
    const PixelWindow &size_a = layer.a.display, &size_b = layer.b.display;
    if (size_a.width == size_b.width && size_a.height == size_b.height)
      layer.comparison = compare(pair.a.image, pair.b.image, options);
    else
      layer.problem = fmt::format("the sizes differ: {} x {} against {} x {}", size_a.width,
                                  size_a.height, size_b.width, size_b.height);
    results.push_back(std::move(layer));
  }
  return results;
}

Verdict worst_verdict(Verdict picture, std::span<const LayerComparison> layers) {
  Verdict worst = picture;
  for (const LayerComparison& layer : layers)
    worst = std::max(worst, layer.comparison ? layer.comparison->verdict : Verdict::kDiffers);
  return worst;
}

void add_pictures(Json& record, const PictureSource& a, const PictureSource& b) {
  record["pictures"] = sources_json(a, b);
}

void add_layers(Json& record, Verdict worst, std::span<const LayerComparison> layers,
                const CommonLayers& common) {
  record["verdict"] = verdict_name(worst);
  record["layers"] = Json::array();
  for (const LayerComparison& layer : layers) {
    Json entry = {{"layer", layer.name}};
    if (layer.comparison) {
      const Json whole = comparison_record(*layer.comparison, "", "");
      for (const char* key : {"verdict", "nonfinite", "metrics", "limits", "disagreement"})
        entry[key] = whole[key];
    } else {
      entry["verdict"] = verdict_name(Verdict::kDiffers);
      entry["problem"] = layer.problem;
    }
    entry["pictures"] = sources_json(layer.a, layer.b);
    record["layers"].push_back(std::move(entry));
  }
  record["layersInOne"] = {{"a", common.only_a}, {"b", common.only_b}};
}

}  // namespace lobelia
