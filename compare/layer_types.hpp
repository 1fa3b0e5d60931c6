// How layers that are no colours are compared: each type has metrics and default limits of its own.
#pragma once

#include <map>
#include <utility>

#include "compare/compare.hpp"

namespace lobelia {

/// The least depth of a pixel without a surface: Blender writes it, and half floats make it infinite.
inline constexpr float kBackgroundDepth = 1e10f;

/// "NAME=TYPE". Throws Error(kUsage) for another form or type, with the types that there are.
LayerTypeChoice parse_layer_type(const std::string& text);

/// As the last choice says that means the layer of either file (is_layer_called()). Otherwise that of the reference by
/// layer_type(), or kIdentifier where `a` has identifiers. Where noise is known it is kColour: errors are those of numbers.
LayerType type_of_layers(const PictureSource& a, const PictureSource& b,
                         const ComparisonOptions& options);

/// Whether a limit on that figure judges layers of the type. `has_coverage`: the layer is a Cryptomatte.
bool can_judge(LayerType type, std::string_view metric, bool has_coverage);

/// The options by which layers of the type are judged. Only limits on what is measured of the type are left of the given
/// ones. Default limits of the type are added, each unless there is one on its metric; without default limits only if no
/// other is left, so that no layer passes unjudged. Not colours but alpha are at the exposure 0 on a plain display.
ComparisonOptions options_of_type(LayerType type, const ComparisonOptions& options,
                                  bool has_coverage = false);

/// Compares the values of two layers of the type, of one size. Identifiers must be as they are stored. Changes what is
/// background in depth, and values that are not finite in both where that is allowed, to 0. Errors as compare().
Comparison compare_values(Image& a, Image& b, const PictureSource& source_a,
                          const PictureSource& source_b, LayerType type,
                          const ComparisonOptions& options);

/// Which identifier is most often where the reference has another one.
class ExchangedIdentifiers {
 public:
  /// Adds the identifiers of one pixel.
  void add(std::uint64_t in_a, std::uint64_t in_b);
  /// The most frequent pair; nothing if there is none.
  struct Most {
    std::uint64_t in_a = 0, in_b = 0;
    std::int64_t pixels = 0;
  };
  std::optional<Most> most() const;

 private:
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::int64_t> pixels_;
};

/// "a has 5 where b has 7, in 12 pixels".
std::string exchange_text(const std::string& in_a, const std::string& in_b, std::int64_t pixels);

}  // namespace lobelia
