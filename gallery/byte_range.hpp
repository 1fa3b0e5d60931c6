// The part of a file that an HTTP request asks for: RFC 9110, section 14.
#pragma once

#include <cstdint>
#include <string_view>

namespace lobelia::gallery {

struct ByteRange {
  enum class Kind {
    kWhole,         ///< no range, several, or one in another form: the whole file
    kPart,          ///< `size` bytes from `first`; at least one
    kUnsatisfiable  ///< beyond the file's end
  };
  Kind kind = Kind::kWhole;
  std::uint64_t first = 0, size = 0;
};

/// Reads the field `range` ("bytes=0-99", "bytes=100-", "bytes=-100") for a file of `file_size` bytes.
ByteRange byte_range(std::string_view range, std::uint64_t file_size);

}  // namespace lobelia::gallery
