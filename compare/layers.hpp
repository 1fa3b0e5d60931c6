// Two pictures' files, layer by layer.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "compare/compare.hpp"
#include "core/picture.hpp"

namespace lobelia {

struct PicturePair {
  Picture a, b;
};
struct PicturePairSource {
  PictureSource a, b;
};

/// Reads one layer of both, "" for the picture itself. Errors as read_picture.
PicturePair read_pair(const std::filesystem::path& a, const std::filesystem::path& b,
                      const std::string& layer);

struct LayerComparison {
  std::string name;
  PictureSource a, b;
  /// Nothing if their sizes differ, which `problem` says: as bad as one that differs.
  std::optional<Comparison> comparison;
  std::string problem;
};

/// Which layers there are to compare. The pictures themselves ("") are one where both have one.
struct CommonLayers {
  std::vector<std::string> both, only_a, only_b;  ///< in the order of the file; of `both` in a's
};

/// The layers besides the one that was compared as the picture.
struct OtherLayers {
  CommonLayers common;
  std::vector<LayerComparison> compared;
};

/// Throws Error(kInput) if no layer is in both; otherwise errors as layer_names.
CommonLayers common_layers(const std::filesystem::path& a, const std::filesystem::path& b);

/// Compares the layers of those names, one pair in memory at a time. Errors as read_picture and compare.
std::vector<LayerComparison> compare_layers(const std::filesystem::path& a,
                                            const std::filesystem::path& b,
                                            std::span<const std::string> names,
                                            const ComparisonOptions& options);

/// Of the picture and its layers.
Verdict worst_verdict(Verdict picture, std::span<const LayerComparison> layers);

/// Adds `pictures` to a record of comparison_record().
void add_pictures(Json& record, const PictureSource& a, const PictureSource& b);

/// Adds `layers` and `layersInOne` to it, and makes `verdict` the worst of all.
void add_layers(Json& record, Verdict worst, std::span<const LayerComparison> layers,
                const CommonLayers& common);

}  // namespace lobelia
