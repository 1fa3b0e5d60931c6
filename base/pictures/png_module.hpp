// The interface of the PNG module, by libspng.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/pictures/plain_picture.hpp"
#include "base/system/module.hpp"

namespace lobelia {

/// Encodes a PNG a few rows at a time; each call returns the next bytes of its file.
class PngEncoder {
 public:
  virtual ~PngEncoder() = default;
  virtual std::vector<std::uint8_t> encode(const DisplayImage& rows) = 0;
  virtual std::vector<std::uint8_t> finish() = 0;
};

struct PngTable {
  std::unique_ptr<PlainFile> (*open_plain)(const PictureBytes&);  ///< nothing if it is not plain
  /// The codes of a plain PNG of 8 bits, sRGB and at most `most_side` pixels a side; nothing for any other file.
  std::optional<DisplayImage> (*read_codes)(std::string_view bytes, int most_side);
  std::unique_ptr<PngEncoder> (*start)(int width, int height, const ImageMetadata&);
};

inline constexpr char kPngTableSymbol[] = "lobelia_png_table";

/// Loads the module at the first call. Throws Error(kInternal) if it is not there.
const PngTable& png_table();

}  // namespace lobelia
