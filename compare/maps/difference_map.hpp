// Maps of the difference of two pictures: one value a pixel, and a picture of it in the colours of a named map.
#pragma once

#include "compare/metrics/metric.hpp"

namespace lobelia {

/// The values of a map that have the first and the last colour.
struct ColourScale {
  ColourScale(double last) : to(last) {}
  ColourScale(double first, double last) : from(first), to(last) {}
  double from = 0, to = 1;
};

/// The scale that suits a map if the user gives none.
enum class MapScale : std::uint8_t {
  kLargest,    ///< to its largest value
  kOne,        ///< from 0 to 1, as FLIP's tool has it
  kExposures,  ///< over the range of exposures
};

struct DifferenceMap {
  std::string_view id;  ///< "ciede2000": name on the command line
  std::string_view unit, meaning;
  bool is_signed;   ///< values may be negative: the colours diverge from 0
  bool in_gallery;  ///< on the gallery's pages, which draw differences of values themselves
  /// One value a pixel in reading order.
  PixelValues (*measure)(const MetricInput& input);
  MapScale scale = MapScale::kLargest;
  bool needs_exposures = false;   ///< of HDR-FLIP
  std::string_view colours = {};  ///< empty: kDefaultColourMap, of signed values kSignedColourMap
};

std::span<const DifferenceMap> difference_maps();
std::vector<std::string_view> difference_map_names();
/// Null if there is no map of this id.
const DifferenceMap* find_difference_map(std::string_view id);

/// The map of any two pictures of one size. NaN where a value of either is not finite; its neighbours see 0 there.
/// Throws Error(kInput) if the sizes differ, and Error(kUsage) if the map needs exposures and there are none.
PixelValues measure_difference_map(const DifferenceMap& map, const Image& a, const Image& b,
                                   const Viewing& viewing);

/// Colour maps for a scale from 0 (matplotlib's, by OpenImageIO), and last the one for signed values.
std::span<const std::string_view> colour_map_names();
inline constexpr std::string_view kDefaultColourMap = "magma", kSignedColourMap = "blue_white_red";

/// `values` as colours. In kSignedColourMap -scale.to is blue, 0 white and scale.to red. Values beyond are clipped. NaN
/// is green, which only turbo and viridis come near. Throws Error(kUsage) for an unknown map.
DisplayImage colour_picture(std::span<const float> values, int width, int height, ColourScale scale,
                            std::string_view colour_map);

/// Metadata that explain such a picture.
ImageMetadata colour_metadata(const DifferenceMap& map, ColourScale scale,
                              std::string_view colour_map);

}  // namespace lobelia
