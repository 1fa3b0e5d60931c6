// The interface of the image module to its users: core/image_io.cpp and core/picture_reader.cpp.
#pragma once

#include <functional>

#include "core/image_io.hpp"

namespace lobelia {

/// What a picture's header claims, before memory is allocated for it.
struct PictureClaim {
  std::uint64_t pixels = 0;     ///< of the data window and the display window together
  std::uint64_t raw_bytes = 0;  ///< of all channels, uncompressed
};

/// A picture's file in memory.
struct PictureBytes {
  std::filesystem::path path;  ///< for messages
  std::string_view bytes;
  /// The plug-in of OpenImageIO to use, as picture_format(); "": any, which opens the file `reopen` by itself.
  std::string_view format;
  std::filesystem::path reopen = {};
  bool base_only = false;                                   ///< leaves out a gain map
  std::function<void(const PictureClaim&)> on_header = {};  ///< may throw
};

struct ImageIoTable {
  Picture (*read_picture)(const PictureBytes&, const std::string& layer);
  std::vector<std::string> (*layer_names)(const PictureBytes&);
  std::vector<std::uint8_t> (*encode_png)(const DisplayImage&, const ImageMetadata&);
  ColourTable (*colour_table)(std::string_view);
  void (*decode_on_calling_threads)();
  void (*load_formats)();  ///< now instead of at the first picture
};

inline constexpr char kReaderFile[] = "lobelia_picture_reader";
inline constexpr char kImageIoModuleFile[] = "lobelia_image_io.so";
inline constexpr char kImageIoTableSymbol[] = "lobelia_image_io_table";

/// Loads the module at the first call. Throws Error(kInternal) if it is not there.
const ImageIoTable& image_io_table();

/// The path of a file that is installed with the program: beside it in a build tree, else in ../lib/lobelia; for the
/// shared library beside that, or in lobelia/ or ../lobelia. Throws Error(kInternal) if it is in none.
std::filesystem::path companion_file(const char* name);
/// Empty if it is in none.
std::filesystem::path find_companion(std::string_view name);

}  // namespace lobelia
