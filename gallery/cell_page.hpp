// The page of one cell.
#pragma once

#include <string>

#include "gallery/checked_cell.hpp"
#include "gallery/page.hpp"

namespace lobelia::gallery {

inline constexpr char kCellData[] = "data.js";  ///< beside the page

std::string cell_page(const SiteFrame& site, const ShownFarm& farm, const CellEntry& entry,
                      const CheckedCell& cell);

}  // namespace lobelia::gallery
