#include "compare/maps/difference_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/pictures/image_io.hpp"
#include "base/pictures/image_values.hpp"
#include "base/words/constants.hpp"
#include "base/words/text.hpp"
#include "profile/require_same_size.hpp"

namespace lobelia {
namespace {

constexpr std::string_view kColourMaps[] = {kDefaultColourMap, "inferno", "plasma",
                                            "viridis",         "turbo",   kSignedColourMap};

constexpr std::array<std::uint8_t, 3> kNotFinite = {0, 255, 0};

ColourTable blue_white_red() {
  ColourTable table;
  for (int i = 0; i < kColourTableSize; ++i) {
    // The middle position rounds up to this entry: equal pixels are white.
    constexpr int kMiddle = kColourTableSize / 2;
    const double t = std::max(double(i - kMiddle) / (kColourTableSize - 1 - kMiddle), -1.0);
    const auto fading = std::uint8_t(std::lround(255 * (1 - std::abs(t))));
    table[std::size_t(i)] = t < 0 ? std::array<std::uint8_t, 3>{fading, fading, 255}
                                  : std::array<std::uint8_t, 3>{255, fading, fading};
  }
  return table;
}

/// A copy with 0 for values that are not finite; marks their pixels in `broken`.
Image without_non_finite(const Image& image, PixelFlags& broken) {
  Image copy(image.width(), image.height());
  in_parts(image.values().size(), 2 * sizeof(float) + 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (std::isfinite(image.values()[i]))
        copy.values()[i] = image.values()[i];
      else
        broken[i / 3] = 1;
  });
  return copy;
}

PixelValues measure_finite(const DifferenceMap& map, const Image& a, const Image& b,
                           const Viewing& viewing) {
  MetricInput input{a, b, as_shown(a, viewing), as_shown(b, viewing), viewing.pixels_per_degree};
  if (viewing.hdr_exposures) input.hdr_exposures = &*viewing.hdr_exposures;
  return map.measure(input);
}

}  // namespace

std::vector<std::string_view> difference_map_names() {
  std::vector<std::string_view> names;
  for (const DifferenceMap& map : difference_maps()) names.push_back(map.id);
  return names;
}

const DifferenceMap* find_difference_map(std::string_view id) {
  for (const DifferenceMap& map : difference_maps())
    if (map.id == id) return &map;
  return nullptr;
}

PixelValues measure_difference_map(const DifferenceMap& map, const Image& a, const Image& b,
                                   const Viewing& viewing) {
  require_same_size(a, b);
  if (map.needs_exposures && !viewing.hdr_exposures)
    throw Error(ExitCode::kUsage, "the map {} needs a range of exposures", map.id);
  if (is_finite(a) && is_finite(b)) return measure_finite(map, a, b, viewing);
  PixelFlags broken(a.pixel_count());
  const Image finite_a = without_non_finite(a, broken), finite_b = without_non_finite(b, broken);
  PixelValues values = measure_finite(map, finite_a, finite_b, viewing);
  in_parts(values.size(), sizeof(float) + 1, [&](std::size_t begin, std::size_t end) {
    for (; begin < end; ++begin)
      if (broken[begin] != 0) values[begin] = float(kNaN);
  });
  return values;
}

std::span<const std::string_view> colour_map_names() { return kColourMaps; }

DisplayImage colour_picture(std::span<const float> values, int width, int height, ColourScale scale,
                            std::string_view colour_map) {
  if (std::ranges::count(kColourMaps, colour_map) == 0)
    throw Error(ExitCode::kUsage, "no colour map '{}'{}; there are {}", printable(colour_map),
                did_you_mean(colour_map, kColourMaps), join(kColourMaps));
  const bool diverges = colour_map == kSignedColourMap;
  const ColourTable table = diverges ? blue_white_red() : colour_table(colour_map);
  DisplayImage picture{width, height, std::vector<std::uint8_t>(3 * values.size())};
  if (diverges) scale.from = -scale.to;
  const auto show_pixel = [&](std::size_t i) {
    const double share = (double(values[i]) - scale.from) / (scale.to - scale.from);
    const double position = std::clamp(share, 0.0, 1.0);
    const auto& colour = std::isnan(share)
                             ? kNotFinite
                             : table[std::size_t(std::lround(position * (kColourTableSize - 1)))];
    std::copy(colour.begin(), colour.end(), picture.rgb.begin() + std::ptrdiff_t(3 * i));
  };
  in_parts(values.size(), sizeof(float), [&](std::size_t begin, std::size_t end) {
    for (; begin < end; ++begin) show_pixel(begin);
  });
  return picture;
}

ImageMetadata colour_metadata(const DifferenceMap& map, ColourScale scale,
                              std::string_view colour_map) {
  const double first = colour_map == kSignedColourMap ? -scale.to : scale.from;
  return {{"Description", fmt::format("{} ({}), {:.6g} to {:.6g} in {}", map.meaning, map.unit,
                                      first, scale.to, colour_map)},
          {"lobelia:difference", std::string(map.id)},
          {"lobelia:unit", std::string(map.unit)},
          {"lobelia:colourMap", std::string(colour_map)},
          {"lobelia:scaleFrom", fmt::format("{}", first)},
          {"lobelia:scaleTo", fmt::format("{}", scale.to)},
          {"lobelia:notFinite", "#00ff00"}};
}

}  // namespace lobelia
