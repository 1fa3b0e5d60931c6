// What the script of the grid's page is given: gallery/web/src/grid_data.ts is the same as a type.
#pragma once

#include <vector>

#include "gallery/cell_summary.hpp"

namespace lobelia::gallery {

/// `cells` in the order of farm.cells.
Json grid_json(const FarmData& farm, const std::vector<CellSummary>& cells);

}  // namespace lobelia::gallery
