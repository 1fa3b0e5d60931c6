// What the scripts of the grid's and of a cell's page are given.
#pragma once

#include <vector>

#include "gallery/cell_summary.hpp"
#include "records/pages.hpp"

namespace lobelia::gallery {

/// `cells` in the order of farm.cells.
records::GridPage grid_page_data(const ShownFarm& farm, const std::vector<CellSummary>& cells);

records::CellPage cell_page_data(const ShownFarm& farm, const CellEntry& entry,
                                 const CheckedCell& cell);

}  // namespace lobelia::gallery
