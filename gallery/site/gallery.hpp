// Makes a static site from a farm's records. It opens from a double-click, without a network.
//
// The room has its own namespace, because its grids, metrics and pictures are those that pages show.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "base/pictures/pixel_flags.hpp"
#include "gallery/cells/metrics.hpp"

namespace lobelia::gallery {

/// The viewing conditions of a comparison.
struct MapViewing {
  double exposure_stops, pixels_per_degree;
};

/// A map of visible differences that a page can show pixel by pixel. The caller of the gallery provides it.
struct MapKind {
  std::string id;  ///< "flip.ldr": the beginning of its metrics' ids
  std::string title, meaning;
  /// One value per pixel, from 0; 1 is a difference that is noticed. `b` is the reference and has the size of `a`.
  std::function<std::vector<float>(const Image& a, const Image& b, const MapViewing& viewing)>
      measure;
  double top = 10;  ///< end of its scale, the same on every page
};

/// The pixels that a verdict was about, by pixel not 0: the highlight of two finite pictures of one size.
using RegionOf = std::function<PixelFlags(const Image& a, const Image& b)>;

/// By pixel of a picture of this size, not 0 where a scene has a surface; empty if that is not known.
using SurfaceOf =
    std::function<PixelFlags(const std::filesystem::path& scene, int width, int height)>;

/// A folder for each of so many cells is slow to write, to copy and to delete.
inline constexpr std::size_t kManyCells = 2000;

struct GalleryOptions {
  std::filesystem::path site;  ///< output directory; empty: the run's own directory
  bool metrics_only = false;   ///< no float pictures: numbers, curves and thumbnails
  std::vector<MapKind> maps;   ///< made for every comparison, unless metrics_only
  RegionOf region;             ///< likewise; may be empty
  SurfaceOf surface;           ///< for thumbnails; may be empty
  /// Metrics only, with all cells on one page and their data in few files; by default from kManyCells cells on.
  std::optional<bool> packed;
  double share_of_bytes = 1;        ///< of what float pictures and maps of a cell may take
  std::vector<MetricInfo> metrics;  ///< that pages can explain; any other is shown by its id
  std::vector<std::filesystem::path> baselines;  ///< earlier runs, the oldest first
  std::string title;                             ///< empty: the grid's
  std::string base_url;  ///< public address, for previews of links to it; empty: unknown
  /// Without texts that tell of the machine (published_texts.hpp). Not into the run itself.
  bool scrubbed = false;
  /// Style and script are named by their content, so that a server may let browsers keep them for ever.
  bool for_host = false;
  bool only_cells = false;  ///< no pages of studies
  std::string only_cell;    ///< the id of the only cell; empty: all
  bool is_part = false;  ///< something else is made of the site: until then an interruption counts
};

struct PublishedGallery {
  std::filesystem::path index;
  std::size_t cells = 0;
  std::string title;
  /// "ID: damaged: povray.exr cannot be read", for each cell that is not as the farm wrote it or contradicts itself.
  std::vector<std::string> doubts;
  /// "ID: POV-Ray: pass became differs", for each cell that is worse than in the last of the baselines.
  std::vector<std::string> worse;
};

/// Reads RUN/farm.json and the records it names. Writes index.html, a page for every cell and for every view with a
/// record, their script, style and data, and gallery.json, which lists the files. If the site is not the run's directory,
/// copies the files that pages show or link to. Unchanged files are not touched. Files of an earlier publication that are
/// no longer part of the site are removed.
///
/// Compares every file of a cell with its hash in cell.json, and makes every verdict again from the figures and limits of
/// its record. A missing, damaged or changed file is not shown, and its cell has that state in place of a verdict. Beyond
/// that, only subtracts curves and pictures for drawings and makes `maps`; everything else is shown as recorded.
/// With baselines, each cell is compared with the same cell of the last of them, and has a timeline over all. They are
/// checked as the run is, and links in them are not followed.
/// Throws Error(kInput) if farm.json cannot be read, also a baseline's, Error(kUsage) for a bad title or base URL.
PublishedGallery write_gallery(const std::filesystem::path& run,
                               const GalleryOptions& options = {});

}  // namespace lobelia::gallery
