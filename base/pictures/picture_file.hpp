// A picture's file: opened, and checked by its own bytes where a library must not be asked.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/system/descriptor.hpp"
#include "base/system/files.hpp"
#include "base/system/sha256.hpp"

namespace lobelia {

/// The integer of `size` bytes at `at`; bytes beyond the end count as 0.
std::uint64_t number_at(std::string_view bytes, std::size_t at, bool little, std::size_t size = 4);

/// The formats that are read without --any-format, for messages.
inline constexpr std::string_view kPictureFormats =
    "OpenEXR, PNG, JPEG, TIFF, Radiance HDR, PFM, PNM, TGA, BMP, DPX and WebP";

/// Bytes of a file's end that picture_format() looks at.
inline constexpr std::size_t kFooterBytes = 26;

/// OpenImageIO's name ("openexr") of a file's format, by its first bytes; "" if it is none of kPictureFormats. A TGA
/// does not begin with a mark: it has the footer of TGA 2.0 or the ending ".tga", and a valid header.
std::string_view picture_format(std::string_view head, std::string_view footer,
                                std::string_view ending);

/// Whether an attribute of an EXR is longer than the file. OpenEXR would allocate memory for it, 2 GiB and more, before
/// it reads.
bool is_exr_that_claims_too_much(std::string_view bytes);

/// Whether an EXR has a channel with fewer values than pixels.
bool has_subsampled_channels(std::string_view bytes);

/// Whether a JPEG lacks the marker that ends its last scan, or a DPX is shorter than its header says: there the libraries
/// fill in what is missing and report nothing. `format` is OpenImageIO's name; false for any other format.
bool is_cut_off(std::string_view bytes, std::string_view format);

/// Whether a HEIF or AVIF says that its values are PQ or HLG. OpenImageIO 2.4 decodes it to 8 bits and does not say so.
bool is_heif_of_hdr(std::string_view bytes);

/// Whether a JPEG names a gain map ("Ultra HDR"): a second picture that says how much brighter each pixel is on a better
/// display.
bool has_gain_map(std::string_view jpeg);

/// Whether a page of a TIFF has no BitsPerSample. It is 1 by default (TIFF 6.0, page 29), but OpenImageIO 2.4 assumes 8
/// and leaves the rest of each row uninitialised.
bool is_tiff_without_bits(std::string_view bytes);

/// The data of a JPEG's segments before its pixels, by the text that they begin with, which is cut off.
std::vector<std::string_view> jpeg_segments(std::string_view jpeg, std::string_view beginning);

/// The colours that a PNG's chunks state (PNG, third edition, 11.3.2). Ignored are chunks with a wrong checksum
/// or length, a second chunk of a type, and chunks after the first pixels.
struct PngColour {
  /// ITU-T H.273 code points
  struct CodePoints {
    int primaries = 2, transfer = 2, matrix = 0;
    bool full_range = true;
  };
  std::optional<CodePoints> cicp;
  bool has_icc_profile = false;
  bool is_srgb = false;
  /// light = value^gamma: the inverse of the number in gAMA, 0 if that is 0.
  std::optional<double> gamma;
  std::optional<std::array<double, 8>> chromaticities;  ///< x, y of red, green, blue, white
};
PngColour png_colour(std::string_view bytes);

/// Larger files are refused. With --any-format files are copied into memory.
inline constexpr std::uint64_t kMaxPictureBytes = kMostHashedBytes;
inline constexpr std::uint64_t kMaxAnyFormatBytes = std::uint64_t{1} << 30;

class PictureFile {
 public:
  /// Throws Error(kInput): missing, not a regular file, empty, over kMaxPictureBytes.
  explicit PictureFile(const std::filesystem::path& path);
  explicit PictureFile(InputFile file);
  /// Throws as PictureFile(file).known_format(), and leaves the file open.
  static void require_picture(const InputFile& file);

  const std::filesystem::path& path() const { return path_; }
  int descriptor() const { return file_.get(); }
  std::uint64_t size() const { return size_; }
  /// As picture_format(). Throws Error(kInput), naming the formats that are read, if it is none of them.
  std::string_view known_format() const;
  /// The whole file. Throws Error(kInput) if it became shorter, and Error(kInterrupted) as read_in_pieces().
  std::string read_all() const;
  /// A copy in memory, outside of every file system. Throws Error(kInput) if the file is over `max_bytes`.
  Descriptor copy_in_memory(std::uint64_t max_bytes) const;

 private:
  PictureFile(const std::filesystem::path& path, Descriptor file);
  std::string read(std::uint64_t offset, std::size_t size) const;
  std::filesystem::path path_;
  Descriptor file_;
  std::uint64_t size_ = 0;
};

/// Throws Error(kInput): "PATH: not a readable picture: WHY".
[[noreturn]] void unreadable_picture(const std::filesystem::path& path, std::string_view why);

}  // namespace lobelia
