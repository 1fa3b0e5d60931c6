// What the script of a cell's page is given: gallery/web/src/cell_data.ts is the same as a type.
#pragma once

#include "gallery/cell_data.hpp"

namespace lobelia::gallery {

Json cell_json(const FarmData& farm, const CellEntry& entry, const CellData& cell);

}  // namespace lobelia::gallery
