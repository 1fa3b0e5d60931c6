// The page of one cell.
#pragma once

#include <string>

#include "gallery/cell_data.hpp"

namespace lobelia::gallery {

std::string cell_page(const FarmData& farm, const CellEntry& entry, const CellData& cell);

}  // namespace lobelia::gallery
