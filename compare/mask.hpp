// Parts of a picture that a user names, to be measured by themselves or left out, and the cut of a picture.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <variant>

#include "base/pictures/picture.hpp"
#include "base/pictures/pixel_flags.hpp"

namespace lobelia {

struct MaskShape {
  struct Rectangle {
    int x = 0, y = 0, width = 0, height = 0;  ///< pixels; may reach beyond the picture
  };
  using Polygon = std::vector<std::array<double, 2>>;  ///< corners in pixels; closed by itself

  std::string text;  ///< as it was given
  /// Inside are the pixels of a picture that are not 0 in every channel, or those with their centre in a polygon, by the
  /// even-odd rule. The centre of the first pixel is (0.5, 0.5).
  std::variant<Rectangle, Polygon, Image> form;
};

inline constexpr int kMaxPolygonCorners = 1000;

/// Reads "rect:X,Y,W,H", "polygon:X,Y X,Y X,Y ..." or the file of a picture. Throws Error(kUsage) for a shape that is
/// malformed, and Error(kInput) for a picture that cannot be read or has a NaN.
MaskShape parse_mask_shape(std::string_view option, const std::string& text);
/// Whether the text is the file of a picture and no shape.
bool is_picture_of_mask(std::string_view text);
/// The files of those that are pictures.
std::vector<std::filesystem::path> picture_files(std::span<const MaskShape> shapes);

/// By pixel, 1 where it is inside any of the shapes. Throws Error(kInput) if a picture has another size.
PixelFlags pixels_inside(std::span<const MaskShape> shapes, int width, int height);

/// The part of the image in the window. Throws Error(kInput) unless the window lies within the picture.
Image cut(Image image, const PixelWindow& window);
/// The same of a value for each pixel of a picture that is `width` wide; nothing of nothing.
PixelFlags cut(std::span<const std::uint8_t> pixels, int width, const PixelWindow& window);

}  // namespace lobelia
