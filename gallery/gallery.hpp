// From a farm's records to a static site that opens from a double-click, without a network.
//
// The room has a namespace of its own: a grid, a metric and a picture are here what pages show of them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "gallery/metrics.hpp"

namespace lobelia::gallery {

/// How the pictures of a comparison were looked at.
struct MapViewing {
  double exposure_stops, pixels_per_degree;
};

/// A difference for the eye that a page can show pixel by pixel. What it is, the room's user knows.
struct MapKind {
  std::string id, title,
      meaning;  ///< "flip.ldr", as the metric's figures begin; words for a reader
  /// One value of each pixel, from 0; 1 is a difference that is noticed. `b` is the reference, of the size of `a`.
  std::function<std::vector<float>(const Image& a, const Image& b, const MapViewing& viewing)>
      measure;
};

struct GalleryOptions {
  std::filesystem::path site;       ///< where to; empty: the run's own directory
  bool metrics_only = false;        ///< no float pictures: numbers, curves and thumbnails
  std::vector<MapKind> maps;        ///< of every comparison, unless metrics_only
  std::vector<MetricInfo> metrics;  ///< that pages can explain; any other is shown by its id
  std::string title;                ///< in place of the grid's; empty: that
  std::string base_url;  ///< where it will be published, for links to it by others; empty: unknown
};

struct PublishedGallery {
  std::filesystem::path index;
  std::size_t cells = 0;
  /// "ID: damaged: povray.exr cannot be read", for each cell that is not as the farm wrote it or contradicts itself.
  std::vector<std::string> doubts;
};

/// Reads RUN/farm.json and the records it names; writes index.html, a page for every cell and for every view
/// that has something to show, their script, style and data, and gallery.json, which lists them. In another
/// directory than the run's also copies of the files that pages show or link to. Files that are as they should
/// be are not touched, and those that an earlier publication wrote there and this one does not are removed.
///
/// Every file of a cell is compared with its hash in cell.json, and every verdict is made again from the figures and
/// limits of its record. A file that is missing, damaged or changed is not shown, and its cell has that state in place of
/// a verdict. Otherwise draws what the records say and computes nothing but the subtraction of two curves or pictures for
/// a drawing, and the maps that it is given. Error(kInput) only if farm.json itself cannot be read, Error(kUsage) for a
/// title or base URL that is none.
PublishedGallery write_gallery(const std::filesystem::path& run,
                               const GalleryOptions& options = {});

}  // namespace lobelia::gallery
