// Pixels of two pictures outside their display windows.
#pragma once

#include "compare/layer_type.hpp"
#include "compare/layers.hpp"

namespace lobelia {

/// For two pictures of one size.
struct Overscan {
  /// The smallest that holds the display window and all data of both; (0, 0) is the first pixel of the display window.
  PixelWindow window;
  std::int64_t pixels = 0;  ///< outside the display window, with data of at least one picture
};

/// Empty if all data of both lie in the display window.
std::optional<Overscan> find_overscan(const PictureSource& a, const PictureSource& b);

/// The picture and its overscan, on such a window; 0 where it has no data.
Image all_data(const Picture& picture, const PixelWindow& window);

/// Compares all data on the window. Masks have nothing outside the display window.
LayerComparison compare_overscan(const std::string& layer, const PicturePair& pair,
                                 const Overscan& overscan, const ComparisonOptions& options);

/// The same of all ranks of a Cryptomatte; `pair` has how one of them was read. Where there are no data, there is no object.
LayerComparison compare_cryptomatte_overscan(const CryptomatteRank& rank,
                                             const std::filesystem::path& file_a,
                                             const std::filesystem::path& file_b,
                                             const PicturePairSource& pair,
                                             const Overscan& overscan,
                                             const ComparisonOptions& options);

}  // namespace lobelia
