#include "gallery/plain_png.hpp"

#include <zlib.h>

#include <cstdlib>
#include <string>

namespace lobelia::gallery {
namespace {

constexpr std::string_view kPngBegin("\x89PNG\r\n\x1a\n", 8);
constexpr std::uint32_t kMostSide = 4096;

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char c : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

struct Parts {
  std::string_view header;
  std::string data;
};

/// Empty if a chunk could change the meaning of the values.
std::optional<Parts> parts_of(std::string_view file) {
  if (!file.starts_with(kPngBegin)) return std::nullopt;
  file.remove_prefix(kPngBegin.size());
  Parts parts;
  bool is_srgb = false, has_gamma = false;
  while (file.size() >= 12) {
    const std::size_t size = big_endian(file);
    if (size > file.size() - 12) return std::nullopt;
    const std::string_view type = file.substr(4, 4), content = file.substr(8, size);
    file.remove_prefix(12 + size);
    if (type == "IHDR" && parts.header.empty())
      parts.header = content;
    else if (type == "IDAT")
      parts.data += content;
    else if (type == "sRGB")
      is_srgb = true;
    else if (type == "gAMA" || type == "cHRM")
      has_gamma = true;  // sRGB outweighs it
    else if (type == "IEND")
      return has_gamma && !is_srgb ? std::nullopt : std::optional(parts);
    else if (type != "tEXt" && type != "tIME" && type != "pHYs" && type != "oFFs")
      return std::nullopt;
  }
  return std::nullopt;
}

int paeth(int left, int above, int corner) {
  const int guess = left + above - corner;
  const int a = std::abs(guess - left), b = std::abs(guess - above), c = std::abs(guess - corner);
  return a <= b && a <= c ? left : b <= c ? above : corner;
}

/// Adds the prediction of each row's filter. False for a filter that there is not.
bool unfilter(const std::string& rows, DisplayImage& image) {
  const std::size_t stride = 3 * std::size_t(image.width);
  const std::uint8_t* above = nullptr;
  for (int y = 0; y < image.height; ++y) {
    const char* from = rows.data() + std::size_t(y) * (stride + 1);
    std::uint8_t* to = image.rgb.data() + std::size_t(y) * stride;
    const int filter = *from++;
    if (filter < 0 || filter > 4) return false;
    for (std::size_t i = 0; i < stride; ++i) {
      const int left = i < 3 ? 0 : to[i - 3], up = above ? above[i] : 0;
      const int corner = i < 3 || !above ? 0 : above[i - 3];
      const int guess = filter == 0   ? 0
                        : filter == 1 ? left
                        : filter == 2 ? up
                        : filter == 3 ? (left + up) / 2
                                      : paeth(left, up, corner);
      to[i] = std::uint8_t(static_cast<unsigned char>(from[i]) + guess);
    }
    above = to;
  }
  return true;
}

}  // namespace

std::optional<DisplayImage> plain_png(std::string_view file) {
  const std::optional<Parts> parts = parts_of(file);
  if (!parts || parts->header.size() != 13) return std::nullopt;
  const std::uint32_t width = big_endian(parts->header),
                      height = big_endian(parts->header.substr(4));
  // 8 bits, RGB, and the only compression and filters that there are, without interlacing.
  if (parts->header.substr(8) != std::string_view("\x08\x02\x00\x00\x00", 5)) return std::nullopt;
  if (width == 0 || height == 0 || width > kMostSide || height > kMostSide) return std::nullopt;
  DisplayImage image{int(width), int(height), {}};
  std::string rows((3 * std::size_t(width) + 1) * height, '\0');
  uLongf size = uLongf(rows.size());
  if (uncompress(reinterpret_cast<Bytef*>(rows.data()), &size,
                 reinterpret_cast<const Bytef*>(parts->data.data()),
                 uLong(parts->data.size())) != Z_OK ||
      size != rows.size())
    return std::nullopt;
  image.rgb.resize(3 * std::size_t(width) * height);
  return unfilter(rows, image) ? std::optional(std::move(image)) : std::nullopt;
}

}  // namespace lobelia::gallery
