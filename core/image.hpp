// A picture in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/vec.hpp"
#include "core/zeroed_memory.hpp"

namespace lobelia {

/// Largest picture that is read, rendered or compared: per side, and in all (1.5 GiB of float RGB).
inline constexpr int kMaxImageSide = 32768;
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 27;

/// Scene-linear float32 RGB, Rec. 709 primaries. Row 0 is the top; interleaved; no padding.
class Image {
 public:
  Image() = default;
  Image(int width, int height)
      : width_(width), height_(height), values_(std::size_t{3} * width * height) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t pixel_count() const { return std::size_t(width_) * height_; }
  /// Three floats of pixel (x, y), x to the right, y down.
  std::span<float, 3> pixel(int x, int y) {
    return std::span<float, 3>(values_.data() + 3 * (std::size_t(y) * width_ + x), 3);
  }
  std::span<const float, 3> pixel(int x, int y) const {
    return std::span<const float, 3>(values_.data() + 3 * (std::size_t(y) * width_ + x), 3);
  }
  /// All values, 3 * width * height, in reading order.
  std::span<float> values() { return values_; }
  std::span<const float> values() const { return values_; }

 private:
  int width_ = 0, height_ = 0;
  std::vector<float, ZeroedMemory<float>> values_;
};

/// Display-encoded 8-bit RGB (sRGB), for people to look at. Same layout as Image.
struct DisplayImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Attributes stored in a picture file, in the order written.
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

}  // namespace lobelia
