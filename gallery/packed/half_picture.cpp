#include "gallery/packed/half_picture.hpp"

#define IMATH_HALF_NO_LOOKUP_TABLE  // which would need its library
#include <Imath/half.h>

#include <algorithm>
#include <cmath>

#include "base/pictures/image_values.hpp"
#include "gallery/packed/packing.hpp"

namespace lobelia::gallery {
namespace {

constexpr int kHalfMantissa = 10;
/// The largest value is scaled to just below 2^15, well within a half float.
constexpr int kTopExponent = 15;

/// Rounded without the last `dropped` bits, as an integer that is ordered as the values are.
int ordered(std::uint16_t half, int dropped) {
  const int magnitude = half & 0x7fff;
  const int kept = (magnitude >= 0x7c00 ? magnitude : magnitude + (1 << dropped >> 1)) >> dropped;
  return half & 0x8000 ? -kept : kept;
}

/// The values minus their prediction: for each channel the low bytes, then the high ones. Green is stored as its
/// difference from red, and blue from green, so that grey costs one channel.
/// Without prediction they are the values themselves, which is shorter for noise.
std::string residuals(std::span<const std::uint16_t> halves, int width, int height, int dropped,
                      bool is_predicted) {
  const std::size_t pixels = std::size_t(width) * height;
  std::string bytes(6 * pixels, '\0');
  std::vector<int> plane(pixels);
  for (int channel = 0; channel < 3; ++channel) {
    for (std::size_t i = 0; i < pixels; ++i) {
      const int value = ordered(halves[3 * i + channel], dropped);
      const int before = channel == 0 ? 0 : ordered(halves[3 * i + channel - 1], dropped);
      plane[i] = static_cast<std::int16_t>(value - before);  // modulo 2^16, as in the reader
    }
    char* low = bytes.data() + 2 * pixels * channel;
    for (std::size_t i = 0; i < pixels; ++i) {
      const bool first_column = i % width == 0, first_row = i < std::size_t(width);
      const int left = first_column ? (first_row ? 0 : plane[i - width]) : plane[i - 1];
      const int above = first_row ? left : plane[i - width];
      const int above_left = first_column || first_row ? left : plane[i - width - 1];
      const int rest = static_cast<std::int16_t>(
          plane[i] - (is_predicted ? predicted(left, above, above_left) : 0));
      // The sign goes to the last bit: 0, -1, 1, -2, 2 become 0, 1, 2, 3, 4.
      const auto code =
          static_cast<std::uint32_t>(rest) << 1 ^ static_cast<std::uint32_t>(rest >> 31);
      low[i] = static_cast<char>(code & 0xff);
      low[pixels + i] = static_cast<char>(code >> 8 & 0xff);
    }
  }
  return bytes;
}

}  // namespace

records::PackedPicture half_picture(const Image& image, int precision) {
  records::PackedPicture result;
  result.width = image.width();
  result.height = image.height();
  result.mantissa_bits = std::max(1, precision);
  const float largest = float(largest_magnitude(image.values()));
  int exponent = 0;
  std::frexp(largest, &exponent);  // largest < 2^exponent
  if (largest > 0) result.scale_log2 = kTopExponent - exponent;
  if (precision < 1) result.least = std::ldexp(double{largest}, -14 - 2 * precision);
  std::vector<std::uint16_t> halves;
  halves.reserve(image.values().size());
  for (const float value : image.values()) {
    const bool is_small = std::abs(value) < result.least;
    halves.push_back(Imath::half(is_small ? 0.0f : std::ldexp(value, result.scale_log2)).bits());
  }
  const auto packed = [&](bool is_predicted) {
    constexpr int kQuick = 6;
    return packed_bytes(residuals(halves, image.width(), image.height(),
                                  kHalfMantissa - result.mantissa_bits, is_predicted),
                        kQuick);
  };
  std::string with_prediction = packed(true), plain = packed(false);
  result.predicted = with_prediction.size() <= plain.size();
  result.planes = std::move(result.predicted ? with_prediction : plain);
  return result;
}

}  // namespace lobelia::gallery
