// Pixels of two pictures outside their display windows.
#pragma once

#include <cstdint>
#include <optional>

#include "compare/compare.hpp"
#include "core/picture.hpp"

namespace lobelia {

/// For two pictures of one size.
struct Overscan {
  /// The least that holds the display window and all data of both; (0, 0) is the first pixel of the display window.
  PixelWindow window;
  std::int64_t pixels = 0;  ///< outside of the display window, with data of one of them at least
};

/// Nothing if all data of both lie in the display window.
std::optional<Overscan> find_overscan(const PictureSource& a, const PictureSource& b);

/// Both on one window.
struct OverscanPictures {
  Image a, b;
  std::int64_t only_a = 0, only_b = 0;  ///< pixels that are not 0 where the other has no data
  bool identical = true;                ///< and finite, outside of the display window
};
OverscanPictures on_window(const Picture& a, const Picture& b, const PixelWindow& window);

/// The options for pictures on that window: masks have nothing outside of the display window.
ComparisonOptions on_window(ComparisonOptions options, const PixelWindow& display,
                            const PixelWindow& window);

}  // namespace lobelia
