// The page of one cell.
#pragma once

#include <string>

#include "gallery/cell_data.hpp"
#include "gallery/page.hpp"

namespace lobelia::gallery {

inline constexpr char kCellData[] = "data.js";  ///< beside the page

std::string cell_page(const SiteFrame& site, const FarmData& farm, const CellEntry& entry,
                      const CellData& cell);

}  // namespace lobelia::gallery
