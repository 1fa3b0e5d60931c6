// What the image module offers to its loader; nobody else includes this.
#pragma once

#include "core/image_io.hpp"

namespace lobelia {

/// The functions of image_io.hpp, found by name in the module.
struct ImageIoTable {
  Picture (*read_picture)(const std::filesystem::path&, const std::string&);
  std::vector<std::string> (*layer_names)(const std::filesystem::path&);
  std::vector<std::uint8_t> (*encode_png)(const DisplayImage&, const ImageMetadata&);
  ColourTable (*colour_table)(std::string_view);
  void (*decode_on_calling_threads)();
};

inline constexpr char kImageIoModuleFile[] = "lobelia_image_io.so";
inline constexpr char kImageIoTableSymbol[] = "lobelia_image_io_table";

}  // namespace lobelia
