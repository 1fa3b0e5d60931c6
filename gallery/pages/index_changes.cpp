#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "gallery/cells/cell_changes.hpp"

namespace lobelia::gallery {
namespace {

std::vector<const CellSummary*> cells_that_are(Change change,
                                               const std::vector<CellSummary>& cells) {
  std::vector<const CellSummary*> result;
  for (const CellSummary& cell : cells)
    if (cell.change && cell.change->change == change) result.push_back(&cell);
  return result;
}

void write_changed(Html& html, const SiteFrame& site, std::span<const CellSummary* const> cells) {
  const Tag list(html, "ul");
  for (const CellSummary* cell : cells) {
    const Tag item(html, "li");
    const ChangeInfo& change = info(cell->change->change);
    write_badge(html, change.name, change.mark, change.word);
    html.text(" ");
    write_cell_link(html, site, *cell->entry);
    html.element("small", cell->change->reason);
  }
}

void write_gone(Html& html, std::span<const CellEntry* const> cells) {
  const Tag list(html, "ul");
  for (const CellEntry* cell : cells) {
    const Tag item(html, "li");
    html.text(cell->title() + ", which was ");
    write_status(html, info(cell->status));
  }
}

}  // namespace

std::string summary_of_changes(const History& history, const std::vector<CellSummary>& cells) {
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, std::string_view one, std::string_view many,
                       std::string_view words) {
    if (count == 0) return;
    const std::string_view noun = !parts.empty() ? "" : count == 1 ? " cell" : " cells";
    parts.push_back(fmt::format("{}{} {} {}", count, noun, count == 1 ? one : many, words));
  };
  const auto count = [&](Change change) { return cells_that_are(change, cells).size(); };
  add(count(Change::kWorse), "is", "are", "worse");
  add(count(Change::kBetter), "is", "are", "better");
  add(count(Change::kNew), "is", "are", "new");
  add(history.gone().size(), "is", "are", "gone");
  add(count(Change::kUnknown), "cannot", "cannot", "be compared");
  add(count(Change::kSame), "is", "are", "as before");
  return fmt::format(
      "Since {}: {}.", history.since(),
      parts.empty() ? "there are no cells" : fmt::format("{}", fmt::join(parts, ", ")));
}

void write_changes(Html& html, const SiteFrame& site, const History& history,
                   const std::vector<CellSummary>& cells) {
  const Tag section(html, "section",
                    {{"class", "attention changes"}, {"aria-labelledby", "changes"}});
  html.element("h2", {{"id", "changes"}}, "What changed");
  html.element("p", {{"class", "since"}}, summary_of_changes(history, cells));
  for (const Change change : {Change::kWorse, Change::kUnknown, Change::kBetter})
    write_folded(html, cells_that_are(change, cells),
                 [&](auto some) { write_changed(html, site, some); });
  const auto gone = history.gone();
  if (gone.empty()) return;
  html.element("h3", "Gone");
  write_folded(html, gone, [&](auto some) { write_gone(html, some); });
}

}  // namespace lobelia::gallery
