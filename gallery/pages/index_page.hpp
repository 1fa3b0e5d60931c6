// The index: an introduction, the grid, and how it was made.
#pragma once

#include <functional>
#include <map>
#include <span>

#include "gallery/cells/history.hpp"
#include "gallery/pages/page.hpp"

namespace lobelia::gallery {

inline constexpr char kGridData[] = "grid.data.js";

struct EngineFigure {
  std::string engine;  ///< short title
  std::string worst;   ///< "0.049 %", or a word for why there is none
  std::string note;    ///< "2 px": pixels beyond the tolerance, if any
};

/// The comparison of a cell that is nearest to the limit of its largest difference, or farthest beyond it.
struct NearestToLimit {
  std::string engine;                ///< empty: there is none
  double difference = 0, limit = 0;  ///< shares of the peak
  Picture picture;                   ///< of the difference
  double share() const { return limit > 0 ? difference / limit : 0; }
};

/// A cell as the index shows it.
struct CellSummary {
  const CellEntry* entry = nullptr;
  CellStatus status = CellStatus::kMissing;
  bool is_as_written = true;          ///< no flaw, no contradiction, and sealed
  Picture picture;                    ///< the hub's
  int place = -1;                     ///< in the order of a packed site's files
  std::vector<Picture> beside;        ///< of a report: each other's, followed by the difference
  std::vector<EngineFigure> figures;  ///< one per available reference engine
  std::vector<std::string> reasons;   ///< why it is not a pass
  /// By each engine that was compared with ours: all metrics but coordinates.
  records::Named<records::Named<double>> metrics;
  records::Named<records::Named<double>> limits;  ///< likewise, of those that have one
  NearestToLimit nearest;
  std::optional<CellChange> change;  ///< since the baseline, if there is one
};

CellSummary summarise(const ShownFarm& farm, const CellEntry& entry, const CheckedCell& cell);
/// Looks the cell up in the earlier runs, lets `write` write its page, and summarises it. The history is empty without an
/// earlier run.
CellSummary publish_with_history(const ShownFarm& farm, const History& history,
                                 const CellEntry& entry, const CheckedCell& cell,
                                 const std::function<void(std::optional<CellHistory>&)>& write);

// `cells` are in the order of farm.cells.

/// The input of the page's script. The columns of a large grid are to be files, by their names.
struct GridData {
  records::GridPage page;
  std::map<std::string, records::GridColumns> columns;
};
GridData grid_data(const ShownFarm& farm, const std::vector<CellSummary>& cells);
void write_cell_link(Html& html, const SiteFrame& site, const CellEntry& entry);

/// How many entries of a list are shown, and how many more can be unfolded.
inline constexpr std::size_t kMaxShown = 6, kMaxFolded = 200;
/// `write` gets the first of `all`, and in an element to unfold those after them.
template <class T, class Write>
void write_folded(Html& html, const std::vector<T>& all, const Write& write) {
  const std::span<const T> items = all;
  if (items.empty()) return;
  write(items.first(std::min(items.size(), kMaxShown)));
  if (items.size() <= kMaxShown) return;
  const auto rest = items.subspan(kMaxShown);
  const Tag details(html, "details");
  html.element(
      "summary",
      std::to_string(rest.size()) + " more" +
          (rest.size() > kMaxFolded ? ", of which here are " + std::to_string(kMaxFolded) : ""));
  write(rest.first(std::min(rest.size(), kMaxFolded)));
}

/// A view's finding, in a sentence.
struct Finding {
  PageLink page;
  std::string sentence;
};
std::string index_page(const SiteFrame& site, const ShownFarm& farm,
                       const std::vector<CellSummary>& cells, const std::vector<Finding>& findings,
                       const History& history);
/// The grid without script: a list of all cells (index_grid.cpp).
void write_grid(Html& html, const SiteFrame& site, const ShownFarm& farm,
                const std::vector<CellSummary>& cells);

}  // namespace lobelia::gallery
