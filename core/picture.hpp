// A picture as its file has it: values, and how they were read.
#pragma once

#include <string>
#include <vector>

#include "core/image.hpp"

namespace lobelia {

/// Pixels x to x + width - 1, y to y + height - 1; y down.
struct PixelWindow {
  int x = 0, y = 0, width = 0, height = 0;
  bool operator==(const PixelWindow&) const = default;
};

struct PictureSource {
  std::string format;                 ///< "openexr", "png": OpenImageIO's name
  std::string layer;                  ///< "" for the picture itself
  std::vector<std::string> channels;  ///< in the file: three, a vector's two, or one for grey
  std::string value_type;             ///< as stored: "half", "float", "uint8", "uint16", "uint"
  std::string transfer;               ///< of transfer_curve.hpp: "linear", "sRGB", "gamma 1.8"
  bool multiplied_by_alpha = false;   ///< after the transfer curve; the file's colours were not
  /// x, y of red, green, blue and white that the colours were converted from; empty for Rec. 709
  std::vector<double> chromaticities;
  std::string icc_profile;          ///< its description where there is one; it is not applied
  bool icc_is_srgb = false;         ///< it says what is assumed anyway
  PixelWindow data, display;        ///< where the file has values, and the picture
  std::string alpha;                ///< the layer that is the alpha of this one; empty without
  std::vector<std::string> layers;  ///< all that the file has, as layer_names()
  int mip_levels = 1;               ///< of which the first was read
};

struct Picture {
  Image image;     ///< of the display window
  Image overscan;  ///< of the data window, where that leaves the display window; else empty
  PictureSource source;
};

}  // namespace lobelia
