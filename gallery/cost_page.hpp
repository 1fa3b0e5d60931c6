// What accuracy costs in time, as a page: a chart and a table for each thing that was measured.
#pragma once

#include <string>

#include "gallery/cost_data.hpp"

namespace lobelia::gallery {

std::string cost_page(const CostData& cost);
/// In place of it, why there is none.
std::string absent_cost_page(const std::string& why);

}  // namespace lobelia::gallery
