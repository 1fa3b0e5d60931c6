// The cells of a large site: one page for all of them, and their data in few files (decision 11).
#pragma once

#include "gallery/pages/index_page.hpp"
#include "gallery/site/gallery.hpp"
#include "gallery/site/publisher.hpp"

namespace lobelia::gallery {

/// The number of cells that a reader waits for to see one, and that are written anew when one changes.
inline constexpr std::size_t kCellsOfChunk = 100;

/// Writes cell.html, and for each kCellsOfChunk cells a file of pages and one of thumbnails. Returns the summaries, in the
/// order of farm.cells.
std::vector<CellSummary> publish_packed_cells(const std::filesystem::path& run,
                                              const GalleryOptions& options, const SiteFrame& site,
                                              const ShownFarm& farm, const History& history,
                                              Publisher& publisher);

}  // namespace lobelia::gallery
