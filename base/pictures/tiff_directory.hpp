// The directories of a TIFF, which Exif uses too.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lobelia {

/// A list of entries, each with a tag and values (TIFF 6.0, page 14, and BigTIFF). The bytes must outlive it.
class TiffDirectory {
 public:
  /// The file's first; nothing if the bytes are no TIFF or the directory is not complete.
  static std::optional<TiffDirectory> first(std::string_view file);
  /// The one after it, likewise. A damaged file's last directory may lead back to its first.
  std::optional<TiffDirectory> next() const;

  bool has(std::uint64_t tag) const { return place_of(tag).has_value(); }
  /// The only value of an entry of whole numbers of up to four bytes; nothing for any other.
  std::optional<std::uint64_t> number(std::uint64_t tag) const;

 private:
  TiffDirectory(std::string_view file, bool little, bool big)
      : file_(file), little_(little), big_(big) {}
  std::optional<TiffDirectory> at(std::uint64_t place) const;
  std::optional<std::uint64_t> place_of(std::uint64_t tag) const;
  std::size_t offset_size() const { return big_ ? 8 : 4; }
  std::size_t entry_size() const { return big_ ? 20 : 12; }

  std::string_view file_;
  bool little_, big_;
  std::uint64_t entries_ = 0, count_ = 0;  ///< where the entries begin, and how many there are
};

/// A damaged file leads from page to page for ever.
inline constexpr int kMaxTiffPages = 1024;

}  // namespace lobelia
