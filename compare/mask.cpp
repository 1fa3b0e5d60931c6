#include "compare/mask.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/pictures/image_io.hpp"
#include "base/system/error.hpp"
#include "base/words/text.hpp"

namespace lobelia {
namespace {

constexpr std::string_view kRectangle = "rect:", kPolygon = "polygon:";

/// "X,Y" or "X,Y,W,H"; empty if they are not `count` numbers, each within the sides of the largest picture.
std::vector<double> coordinates(std::string_view text, std::size_t count) {
  std::vector<double> numbers;
  for (const std::string& part : split(text, ",")) {
    double number = 0;
    if (!parse_number(part, number) || std::abs(number) > kMaxImageSide) return {};
    numbers.push_back(number);
  }
  if (numbers.size() != count || std::ranges::count(text, ',') != std::ptrdiff_t(count) - 1)
    return {};
  return numbers;
}

MaskShape::Rectangle parse_rectangle(std::string_view option, std::string_view text) {
  const std::vector<double> numbers = coordinates(text.substr(kRectangle.size()), 4);
  const auto is_whole = [](double number) { return number == std::floor(number); };
  if (numbers.empty() || !std::ranges::all_of(numbers, is_whole) || numbers[2] < 1 ||
      numbers[3] < 1)
    throw Error(ExitCode::kUsage, "{} {}: X,Y,W,H must be whole pixels, W and H at least 1", option,
                printable(text));
  return {int(numbers[0]), int(numbers[1]), int(numbers[2]), int(numbers[3])};
}

MaskShape::Polygon parse_polygon(std::string_view option, std::string_view text) {
  MaskShape::Polygon corners;
  bool good = true;
  for (const std::string& corner : split(text.substr(kPolygon.size()), " \t\n")) {
    const std::vector<double> place = coordinates(corner, 2);
    good = good && !place.empty();
    if (good) corners.push_back({place[0], place[1]});
  }
  if (!good || corners.size() < 3 || corners.size() > kMaxPolygonCorners)
    throw Error(ExitCode::kUsage,
                "{} {}: expected \"polygon:X,Y X,Y X,Y ...\" with 3 to {} corners", option,
                printable(text), kMaxPolygonCorners);
  return corners;
}

void add(const MaskShape::Rectangle& shape, PixelFlags& pixels, int width, int height) {
  const int left = std::max(0, shape.x), right = std::min(width, shape.x + shape.width);
  for (int y = std::max(0, shape.y); y < std::min(height, shape.y + shape.height); ++y)
    for (int x = left; x < right; ++x)
      pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)] = 1;
}

void add(const MaskShape::Polygon& corners, PixelFlags& pixels, int width, int height) {
  std::vector<double> crossings;
  for (int y = 0; y < height; ++y) {
    const double middle = y + 0.5;
    crossings.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto& [x1, y1] = corners[i];
      const auto& [x2, y2] = corners[(i + 1) % corners.size()];
      if ((y1 <= middle) != (y2 <= middle))
        crossings.push_back(x1 + (middle - y1) / (y2 - y1) * (x2 - x1));
    }
    std::ranges::sort(crossings);
    std::uint8_t* row = pixels.data() + std::size_t(y) * std::size_t(width);
    // An even number of sides crosses a row.
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const auto first_from = [&](double x) {
        return std::clamp(std::ceil(x - 0.5), 0.0, double(width));
      };
      std::fill(row + std::ptrdiff_t(first_from(crossings[i])),
                row + std::ptrdiff_t(first_from(crossings[i + 1])), std::uint8_t{1});
    }
  }
}

void add(const Image& picture, PixelFlags& pixels, int, int) {
  for (std::size_t i = 0; i < picture.values().size(); ++i)
    if (picture.values()[i] != 0) pixels[i / 3] = 1;
}

void require_inside(const PixelWindow& window, int width, int height) {
  if (!is_inside(window, {0, 0, width, height}))
    throw Error(ExitCode::kInput, "--crop {},{},{},{}: does not lie within the {} x {} pixels",
                window.x, window.y, window.width, window.height, width, height);
}

}  // namespace

bool is_picture_of_mask(std::string_view text) {
  return !text.starts_with(kRectangle) && !text.starts_with(kPolygon);
}

std::vector<std::filesystem::path> picture_files(std::span<const MaskShape> shapes) {
  std::vector<std::filesystem::path> files;
  for (const MaskShape& shape : shapes)
    if (std::holds_alternative<Image>(shape.form)) files.emplace_back(shape.text);
  return files;
}

MaskShape parse_mask_shape(std::string_view option, const std::string& text) {
  if (text.starts_with(kRectangle)) return {text, parse_rectangle(option, text)};
  if (text.starts_with(kPolygon)) return {text, parse_polygon(option, text)};
  Image picture = read_image(text);
  if (std::ranges::any_of(picture.values(), [](float value) { return std::isnan(value); }))
    throw Error(ExitCode::kInput, "{} {}: has a NaN, which is neither inside nor outside", option,
                printable_path(text));
  return {text, std::move(picture)};
}

PixelFlags pixels_inside(std::span<const MaskShape> shapes, int width, int height) {
  PixelFlags pixels(std::size_t(width) * std::size_t(height));
  for (const MaskShape& shape : shapes) {
    if (const auto* picture = std::get_if<Image>(&shape.form);
        picture && (picture->width() != width || picture->height() != height))
      throw Error(ExitCode::kInput, "the mask {} has {} x {} pixels, the pictures have {} x {}",
                  printable_path(shape.text), picture->width(), picture->height(), width, height);
    std::visit([&](const auto& form) { add(form, pixels, width, height); }, shape.form);
  }
  return pixels;
}

Image cut(Image image, const PixelWindow& window) {
  const int width = image.width(), height = image.height();
  require_inside(window, width, height);
  return place(std::move(image), {0, 0, width, height}, window);
}

PixelFlags cut(std::span<const std::uint8_t> pixels, int width, const PixelWindow& window) {
  if (pixels.empty()) return {};
  require_inside(window, width, int(pixels.size() / std::size_t(width)));
  PixelFlags result(std::size_t(window.width) * std::size_t(window.height));
  for (int y = 0; y < window.height; ++y)
    std::ranges::copy(
        pixels.subspan(std::size_t(window.y + y) * std::size_t(width) + std::size_t(window.x),
                       std::size_t(window.width)),
        result.begin() + std::ptrdiff_t{window.width} * y);
  return result;
}

}  // namespace lobelia
