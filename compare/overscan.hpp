// Pixels of two pictures outside their display windows.
#pragma once

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

/// Compares all data on the window. Masks have nothing outside the display window.
LayerComparison compare_overscan(const std::string& layer, const PicturePair& pair,
                                 const Overscan& overscan, const ComparisonOptions& options);

}  // namespace lobelia
