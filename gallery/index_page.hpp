// The index: what this is, how it was made, and the grid.
#pragma once

#include <string>
#include <vector>

#include "core/html.hpp"
#include "gallery/cell_summary.hpp"
#include "gallery/page.hpp"

namespace lobelia::gallery {

inline constexpr char kGridData[] = "grid.data.js";

/// `cells` in the order of farm.cells.
std::string index_page(const SiteFrame& site, const ShownFarm& farm,
                       const std::vector<CellSummary>& cells);

/// The grid as thumbnails, a table for each section (index_grid.cpp).
void write_grid(Html& html, const ShownFarm& farm, const std::vector<CellSummary>& cells);

}  // namespace lobelia::gallery
