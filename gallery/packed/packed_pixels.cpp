#include "gallery/packed/packed_pixels.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "gallery/packed/packing.hpp"

namespace lobelia::gallery {
namespace {

/// Green, red minus green, blue minus green.
using Planes = std::array<std::vector<std::int8_t>, 3>;

/// All arithmetic is modulo 256, as in the reader.
std::int8_t signed_byte(int value) {
  return static_cast<std::int8_t>(static_cast<std::uint8_t>(value));
}

Planes planes_of(const DisplayImage& image, const DisplayImage* first) {
  const std::size_t pixels = image.rgb.size() / 3;
  Planes planes;
  for (auto& plane : planes) plane.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto value = [&](int c) {
      return int(image.rgb[3 * i + c]) - (first ? int(first->rgb[3 * i + c]) : 0);
    };
    const int green = value(1);
    // From -128 on, so that a slope from black to white is one for the prediction, too.
    planes[0][i] = signed_byte(first ? green : green - 128);
    planes[1][i] = signed_byte(value(0) - green);
    planes[2][i] = signed_byte(value(2) - green);
  }
  return planes;
}

/// The sign goes to the last bit: 0, -1, 1, -2, 2 become 0, 1, 2, 3, 4.
char coded(std::int8_t rest) { return static_cast<char>(rest < 0 ? -2 * rest - 1 : 2 * rest); }

std::string residuals(const std::vector<std::int8_t>& plane, std::size_t width) {
  std::string bytes(plane.size(), '\0');
  for (std::size_t i = 0; i < plane.size(); ++i) {
    const bool first_column = i % width == 0, first_row = i < width;
    const int left = first_column ? (first_row ? 0 : plane[i - width]) : plane[i - 1];
    const int above = first_row ? left : plane[i - width];
    const int corner = first_column || first_row ? left : plane[i - width - 1];
    bytes[i] = coded(signed_byte(plane[i] - predicted(left, above, corner)));
  }
  return bytes;
}

std::string as_they_are(const std::vector<std::int8_t>& plane) {
  std::string bytes(plane.size(), '\0');
  std::ranges::transform(plane, bytes.begin(), coded);
  return bytes;
}

struct Coded {
  int way = 0;
  std::array<std::string, 3> planes;
  std::size_t size = 0;  ///< how much there is to say
};

Coded coded_picture(const DisplayImage& image, const DisplayImage* first, int way) {
  Coded result;
  result.way = way;
  const Planes planes = planes_of(image, way & kFromFirst ? first : nullptr);
  for (int p = 0; p < 3; ++p) {
    result.planes[p] = way & kFromNeighbours ? residuals(planes[p], std::size_t(image.width))
                                             : as_they_are(planes[p]);
    for (const char c : result.planes[p]) result.size += std::uint8_t(c);
  }
  return result;
}

Coded shortest(const DisplayImage& image, const DisplayImage* first) {
  Coded best = coded_picture(image, first, kFromNeighbours);
  if (!first) return best;
  for (const int way : {kFromFirst, kFromFirst | kFromNeighbours})
    if (Coded other = coded_picture(image, first, way); other.size < best.size)
      best = std::move(other);
  return best;
}

}  // namespace

PackedPixels packed_pixels(std::span<const DisplayImage> pictures) {
  PackedPixels result;
  std::array<std::string, 3> planes;
  for (const DisplayImage& image : pictures) {
    const DisplayImage& front = pictures.front();
    const bool is_like_first = &image != &front && !image.rgb.empty() &&
                               image.width == front.width && image.height == front.height;
    const Coded coded = shortest(image, is_like_first ? &front : nullptr);
    result.ways.push_back(coded.way);
    for (int p = 0; p < 3; ++p) planes[p] += coded.planes[p];
  }
  for (const std::string& plane : planes) result.bytes += plane;
  return result;
}

}  // namespace lobelia::gallery
