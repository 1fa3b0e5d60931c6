// Writes what changed since an earlier run, on a cell's page and on the index.
#pragma once

#include "gallery/cells/history.hpp"
#include "gallery/pages/index_page.hpp"

namespace lobelia::gallery {

/// "Worse than on 2026-11-20 (nightly): POV-Ray: pass became differs."
std::string change_sentence(const History& history, const CellChange& change);
/// Then and now: statuses, metrics, pictures and timelines.
void write_cell_changes(Html& html, const ShownFarm& farm, const History& history,
                        const CheckedCell& cell, const CellHistory& past);
void write_timeline(Html& html, const ShownFarm& farm, const Timeline& line);

/// "Since 2026-11-20 (nightly): 3 cells are worse, 1 is better, 105 are as before."
std::string summary_of_changes(const History& history, const std::vector<CellSummary>& cells);
/// That sentence, what is worse and better, and what is gone.
void write_changes(Html& html, const SiteFrame& site, const History& history,
                   const std::vector<CellSummary>& cells);

}  // namespace lobelia::gallery
