// A picture in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/words/vec.hpp"

namespace lobelia {

/// The largest picture that is read, rendered or compared: pixels per side, and in all (1.5 GiB of float RGB).
inline constexpr int kMaxImageSide = 32768;
inline constexpr std::int64_t kMaxImagePixels = std::int64_t{1} << 27;

/// Zero because the system gives it so. From 64 KiB on its pages come at once; from 4 MiB on they are large where the system
/// has such, and the first to write one is the thread that renders it. Throws std::bad_alloc.
///
/// A first write costs 2 to 13 us in a virtual machine, and a picture of 12 MB has 3000 usual pages, but six large ones:
/// usual pages would take three times as long as rendering the picture, or longer.
void* allocate_zeroed(std::size_t bytes);
void free_zeroed(void* memory, std::size_t bytes);

/// An allocator of such memory, for containers that are made with their final size.
template <class T>
struct ZeroedMemory {
  using value_type = T;
  ZeroedMemory() = default;
  template <class U>
  ZeroedMemory(const ZeroedMemory<U>&) {}
  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_alloc();
    return static_cast<T*>(allocate_zeroed(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t count) { free_zeroed(memory, count * sizeof(T)); }
  void construct(T*) {}  // it is zero
  template <class... Arguments>
  void construct(T* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) T(std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(ZeroedMemory, ZeroedMemory) { return true; }
};

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

/// Display-encoded 8-bit RGB (sRGB), in the layout of Image.
struct DisplayImage {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Attributes stored in a picture file, in the order written.
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

}  // namespace lobelia
