// Reads the pictures that most programs write without OpenImageIO, whose libraries cost 0.3 s (docs/decisions/0008).
//
// Plain is an EXR of one part, by rows, of the channels R, G, B and A or Y and A, packed without a loss, whose data window
// is its display window; and a PNG of 8 or 16 bits without a palette, a transparent colour, a position or an ICC profile.
// OpenImageIO reads all other files, and damaged ones. For a plain file both give the same values, bit for bit.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/pictures/image_io_module.hpp"
#include "base/pictures/picture_light.hpp"

namespace lobelia {

/// A plain picture's file, opened.
class PlainFile {
 public:
  virtual ~PlainFile() = default;

  PicturePart part;
  PixelWindow window;
  std::string value_type;  ///< of all channels, as PictureSource has it
  std::size_t value_bytes = 0;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< that may_state_samples()
  bool is_unassociated = false;  ///< colours are not multiplied by alpha, the last channel
  int band_rows = 0;             ///< that may be decoded alone; 0: all rows together

  /// The curve and primaries of colour layers. Throws Error(kInput) for those that are not read.
  virtual ColourMeaning meaning(const std::filesystem::path& path) const = 0;
  /// Rows from y on of one channel, repeated, or of three. Returns false if the file is damaged.
  virtual bool read(int y, const std::vector<std::size_t>& channels, Image& rows) = 0;
};

/// Nothing if it is not plain.
std::unique_ptr<PlainFile> open_plain_exr(const PictureBytes& file);

/// As ImageIoTable::read_picture(); nothing if OpenImageIO has to read it.
std::optional<Picture> read_plain_picture(const PictureBytes& file, const std::string& layer);
/// As ImageIoTable::layer_names().
std::optional<std::vector<std::string>> plain_layer_names(const PictureBytes& file);

/// Whether a file of this format, as picture_format(), may be plain.
bool may_be_plain(std::string_view format);

}  // namespace lobelia
