// Two pictures' files, layer by layer.
#pragma once

#include <filesystem>

#include "compare/compare.hpp"

namespace lobelia {

struct PicturePair {
  Picture a, b;
};
struct PicturePairSource {
  PictureSource a, b;
};

/// The names of one layer in two files; "" for the picture itself.
struct LayerNames {
  std::string a, b;
};

/// "NAME" for both files, or "NAME=NAME" where the two call it differently. Throws Error(kUsage) for one empty name of two.
LayerNames parse_layer_names(const std::string& text);

/// Reads one layer of both files. Errors as read_picture().
PicturePair read_pair(const std::filesystem::path& a, const std::filesystem::path& b,
                      const LayerNames& layer);

/// Cuts both pictures to `options.crop`. Sets the pixels of `options.ignored` in `a` to those of `b`, or in both to 0
/// where `b` is not finite. Throws Error(kInput) if the sizes differ, or do not hold the part.
void take_part(PicturePair& pair, const std::string& file_a, const std::string& file_b,
               const ComparisonOptions& options);
/// The same, where `b` is cut already.
void take_part(Image& a, Image& b, const ComparisonOptions& options);

/// True if requested, or if the layer is_depth_like() and no noise is known.
bool allows_equal_nonfinite(const ComparisonOptions& options, const PictureSource& source);

/// The largest rounding error of a stored integer as bright as `value`, in radiance; 0 for floats.
double rounding_of(const PictureSource& source, double value);

/// compare() for pictures read from files, which messages name, by the type of their layer (compare/layer_types.hpp).
/// Identifiers are read again, as the files store them; of a Cryptomatte all ranks are. Values that are background in
/// depth, and where allows_equal_nonfinite() those that are not finite in both, become 0 in `pair`. Throws Error(kInput)
/// if the sizes differ, and the errors of read_picture() and compare().
Comparison compare_pictures(PicturePair& pair, const std::string& file_a, const std::string& file_b,
                            const ComparisonOptions& options);

struct LayerOptions {
  LayerNames layer;
  bool all = false;           ///< also all other layers that both have
  bool ignore_alpha = false;  ///< the picture's alpha
};

/// Compares a layer, or the part of it outside its display window.
struct LayerComparison {
  std::string name;
  PictureSource a, b;
  /// Empty if the layers are identical, or `problem` says why they cannot be compared.
  std::optional<Comparison> comparison = {};
  std::string problem = {};  ///< counts as a difference: the sizes differ, or an alpha is lost
  bool identical = false;    ///< and finite; not measured
  /// If set, all data on this window are compared. (0, 0) is the display window's first pixel.
  std::optional<PixelWindow> overscan = {};
  LayerType type = LayerType::kColour;

  Verdict verdict() const;
  std::string title() const;  ///< "layer Z (depth)", "overscan of the picture"
};

/// The layers of two files. The pictures themselves ("") count as a layer.
struct CommonLayers {
  std::vector<std::string> both, only_a, only_b;  ///< in the order of the file; `both` in a's
};

using NotCompared = records::NotCompared;
bool is_empty(const NotCompared& not_compared);
/// "layers 'N', 'Z'; 3 MIP levels"; "nothing" if it is empty. Names at most 40 layers.
std::string to_text(const NotCompared& not_compared);

/// All comparisons besides that of the display window, and everything that was not compared.
struct OtherLayers {
  std::vector<LayerComparison> compared;
  NotCompared not_compared;
  /// If all layers were requested. A layer that only `b` has is missing from `a`, and fails. An alpha is listed only if its
  /// colours were not compared.
  std::optional<CommonLayers> common = {};
};

/// Compares the alpha of two pictures, which messages name, at exposure 0 on a plain display. Throws as compare_pictures().
LayerComparison compare_alpha(const std::string& name, PicturePair pair, const std::string& file_a,
                              const std::string& file_b, const ComparisonOptions& options);

/// Throws Error(kInput) if the files share no layer; otherwise errors as layer_names().
CommonLayers common_layers(const std::filesystem::path& a, const std::filesystem::path& b);

/// Compares everything but the display window of `picture`: all data outside it, its alpha, and if requested all other
/// layers. The layers of a Cryptomatte are one. An alpha that one side alone has differs unless it is 1
/// everywhere, which equals none. If noise is known nothing else is compared, for it is the noise of the picture only. Only
/// one pair is in memory at a time. Throws Error(kInput) for a type of a layer that neither file has; other errors as
/// read_picture() and compare().
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
