// The index: what this is, how it was made, and the grid.
#pragma once

#include <string>
#include <vector>

#include "core/html.hpp"
#include "gallery/cell_summary.hpp"

namespace lobelia::gallery {

/// `cells` in the order of farm.cells; `has_cost`: there is a page of what accuracy costs.
std::string index_page(const FarmData& farm, const std::vector<CellSummary>& cells, bool has_cost);

/// The grid as thumbnails, a table for each section (index_grid.cpp).
void write_grid(Html& html, const FarmData& farm, const std::vector<CellSummary>& cells);

}  // namespace lobelia::gallery
