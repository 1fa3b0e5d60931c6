// The region of a highlight above a level, to a fraction of a pixel.
//
// Whole pixels in or out would move the centroid of a small highlight by a tenth of a pixel, by chance and without any
// noise. So a pixel on the contour counts by parts: 8 x 8 places in it, with values by cubic interpolation.
#pragma once

#include <vector>

#include "profile/peak.hpp"

namespace lobelia {

/// A pixel within the contour, or the part of one that lies in it.
struct ContourPart {
  FilmPoint place;  ///< of its middle
  double value;     ///< the mean there
  double area;      ///< pixels, up to 1
};

/// `region` are connected pixels above the level, as region_above() finds them; their neighbours may have parts above it. A
/// pixel beside a hole or the border counts as a whole or not at all.
std::vector<ContourPart> parts_above(const Field& field, const std::vector<std::size_t>& region,
                                     double level);

/// Axes weighted by value and area. The sum of the weights is positive.
Axes principal_axes(const std::vector<ContourPart>& parts);

/// How much of a pixel lies within `radius` of `centre`, 0 to 1, by its distance.
double share_within(FilmPoint pixel, FilmPoint centre, double radius);

}  // namespace lobelia
