// What a file's own bytes say where a library is not to be asked.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace lobelia {

/// Whether it is an IFF file by its first bytes or its ending.
bool is_iff(const std::filesystem::path& path);

/// Whether it is an EXR with an attribute that is longer than the file: OpenEXR would take memory for it, 2 GiB
/// and more, before it looks.
bool is_exr_that_claims_too_much(const std::filesystem::path& path);

/// Whether the file was cut off, where the libraries fill what is missing and say nothing:
/// true of a JPEG without the marker that ends its last scan, and of a DPX that is shorter than its
/// header says; `format` is OpenImageIO's name, of another it is false. Throws Error(kInput) if it cannot be read.
bool is_cut_off(const std::filesystem::path& path, std::string_view format);

/// Whether it is a TIFF with a page that has no BitsPerSample. That means 1 (TIFF 6.0, page 29), but OpenImageIO 2.4
/// takes it for 8 and fills the rest of each row with what its memory held.
bool is_tiff_without_bits(const std::filesystem::path& path);

/// What the chunks of a PNG say of its colours (PNG, third edition, 11.3.2). A chunk whose checksum or length is
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
PngColour png_colour(const std::filesystem::path& path);

}  // namespace lobelia
