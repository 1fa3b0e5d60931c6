// Where two pictures differ: one value a pixel, and a picture of it in the colours of a named map.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/metrics/metric.hpp"
#include "core/image.hpp"

namespace lobelia {

/// A pair of one size, however it is to be looked at; `b` is the reference.
struct MapInput {
  const Image& a;
  const Image& b;
  const DisplayLight& shown_a;
  const DisplayLight& shown_b;
  double pixels_per_degree;
};

struct DifferenceMap {
  std::string_view id;  ///< "ciede2000": name on the command line
  std::string_view unit, meaning;
  bool is_signed;  ///< values below 0 say something: its colours diverge from 0
  /// Compares the pictures as seen under the viewing condition, not their values; from 0 to about 1.
  bool is_visual;
  /// One value a pixel in reading order; values of `a` and `b` are finite.
  std::vector<float> (*measure)(const MapInput& input);
};

std::span<const DifferenceMap> difference_maps();
std::vector<std::string_view> difference_map_names();
/// Null if there is none of that id.
const DifferenceMap* find_difference_map(std::string_view id);

/// The map of any two pictures of one size: NaN where either has a value that is not finite, which counts as
/// 0 for its neighbours. Throws Error(kInput) if the sizes differ.
std::vector<float> measure_difference_map(const DifferenceMap& map, const Image& a, const Image& b,
                                          const Viewing& viewing);

/// Colour maps for a scale from 0 (matplotlib's, by OpenImageIO) and, last, the one for signed values.
std::span<const std::string_view> colour_map_names();
inline constexpr std::string_view kDefaultColourMap = "magma", kSignedColourMap = "blue_white_red";

/// `values` as colours: 0 is the map's first, `scale` its last; of kSignedColourMap -scale is blue, 0 white and
/// scale red. What is beyond is clipped; NaN is green, which no map but turbo and viridis comes near.
/// `scale` > 0. Throws Error(kUsage) for an unknown map.
DisplayImage colour_picture(std::span<const float> values, int width, int height, double scale,
                            std::string_view colour_map);

/// Metadata that say how to read such a picture.
ImageMetadata colour_metadata(const DifferenceMap& map, double scale, std::string_view colour_map);

}  // namespace lobelia
