#include "compare/nonfinite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/words/text.hpp"
#include "profile/require_same_size.hpp"

namespace lobelia {
namespace {

bool is_same_nonfinite(float a, float b) {
  return (std::isnan(a) && std::isnan(b)) || (std::isinf(a) && a == b);
}

}  // namespace

std::optional<records::NonfinitePlace> first_nonfinite(const Image& image) {
  const auto values = image.values();
  const auto found = std::ranges::find_if_not(values, [](float v) { return std::isfinite(v); });
  if (found == values.end()) return std::nullopt;
  const auto at = std::size_t(found - values.begin());
  const std::size_t pixel = at / 3, width = std::size_t(image.width());
  return records::NonfinitePlace{int(pixel % width), int(pixel / width),
                                 std::string(1, "RGB"[at % 3]), double(*found)};
}

std::string place_text(const records::NonfinitePlace& place, std::string_view file) {
  const std::string_view value = std::isnan(place.value) ? "nan" : place.value > 0 ? "inf" : "-inf";
  return fmt::format("{} in {} at x {}, y {}, channel {}", value, printable_path(file), place.x,
                     place.y, printable(place.channel));
}

void name_channel(records::NonfinitePlace& place, const PictureSource& source) {
  const std::size_t channel = place.channel == "R" ? 0 : place.channel == "G" ? 1 : 2;
  if (source.channels.size() == 1)
    place.channel = source.channels[0];
  else if (channel < source.channels.size())
    place.channel = source.channels[channel];
}

std::int64_t clear_equal_nonfinite(Image& a, Image& b) {
  require_same_size(a, b);
  const auto values_a = a.values(), values_b = b.values();
  std::int64_t pixels = 0;
  for (std::size_t pixel = 0; pixel < values_a.size(); pixel += 3) {
    bool any = false;
    for (std::size_t i = pixel; i < pixel + 3; ++i)
      if (is_same_nonfinite(values_a[i], values_b[i])) {
        values_a[i] = values_b[i] = 0;
        any = true;
      }
    pixels += any;
  }
  return pixels;
}

bool is_depth_like(std::string_view layer) {
  constexpr std::string_view kNames[] = {"z", "zback", "depth", "distance", "position"};
  const auto parts = split(lower_case(layer), ".");
  return std::ranges::find_first_of(parts, kNames) != parts.end();
}

}  // namespace lobelia
