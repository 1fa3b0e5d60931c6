// The interface of the colour module to base/pictures/colour.cpp.
#pragma once

#include <span>

#include "base/pictures/colour.hpp"

namespace lobelia {

struct ColourModule {
  /// Rows have 3 * width floats.
  DisplayImage (*to_display)(std::span<const float> rows, int width, double exposure_stops);
  /// `by_environment`: the configuration's name comes from $OCIO.
  std::shared_ptr<const DisplayView> (*open_view)(const DisplayViewChoice& choice,
                                                  bool by_environment);
};

inline constexpr char kColourModuleSymbol[] = "lobelia_colour_module";

}  // namespace lobelia
