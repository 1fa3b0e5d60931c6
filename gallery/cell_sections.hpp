// The parts of a cell's page, in the order in which they stand on it.
#pragma once

#include "core/html.hpp"
#include "gallery/cell_data.hpp"

namespace lobelia::gallery {

/// The engines' pictures side by side, and below each its difference from ours.
void write_pictures(Html& html, const FarmData& farm, const CellData& cell);
/// The highlight as curves, and as figures.
void write_profile(Html& html, const FarmData& farm, const CellData& cell);
/// Every metric of every comparison, with limits and verdict.
void write_numbers(Html& html, const FarmData& farm, const CellData& cell);
/// Which effects were simulated, and why the others were not.
void write_plan(Html& html, const CellData& cell);
/// Commands, versions, times and files of each picture.
void write_making(Html& html, const FarmData& farm, const CellData& cell);

/// "✓ pass", or why there is none.
std::string verdict_words(const CellComparison& comparison);

}  // namespace lobelia::gallery
