#include "profile/contour.hpp"

#include <algorithm>
#include <cmath>

namespace lobelia {
namespace {

constexpr int kPlaces = 8;

/// Whether the pixel and its neighbours are not all on the same side of the level.
bool is_on_contour(const Field& field, int x, int y, double level) {
  const bool above = field.at(x, y) >= level;
  for (int j = y - 1; j <= y + 1; ++j)
    for (int i = x - 1; i <= x + 1; ++i)
      if ((field.at(i, j) >= level) != above) return true;
  return false;
}

/// Nothing of the pixel if no place of it is above; a whole pixel where there are too few neighbours to interpolate.
void add_parts(std::vector<ContourPart>& parts, const Field& field, int x, int y, double level) {
  ContourPart part{{0, 0}, 0, 0};
  for (int j = 0; j < kPlaces; ++j)
    for (int i = 0; i < kPlaces; ++i) {
      const FilmPoint place{x + (i + 0.5) / kPlaces, y + (j + 0.5) / kPlaces};
      const double value = sample_of_highlight(field, place);
      if (std::isnan(value)) {
        if (field.at(x, y) >= level) parts.push_back({{x + 0.5, y + 0.5}, field.at(x, y), 1});
        return;
      }
      if (!(value >= level)) continue;
      part.place.x += value * place.x;
      part.place.y += value * place.y;
      part.value += value;
      part.area += 1;
    }
  if (!(part.value > 0)) return;
  part.place = {part.place.x / part.value, part.place.y / part.value};
  part.value /= part.area;
  part.area /= kPlaces * kPlaces;
  parts.push_back(part);
}

}  // namespace

std::vector<ContourPart> parts_above(const Field& field, const std::vector<std::size_t>& region,
                                     double level) {
  std::vector<ContourPart> parts;
  std::vector<std::size_t> edge;
  for (const std::size_t i : region) {
    const int x = int(i % std::size_t(field.width)), y = int(i / std::size_t(field.width));
    if (!is_on_contour(field, x, y, level)) {
      parts.push_back({pixel_centre(field, i), field.values[i], 1});
      continue;
    }
    for (int v = std::max(0, y - 1); v <= std::min(field.height - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(field.width - 1, x + 1); ++u)
        if (is_on_contour(field, u, v, level)) edge.push_back(field.index(u, v));
  }
  std::ranges::sort(edge);
  edge.erase(std::unique(edge.begin(), edge.end()), edge.end());
  for (const std::size_t i : edge)
    add_parts(parts, field, int(i % std::size_t(field.width)), int(i / std::size_t(field.width)),
              level);
  return parts;
}

Axes principal_axes(const std::vector<ContourPart>& parts) {
  double sum = 0;
  FilmPoint centre;
  for (const ContourPart& part : parts) {
    const double weight = part.value * part.area;
    sum += weight;
    centre.x += weight * part.place.x;
    centre.y += weight * part.place.y;
  }
  centre = {centre.x / sum, centre.y / sum};
  double xx = 0, xy = 0, yy = 0;
  for (const ContourPart& part : parts) {
    const double weight = part.value * part.area / sum;
    const double dx = part.place.x - centre.x, dy = part.place.y - centre.y;
    // A square of the same area, spread over it.
    const double own = part.area / 12;
    xx += weight * (dx * dx + own);
    xy += weight * dx * dy;
    yy += weight * (dy * dy + own);
  }
  return axes_of_moments(centre, xx, xy, yy);
}

double share_within(FilmPoint pixel, FilmPoint centre, double radius) {
  return std::clamp(radius - distance(pixel, centre) + 0.5, 0.0, 1.0);
}

}  // namespace lobelia
