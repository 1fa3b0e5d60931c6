// From what was decoded to a picture: what every reader of files does alike.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/pictures/picture.hpp"
#include "base/pictures/picture_colour.hpp"
#include "base/pictures/picture_file.hpp"
#include "base/pictures/picture_layers.hpp"

namespace lobelia {

/// How a file's colours become light with Rec. 709 primaries.
struct ColourMeaning {
  TransferCurve curve{TransferCurve::Kind::kLinear, 1, "linear"};
  std::optional<Chromaticities> primaries = {};  ///< nothing for Rec. 709
};

/// By the chunks of a PNG. Throws Error(kInput) for those that are not read.
ColourMeaning png_meaning(const std::filesystem::path& path, const PngColour& colour);

/// Red, green and blue of Y, RY and BY, in place: the inverse of OpenEXR's RGBAtoYCA (ImfRgbaYca.h). Throws Error(kInput)
/// for primaries of which green has no luminance.
void mix_luminance_chroma(const std::filesystem::path& path,
                          const std::optional<Chromaticities>& primaries, Image& image);

/// Makes the picture's colours light, and says how in its source. Throws Error(kInput) for impossible primaries.
void decode_colours(const std::filesystem::path& path, const ColourMeaning& meaning,
                    Picture& picture);

/// A source with its format, channels and layers filled in; the rest is the reader's.
PictureSource picture_source(std::string_view format, std::span<const PicturePart> parts,
                             const PictureLayer& layer);

/// Rows that are decoded at a time: about two million pixels, and a multiple of `block`.
int rows_of_band(int width, int block);

/// Whether samples_stated() looks at an attribute of that name.
bool may_state_samples(std::string_view name);

/// A pixel's samples, as pbrt and Cycles write them into their files, by an attribute's name and text; 0 if there is no
/// such number. `channel` is the first of the layer.
double samples_stated(std::span<const std::pair<std::string, std::string>> attributes,
                      const std::string& channel);

}  // namespace lobelia
