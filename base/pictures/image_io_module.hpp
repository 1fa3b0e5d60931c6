// The interface of the image module to its users: base/pictures/image_io.cpp and base/pictures/picture_reader.cpp.
#pragma once

#include <functional>
#include <vector>

#include "base/pictures/image_io.hpp"
#include "base/system/module.hpp"

namespace lobelia {

/// The size that a picture's header claims, before memory is allocated for it.
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
  bool on_one_thread = false;                               ///< the calling one
  bool as_stored = false;                                   ///< see read_stored_picture()
  std::function<void(const PictureClaim&)> on_header = {};  ///< may throw
  /// If set, a picture that can be decoded in bands of rows goes there instead, from the top: the band as a picture with the
  /// source of all, and its first row.
  std::function<void(const Picture& band, int y)> on_rows = {};
};

struct ImageIoTable {
  Picture (*read_picture)(const PictureBytes&, const std::string& layer);
  std::vector<std::string> (*layer_names)(const PictureBytes&);
  ColourTable (*colour_table)(std::string_view);
  void (*decode_on_calling_threads)();
  void (*load_formats)();  ///< now instead of at the first picture
};

inline constexpr char kReaderFile[] = "lobelia_picture_reader";
extern Module image_io_module;
inline constexpr char kImageIoTableSymbol[] = "lobelia_image_io_table";

/// Loads the module at the first call. Throws Error(kInternal) if it is not there.
const ImageIoTable& image_io_table();

}  // namespace lobelia
