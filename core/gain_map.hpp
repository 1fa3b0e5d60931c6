// Gain maps of JPEGs ("Ultra HDR"): a second picture in the file says how much brighter each pixel is on a better display.
//
// Source:  Adobe, "Gain Map Specification" 1.0 (the XMP namespace hdrgm); ISO 21496-1:2025 (its binary form); CIPA DC-007
//          (MPF, which lists the pictures of a file).
// Formula: hdr = (base + offset_base) * 2^boost - offset_hdr, with boost = min + (max - min) * value^(1 / gamma), for each
//          channel of linear light in the base picture's primaries; 1 is diffuse white in both. The weight by the headroom of
//          a display is 1: the brightest picture that the file holds.
// Choices: between the map's pixels the value is interpolated (bilinear, by pixels' centres; even at the edges).
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>

#include "core/picture_colour.hpp"

namespace lobelia {

struct GainMap {
  std::array<double, 3> min{}, max{};  ///< log2 of the gain
  std::array<double, 3> gamma{1, 1, 1}, offset_base{}, offset_hdr{};
  bool base_is_hdr = false;  ///< the map leads to the SDR picture, and is not applied
  std::string_view jpeg;     ///< the map's own file, within the picture's
};

/// The gain map of a JPEG; nothing if it has none. Throws Error(kInput), naming `path`, if the picture says that it has one
/// and it is not there, or is impossible: gains over 2^32, a gamma that is not from 0.01 to 100, offsets over 16.
std::optional<GainMap> find_gain_map(const std::filesystem::path& path, std::string_view jpeg);

/// Makes the base picture's light that of the HDR picture, in place. `map` has the values of the map, from 0 to 1, grey
/// repeated, in its own size. `to_rec709` leads from the base picture's primaries to those of `light`.
void apply_gain(const GainMap& gain, const Image& map, const RgbMatrix& to_rec709, Image& light);

}  // namespace lobelia
