// EXRs with fewer values of some channels than pixels, which OpenImageIO does not read: luminance and chroma.
#pragma once

#include <string>
#include <vector>

#include "base/pictures/image_io_module.hpp"

namespace lobelia {

/// As ImageIoTable::read_picture(), for a file that has_subsampled_channels(). Y, RY and BY become red, green and blue by
/// OpenEXR's RgbaInputFile, which fills in chroma in half floats. Other layers need a value for each pixel.
Picture read_subsampled_exr(const PictureBytes& file, const std::string& layer);

/// As ImageIoTable::layer_names().
std::vector<std::string> subsampled_exr_layers(const PictureBytes& file);

}  // namespace lobelia
