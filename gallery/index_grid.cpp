#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "gallery/grid_layout.hpp"
#include "gallery/index_page.hpp"

namespace lobelia::gallery {
namespace {

constexpr std::size_t kMostWorst = 200;

double largest_difference(const CellSummary& cell) {
  double largest = 0;
  for (const auto& [engine, metrics] : cell.metrics)
    if (const double* one = records::find(metrics, "max_rel_peak"))
      largest = std::max(largest, *one);
  return largest;
}

class GridWriter {
 public:
  GridWriter(Html& html, const SiteFrame& site, const ShownFarm& farm,
             const std::vector<CellSummary>& cells)
      : html_(html), site_(site), farm_(farm), cells_(cells), layout_(lay_out(farm)) {}

  void write() {
    const Tag place(html_, "div", {{"id", "grid"}, {"class", "grid-place"}});
    // The script draws the grid itself. Where it runs, thousands of cells are one text here, and no elements.
    const Tag without_script(html_, "noscript");
    if (site_.is_packed) return write_worst();
    if (is_list(farm_)) return write_list();
    for (std::size_t i = 0; i < layout_.sections.size(); ++i) write_section(i);
    write_rest();
  }

 private:
  const std::vector<records::AxisValue>& values(int axis) const {
    return farm_.record.axes[axis].values;
  }
  int groups() const { return axis_size(farm_, layout_.groups); }
  int columns() const { return axis_size(farm_, layout_.columns); }

  void write_section(std::size_t index) {
    const auto& section = layout_.sections[index];
    const std::string label = layout_.section_label(farm_, section);
    const std::string id = fmt::format("grid-{}", index + 1);
    const Tag outer(html_, "section", {{"class", "grid-section"}, {"aria-labelledby", id}});
    html_.element("h2", {{"id", id}}, label.empty() ? "The grid" : label);
    const Tag table(html_, "table", {{"class", "grid"}, {"aria-labelledby", id}});
    write_column_widths();
    write_head();
    const Tag body(html_, "tbody");
    for (int row = 0; row < axis_size(farm_, layout_.rows); ++row) write_row(section, row);
  }

  void write_column_widths() {
    const Tag group(html_, "colgroup");
    if (layout_.rows >= 0) html_.empty("col", {{"class", "heads"}});
    for (int i = 0; i < groups() * columns(); ++i) html_.empty("col", {{"class", "place"}});
  }

  void write_corner(const std::string& rowspan) {
    if (layout_.rows < 0) return;
    html_.element("th", {{"scope", "col"}, {"class", "corner"}, {"rowspan", rowspan}},
                  farm_.record.axes[layout_.rows].name);
  }

  void write_label(const std::string& axis, const std::string& label) {
    // "n = 16" names its axis; "16" does not.
    if (label.find('=') == std::string::npos) html_.element("small", axis + " ");
    html_.text(label);
  }

  void write_column_heads(int group) {
    const std::string& name = farm_.record.axes[layout_.columns].name;
    for (int column = 0; column < columns(); ++column) {
      const bool first = group > 0 && column == 0;
      const Tag head(html_, "th", {{"scope", "col"}, {"class", first ? "first" : "inner"}});
      write_label(name, values(layout_.columns)[column].label);
    }
  }

  void write_head() {
    const Tag thead(html_, "thead");
    if (layout_.groups >= 0) {
      const Tag line(html_, "tr", {{"class", "groups"}});
      write_corner("2");
      for (int group = 0; group < groups(); ++group) {
        const Tag head(html_, "th",
                       {{"scope", "colgroup"},
                        {"colspan", std::to_string(columns())},
                        {"class", group > 0 ? "first" : "inner"}});
        write_label(farm_.record.axes[layout_.groups].name, values(layout_.groups)[group].label);
      }
    }
    const Tag line(html_, "tr", {{"class", "columns"}});
    if (layout_.groups < 0) write_corner("1");
    for (int group = 0; group < groups(); ++group) write_column_heads(group);
  }

  void write_row(const std::vector<int>& section, int row) {
    const Tag line(html_, "tr");
    if (layout_.rows >= 0) html_.element("th", {{"scope", "row"}}, values(layout_.rows)[row].label);
    for (int group = 0; group < groups(); ++group)
      for (int column = 0; column < columns(); ++column)
        write_place(farm_.find_cell(layout_.position(section, row, group, column)),
                    group > 0 && column == 0 ? " first" : "");
  }

