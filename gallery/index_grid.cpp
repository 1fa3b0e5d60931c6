#include <fmt/format.h>

#include "gallery/index_page.hpp"

namespace lobelia::gallery {
namespace {

class GridWriter {
 public:
  GridWriter(Html& html, const SiteFrame& site, const ShownFarm& farm,
             const std::vector<CellSummary>& cells)
      : html_(html), site_(site), farm_(farm), cells_(cells) {}

  void write() {
    const Tag place(html_, "div", {{"id", "grid"}, {"class", "grid-place"}});
    // The script draws the grid. Where it runs, thousands of cells are one text here, and no elements.
    const Tag without_script(html_, "noscript");
    if (!site_.is_packed) return write_list();
    html_.element("p", fmt::format("The grid of all {}s, their pictures and their pages need the "
                                   "script: allow scripts to see them.",
                                   farm_.noun()));
  }

 private:
  void write_list() {
    const Tag outer(html_, "section",
                    {{"class", "grid-section"}, {"aria-labelledby", "grid-list"}});
    html_.element("h2", {{"id", "grid-list"}}, fmt::format("All {}s", farm_.noun()));
    const Tag list(html_, "ul", {{"class", "cell-list"}});
    for (const CellSummary& cell : cells_) {
      const StatusInfo status = farm_.words_of(cell.status);
      const Tag item(html_, "li", {{"data-status", std::string(status.name)}});
      const std::string href = cell_link(site_, cell.entry->id);
      {
        const Tag link(html_, "a", {{"href", href}, {"class", "pictures-beside"}});
        write_picture(cell, cell.picture);
        for (const Picture& picture : cell.beside) write_picture(cell, picture);
      }
      html_.element("a", {{"href", href}, {"class", "cell-name"}}, cell.entry->title());
      html_.text(" ");
      write_status(html_, status);
      write_change(cell);
      write_figures(cell);
    }
  }

  void write_change(const CellSummary& cell) {
    if (!cell.change || cell.change->change == Change::kSame) return;
    const ChangeInfo& change = info(cell.change->change);
    html_.text(" ");
    write_badge(html_, change.name, change.mark, change.word);
  }

  void write_picture(const CellSummary& cell, const Picture& picture) {
    if (!picture.shown()) return;
    const SmallPicture small = picture.preview();
    html_.empty("img", {{"src", link_to({"cells", cell.entry->id, small.file})},
                        {"alt", ""},
                        {"width", std::to_string(small.width)},
                        {"height", std::to_string(small.height)},
                        {"loading", "lazy"},
                        {"decoding", "async"}});
  }

  void write_figures(const CellSummary& cell) {
    for (const EngineFigure& figure : cell.figures) {
      const Tag line(html_, "span", {{"class", "worst"}});
      html_.element("span", figure.engine);
      html_.element("span", figure.worst + (figure.note.empty() ? "" : ","));
      if (!figure.note.empty()) html_.element("span", figure.note);
    }
  }

  Html& html_;
  const SiteFrame& site_;
  const ShownFarm& farm_;
  const std::vector<CellSummary>& cells_;
};

}  // namespace

void write_grid(Html& html, const SiteFrame& site, const ShownFarm& farm,
                const std::vector<CellSummary>& cells) {
  GridWriter(html, site, farm, cells).write();
}

}  // namespace lobelia::gallery
