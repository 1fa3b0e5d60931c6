// A site of pictures from anywhere, compared just now.
#pragma once

#include <map>

#include "gallery/cells/checked_cell.hpp"
#include "gallery/site/gallery.hpp"

namespace lobelia::gallery {

/// A pair, or one picture of each set.
struct ReportCell {
  CheckedCell cell;  ///< the names of its pictures are keys of the maps
  std::map<std::string, std::optional<Image>> pictures;  ///< by `exr`
  std::map<std::string, DisplayImage> shown;             ///< by the file of a `png`
};

struct Report {
  ShownFarm farm;  ///< is_report; the engines are the sets, the hub first
  /// The cell of an entry of the farm. Called once for each, by several threads at a time.
  std::function<ReportCell(const CellEntry&)> cell;
  std::map<std::string, std::string> files;  ///< records beside the index, by plain name
  bool only_small_pictures = false;          ///< beside the float pictures
};

/// Writes the site as write_gallery() does: an earlier one in the same directory is updated. Returns the index. Throws
/// Error(kOutput), and what Report::cell throws.
std::filesystem::path write_report(const Report& report, const GalleryOptions& options);

}  // namespace lobelia::gallery
