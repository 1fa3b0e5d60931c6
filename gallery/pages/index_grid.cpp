#include <fmt/format.h>

#include "gallery/pages/index_page.hpp"

namespace lobelia::gallery {
namespace {

void write_picture(Html& html, const CellSummary& cell, const Picture& picture) {
  if (!picture.shown()) return;
  const SmallPicture small = picture.preview();
  html.empty("img", {{"src", link_to({"cells", cell.entry->id, small.file})},
                     {"alt", ""},
                     {"width", std::to_string(small.width)},
                     {"height", std::to_string(small.height)},
                     {"loading", "lazy"},
                     {"decoding", "async"}});
}

void write_cell(Html& html, const SiteFrame& site, const ShownFarm& farm, const CellSummary& cell) {
  const StatusInfo status = farm.words_of(cell.status);
  const Tag item(html, "li", {{"data-status", std::string(status.name)}});
  const std::string href = cell_link(site, cell.entry->id);
  {
    const Tag link(html, "a", {{"href", href}, {"class", "pictures-beside"}});
    write_picture(html, cell, cell.picture);
    for (const Picture& picture : cell.beside) write_picture(html, cell, picture);
  }
  html.element("a", {{"href", href}, {"class", "cell-name"}}, cell.entry->title());
  html.text(" ");
  write_status(html, status);
  if (cell.change && cell.change->change != Change::kSame) {
    const ChangeInfo& change = info(cell.change->change);
    html.text(" ");
    write_badge(html, change.name, change.mark, change.word);
  }
  for (const EngineFigure& figure : cell.figures) {
    const Tag line(html, "span", {{"class", "worst"}});
    html.element("span", figure.engine);
    html.element("span", figure.worst + (figure.note.empty() ? "" : ","));
    if (!figure.note.empty()) html.element("span", figure.note);
  }
}

}  // namespace

void write_grid(Html& html, const SiteFrame& site, const ShownFarm& farm,
                const std::vector<CellSummary>& cells) {
  const Tag place(html, "div", {{"id", "grid"}, {"class", "grid-place"}});
  // The script draws the grid. Where it runs, thousands of cells are one text here, and no elements.
  const Tag without_script(html, "noscript");
  if (site.is_packed)
    return html.element("p", fmt::format("The grid of all {}s, their pictures and their pages need "
                                         "the script: allow scripts to see them.",
                                         farm.noun()));
  const Tag outer(html, "section", {{"class", "grid-section"}, {"aria-labelledby", "grid-list"}});
  html.element("h2", {{"id", "grid-list"}}, fmt::format("All {}s", farm.noun()));
  const Tag list(html, "ul", {{"class", "cell-list"}});
  for (const CellSummary& cell : cells) write_cell(html, site, farm, cell);
}

}  // namespace lobelia::gallery
