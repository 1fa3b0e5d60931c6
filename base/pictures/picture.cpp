#include "base/pictures/picture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "base/pictures/orientation.hpp"
#include "base/words/text.hpp"

namespace lobelia {

std::string window_problem(const std::string& what, const PixelWindow& window) {
  constexpr int kFarthest = 1 << 30;  // sums of corners and sides stay within an int
  if (window.width < 1 || window.height < 1) return what + " has no pixels";
  if (window.width > kMaxImageSide || window.height > kMaxImageSide ||
      std::int64_t{window.width} * window.height > kMaxImagePixels)
    return fmt::format("{} has {} x {} pixels; at most {} a side and {} in all are read", what,
                       window.width, window.height, kMaxImageSide, kMaxImagePixels);
  if (window.x < -kFarthest || window.x > kFarthest || window.y < -kFarthest ||
      window.y > kFarthest)
    return fmt::format("{} begins at ({}, {}); at most {} is read", what, window.x, window.y,
                       kFarthest);
  return "";
}

bool are_apart(const PixelWindow& a, const PixelWindow& b) {
  return a.x >= b.x + b.width || b.x >= a.x + a.width || a.y >= b.y + b.height ||
         b.y >= a.y + a.height;
}

bool is_inside(const PixelWindow& inner, const PixelWindow& outer) {
  return outer.x <= inner.x && outer.y <= inner.y &&
         std::int64_t{inner.x} + inner.width <= std::int64_t{outer.x} + outer.width &&
         std::int64_t{inner.y} + inner.height <= std::int64_t{outer.y} + outer.height;
}

std::string windows_problem(const PixelWindow& data, const PixelWindow& display) {
  for (const std::string& problem :
       {window_problem("its data window", data), window_problem("its display window", display)})
    if (!problem.empty()) return problem;
  return are_apart(data, display) ? "its data window lies outside its display window" : "";
}

Image place(Image image, const PixelWindow& data, const PixelWindow& display) {
  if (data == display) return image;
  Image result(display.width, display.height);
  const int left = std::max(data.x, display.x);
  const int right = std::min(data.x + data.width, display.x + display.width);
  const int bottom = std::min(data.y + data.height, display.y + display.height);
  if (left >= right) return result;
  for (int y = std::max(data.y, display.y); y < bottom; ++y)
    std::copy_n(image.pixel(left - data.x, y - data.y).data(), std::size_t(right - left) * 3,
                result.pixel(left - display.x, y - display.y).data());
  return result;
}

void place_on_display(Picture& picture) {
  const PictureSource& source = picture.source;
  if (!is_inside(source.data, source.display)) picture.overscan = picture.image;
  picture.image = place(std::move(picture.image), source.data, source.display);
}

std::vector<std::pair<std::string, std::string>> reading_facts(const PictureSource& source) {
  std::vector<std::pair<std::string, std::string>> facts;
  if (!source.layer.empty()) facts.emplace_back("Layer", printable(source.layer));
  if (source.orientation != kUpright)
    facts.emplace_back("Orientation", orientation_text(source.orientation));
  if (!source.icc_profile.empty())
    facts.emplace_back(
        "ICC profile",
        fmt::format("{}, {}", printable(source.icc_profile),
                    source.transfer == kByProfile ? "applied"
                    : source.icc_is_srgb          ? "the same as sRGB"
                                         : "not applied, because floats are light already"));
  if (source.transfer == "PQ" || source.transfer == "HLG")
    facts.emplace_back("Curve", source.transfer + ", 1 is 203 cd/m^2");
  if (!source.chromaticities.empty())
    facts.emplace_back("Primaries", fmt::format("{:.4g}, converted to Rec. 709",
                                                fmt::join(source.chromaticities, " ")));
  if (source.has_gain_map)
    facts.emplace_back("Gain map", "not applied; only the base picture is read");
  return facts;
}

}  // namespace lobelia
