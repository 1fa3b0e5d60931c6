// The part of the image module that encodes PNG files.
#pragma once

#include <memory>

#include "core/image_io_module.hpp"

namespace lobelia {

/// ImageIoTable::start_png.
std::unique_ptr<PngEncoder> start_png(int width, int height, const ImageMetadata& metadata);

}  // namespace lobelia
