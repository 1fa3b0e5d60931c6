// The page of one cell, and its sections in the order in which they stand on it.
#pragma once

#include "gallery/cells/history.hpp"
#include "gallery/pages/page.hpp"

namespace lobelia::gallery {

using records::kAnalytic;

inline constexpr char kCellData[] = "data.js";  ///< beside the page

/// The content of the page's <main>. `past` is set if there is an earlier run.
Html cell_main(const SiteFrame& site, const ShownFarm& farm, const CellEntry& entry,
               const CheckedCell& cell, const History& history,
               const std::optional<CellHistory>& past);
std::string cell_page(const SiteFrame& site, const ShownFarm& farm, const CellEntry& entry,
                      const CheckedCell& cell, const History& history,
                      const std::optional<CellHistory>& past);
/// The input of the page's script. `before` is the cell in an earlier run, or null.
records::CellPage cell_page_data(const ShownFarm& farm, const CellEntry& entry,
                                 const CheckedCell& cell, const CheckedCell* before);

/// The engines' pictures side by side, and below each its difference from ours.
void write_pictures(Html& html, const ShownFarm& farm, const CheckedCell& cell);
/// The highlight as curves, and as figures.
void write_profile(Html& html, const SiteFrame& site, const ShownFarm& farm,
                   const CheckedCell& cell);
/// Every metric of every comparison, with limits and verdict.
void write_numbers(Html& html, const ShownFarm& farm, const CheckedCell& cell);
/// Which effects were simulated, and why the others were not.
void write_plan(Html& html, const CheckedCell& cell);
/// Commands, versions, times and files of each picture.
void write_making(Html& html, const SiteFrame& site, const ShownFarm& farm,
                  const CheckedCell& cell);

/// "Largest difference: 2 %, limit 1 %" for each limit that does not hold.
std::vector<std::string> broken_limits(const ShownFarm& farm, const CheckedComparison& comparison);
/// By metric. A tolerance of pixels is a limit, too: of the largest difference, at the peak.
records::Named<double> limits_of(const records::Comparison& comparison);
/// The largest difference, where it is and what explains it, as far as the record knows; may be empty.
std::string story_of(const CheckedComparison& comparison, const std::string& engine);
/// "✓ pass", or why there is no verdict.
std::string verdict_words(const CheckedComparison& comparison);
/// The zones of a highlight, from the middle outward.
std::vector<records::ShownZone> zones_of(const records::Profile& profile);

}  // namespace lobelia::gallery
