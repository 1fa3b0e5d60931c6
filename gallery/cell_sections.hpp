// The parts of a cell's page, in the order in which they stand on it.
#pragma once

#include "core/html.hpp"
#include "gallery/checked_cell.hpp"

namespace lobelia::gallery {

/// The engines' pictures side by side, and below each its difference from ours.
void write_pictures(Html& html, const ShownFarm& farm, const CheckedCell& cell);
/// The highlight as curves, and as figures.
void write_profile(Html& html, const ShownFarm& farm, const CheckedCell& cell);
/// Every metric of every comparison, with limits and verdict.
void write_numbers(Html& html, const ShownFarm& farm, const CheckedCell& cell);
/// Which effects were simulated, and why the others were not.
void write_plan(Html& html, const CheckedCell& cell);
/// Commands, versions, times and files of each picture.
void write_making(Html& html, const ShownFarm& farm, const CheckedCell& cell);

/// "✓ pass", or why there is none.
std::string verdict_words(const CheckedComparison& comparison);

}  // namespace lobelia::gallery
