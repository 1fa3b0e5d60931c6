// What a file's own bytes say where a library is not to be asked.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace lobelia {

/// The formats that are read unless others are asked for, as a sentence names them.
inline constexpr std::string_view kPictureFormats =
    "OpenEXR, PNG, JPEG, TIFF, Radiance HDR, PFM, PNM, TGA, BMP, DPX and WebP";

/// How much of a file's end picture_format() wants.
inline constexpr std::size_t kFooterBytes = 26;

/// OpenImageIO's name ("openexr") of the format that a file begins with, "" if it is none of kPictureFormats. A TGA
/// has no such mark: it has the footer of its second version, or the ending .tga and a header without a fault.
std::string_view picture_format(std::string_view head, std::string_view footer,
                                std::string_view ending);

/// Whether it is an EXR with an attribute that is longer than the file: OpenEXR would take memory for it, 2 GiB
/// and more, before it looks.
bool is_exr_that_claims_too_much(std::string_view bytes);

/// Whether the file was cut off, where the libraries fill what is missing and say nothing:
/// true of a JPEG without the marker that ends its last scan, and of a DPX that is shorter than its
/// header says; `format` is OpenImageIO's name, of another it is false.
bool is_cut_off(std::string_view bytes, std::string_view format);

/// Whether it is a TIFF with a page that has no BitsPerSample. That means 1 (TIFF 6.0, page 29), but OpenImageIO 2.4
/// takes it for 8 and fills the rest of each row with what its memory held.
bool is_tiff_without_bits(std::string_view bytes);

/// The colours that the chunks of a PNG state (PNG, third edition, 11.3.2). A chunk whose checksum or length is
/// wrong says nothing, nor does a second one, nor one after the pixels have begun.
struct PngColour {
  /// ITU-T H.273 code points
  struct CodePoints {
    int primaries = 2, transfer = 2, matrix = 0;
    bool full_range = true;
  };
  std::optional<CodePoints> cicp;
  bool has_icc_profile = false;
  bool is_srgb = false;
  std::optional<double>
      gamma;  ///< light = value^gamma: the inverse of what gAMA holds; 0 where that is 0
  std::optional<std::array<double, 8>> chromaticities;  ///< x, y of red, green, blue, white
};
PngColour png_colour(std::string_view bytes);

}  // namespace lobelia