  void write_place(const CellEntry* entry, const std::string& side) {
    if (!entry) return html_.element("td", {{"class", "none" + side}}, "not in this farm");
    const CellSummary& cell = cells_[entry - farm_.cells.data()];
    const std::string_view status = info(cell.status).name;
    const Tag place(html_, "td",
                    {{"class", fmt::format("cell {}{}", status, side)},
                     {"data-status", std::string(status)},
                     {"data-text", entry->label + " " + entry->id}});
    write_cell(cell);
  }

  void write_cell(const CellSummary& cell) {
    const std::string words =
        cell.entry->label + ": " + std::string(farm_.words_of(cell.status).word);
    {
      const Tag link(html_, "a", {{"href", cell_link(site_, cell.entry->id)}});
      write_picture(cell, cell.picture, words);
      if (!cell.picture.shown()) {
        html_.element("span", {{"class", "no-picture"}, {"aria-label", words + ", no picture"}},
                      "no picture");
      }
    }
    write_status(html_, farm_.words_of(cell.status));
    write_change(cell);
    write_figures(cell);
  }

  void write_change(const CellSummary& cell) {
    if (!cell.change || cell.change->change == Change::kSame) return;
    const ChangeInfo& change = info(cell.change->change);
    html_.text(" ");
    write_badge(html_, change.name, change.mark, change.word);
  }

  /// The whole grid as a list, the worst first.
  void write_list() {
    const Tag outer(html_, "section",
                    {{"class", "grid-section"}, {"aria-labelledby", "grid-list"}});
    html_.element("h2", {{"id", "grid-list"}}, fmt::format("All {}s", farm_.noun()));
    const Tag list(html_, "ul", {{"class", "cell-list"}});
    for (const CellSummary& cell : cells_) {
      const Tag item(html_, "li");
      const std::string href = cell_link(site_, cell.entry->id);
      {
        const Tag link(html_, "a", {{"href", href}, {"class", "pictures-beside"}});
        write_picture(cell, cell.picture, "");
        for (const Picture& picture : cell.beside) write_picture(cell, picture, "");
      }
      html_.element("a", {{"href", href}, {"class", "cell-name"}}, cell.entry->label);
      html_.text(" ");
      write_status(html_, farm_.words_of(cell.status));
      write_change(cell);
      write_figures(cell);
    }
  }

  /// In words, because a cell's page and its pictures need the script.
  void write_worst() {
    using Rank = std::tuple<int, double, std::ptrdiff_t>;
    std::vector<Rank> ranks;
    for (const CellSummary& cell : cells_)
      ranks.emplace_back(rank_of(cell.status), -largest_difference(cell), &cell - cells_.data());
    const std::size_t count = std::min(ranks.size(), kMostWorst);
    std::ranges::partial_sort(ranks, ranks.begin() + std::ptrdiff_t(count));
    ranks.resize(count);
    const Tag outer(html_, "section", {{"class", "grid-section"}, {"aria-labelledby", "worst"}});
    html_.element("h2", {{"id", "worst"}},
                  fmt::format("The worst {} of {} {}s", count, cells_.size(), farm_.noun()));
    html_.element(
        "p",
        fmt::format(
            "The grid of all {}s, their pictures and their pages need the script: allow scripts to see them.",
            farm_.noun()));
    const Tag list(html_, "ul");
    for (const auto& [status, difference, place] : ranks) {
      const CellSummary& cell = cells_[std::size_t(place)];
      const Tag item(html_, "li");
      write_status(html_, farm_.words_of(cell.status));
      html_.text(" " + cell.entry->title() + " ");
      write_figures(cell);
    }
  }

  void write_picture(const CellSummary& cell, const Picture& picture, const std::string& words) {
    if (!picture.shown()) return;
    const SmallPicture small = picture.preview();
    html_.empty("img", {{"src", link_to({"cells", cell.entry->id, small.file})},
                        {"alt", words},
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

  void write_rest() {
    const auto rest = cells_without_place(farm_);
    if (rest.empty()) return;
    const Tag outer(html_, "section", {{"aria-labelledby", "rest"}});
    html_.element("h2", {{"id", "rest"}}, "Cells that have no place on the axes");
    const Tag list(html_, "ul");
    for (const CellEntry* entry : rest) {
      const Tag item(html_, "li");
      html_.element("a", {{"href", cell_link(site_, entry->id)}}, entry->id);
      html_.text(" ");
      write_status(html_, farm_.words_of(cells_[entry - farm_.cells.data()].status));
    }
  }

  Html& html_;
  const SiteFrame& site_;
  const ShownFarm& farm_;
  const std::vector<CellSummary>& cells_;
  const GridLayout layout_;
};

}  // namespace

void write_grid(Html& html, const SiteFrame& site, const ShownFarm& farm,
                const std::vector<CellSummary>& cells) {
  GridWriter(html, site, farm, cells).write();
}

}  // namespace lobelia::gallery
