// Whether a file of a picture was cut off, where the libraries fill what is missing and say nothing.
#pragma once

#include <filesystem>
#include <string_view>

namespace lobelia {

/// True of a JPEG without the marker that ends its last scan, and of a DPX or IFF that is shorter than its
/// header says; `format` is OpenImageIO's name, of another it is false. Throws Error(kInput) if it cannot be read.
bool is_cut_off(const std::filesystem::path& path, std::string_view format);

}  // namespace lobelia
