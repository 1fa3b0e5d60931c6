// The index: an introduction, the grid, and how it was made.
#pragma once

#include "gallery/checked_cell.hpp"
#include "gallery/page.hpp"

namespace lobelia::gallery {

inline constexpr char kGridData[] = "grid.data.js";

struct EngineFigure {
  std::string engine;  ///< short title
  std::string worst;   ///< "0.049 %", or a word for why there is none
  std::string note;    ///< "2 px": pixels beyond the tolerance, if any
};

/// A cell as the index shows it.
struct CellSummary {
  const CellEntry* entry = nullptr;
  CellStatus status = CellStatus::kMissing;
  bool is_as_written = true;          ///< no flaw, no contradiction, and sealed
  Picture picture;                    ///< the hub's
  std::vector<Picture> beside;        ///< of a report: each other's, followed by the difference
  std::vector<EngineFigure> figures;  ///< one per available reference engine
  std::vector<std::string> reasons;   ///< why it is not a pass
  /// By each engine that was compared with ours: all metrics but coordinates.
  records::Named<records::Named<double>> metrics;
};

CellSummary summarise(const ShownFarm& farm, const CellEntry& entry, const CheckedCell& cell);

// `cells` are in the order of farm.cells.

/// The input of the page's script.
records::GridPage grid_page_data(const ShownFarm& farm, const std::vector<CellSummary>& cells);
std::string index_page(const SiteFrame& site, const ShownFarm& farm,
                       const std::vector<CellSummary>& cells);
/// The grid as thumbnails, a table for each section (index_grid.cpp).
void write_grid(Html& html, const ShownFarm& farm, const std::vector<CellSummary>& cells);

}  // namespace lobelia::gallery
