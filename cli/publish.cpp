#include "cli/publish.hpp"

#include <fmt/format.h>

#include "compare/maps/difference_map.hpp"

namespace lobelia::cli {
namespace {

/// Those for the eye; those of values a page can draw by itself.
std::vector<gallery::MapKind> visual_maps() {
  std::vector<gallery::MapKind> kinds;
  for (const DifferenceMap* map : difference_maps()) {
    if (!map->is_visual) continue;
    kinds.push_back({std::string(map->id), std::string(map->unit), std::string(map->meaning),
                     [map](const Image& a, const Image& b, const gallery::MapViewing& viewing) {
                       return measure_difference_map(
                           *map, a, b, {viewing.exposure_stops, viewing.pixels_per_degree});
                     }});
  }
  return kinds;
}

}  // namespace

std::filesystem::path publish(const std::filesystem::path& run, gallery::GalleryOptions options) {
  options.maps = visual_maps();
  return write_gallery(run, options);
}

void publish_if_wanted(const std::filesystem::path& run, const std::filesystem::path& site) {
  if (site.empty()) return;
  gallery::GalleryOptions options;
  options.site = site;
  fmt::print(stderr, "lobelia: gallery: {}\n", publish(run, options).string());
}

}  // namespace lobelia::cli
