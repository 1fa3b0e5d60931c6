// Two pictures' files, layer by layer.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/compare.hpp"
#include "compare/not_compared.hpp"
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

/// Asked for, or the layer is_depth_like() and no noise is known.
bool allows_equal_nonfinite(const ComparisonOptions& options, const PictureSource& source);

/// compare() of pictures as they were read, named by their files. Non-finite values that both have become 0 in
/// `pair` where allows_equal_nonfinite(). Throws Error(kInput) if the sizes differ, and as compare().
Comparison compare_pictures(PicturePair& pair, const std::string& file_a, const std::string& file_b,
                            const ComparisonOptions& options);

struct LayerOptions {
  std::string layer;          ///< "" for the picture itself
  bool all = false;           ///< and all others that both have
  bool ignore_alpha = false;  ///< that of the picture
};

/// A layer, or what a layer has outside of its display window.
struct LayerComparison {
  std::string name;
  PictureSource a, b;
  /// Nothing where it is not needed: they are identical, or `problem` says what is wrong.
  std::optional<Comparison> comparison;
  std::string problem;     ///< as bad as a difference: the sizes differ
  bool identical = false;  ///< and finite; not measured
  /// With it this is the comparison of all data on this window; (0, 0) is the display window's first pixel.
  std::optional<PixelWindow> overscan = {};

  Verdict verdict() const;
  std::string title() const;  ///< "layer Z", "overscan of the picture"
};

/// Which layers there are to compare. The pictures themselves ("") are one where both have one.
struct CommonLayers {
  std::vector<std::string> both, only_a, only_b;  ///< in the order of the file; of `both` in a's
};

/// All comparisons besides that of the display window, and everything left out.
struct OtherLayers {
  std::vector<LayerComparison> compared;
  NotCompared not_compared;
  /// With all layers. What `b` has alone is missing from `a`, and fails; but for an alpha of 1, which is none.
  std::optional<CommonLayers> common = {};
};

/// Throws Error(kInput) if no layer is in both; otherwise errors as layer_names.
CommonLayers common_layers(const std::filesystem::path& a, const std::filesystem::path& b);

/// Compares `a` and `b` besides the display window of `picture`: all data outside it, its alpha, and with all
/// layers those. Alpha is judged at the exposure 0 on a plain display. Where noise is known, nothing is compared: it is
/// that of the picture. One pair is in memory at a time. Errors as read_picture and compare.
OtherLayers compare_others(const std::filesystem::path& a, const std::filesystem::path& b,
                           const PicturePair& picture, const LayerOptions& layers,
                           const ComparisonOptions& options);

/// The worst verdict of the picture and the others.
Verdict worst_verdict(Verdict picture, const OtherLayers& others);

/// How both files were read.
records::PicturesRead pictures_record(const PictureSource& a, const PictureSource& b);

/// Adds the other layers to a record of comparison_record(), with the worst verdict of all.
void add_layers(records::Comparison& record, Verdict worst, const OtherLayers& others);

}  // namespace lobelia
