#include "gallery/cells/cell_page.hpp"
#include "gallery/cells/cell_changes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/records/words.hpp"
#include "base/words/numbers.hpp"
#include "gallery/pages/views.hpp"

namespace lobelia::gallery {
namespace {

constexpr int kShownEachSide = 5;  // values of a long axis before and after the cell's own

std::string neighbour_link(const SiteFrame& site, const CellEntry& cell) {
  return site.is_packed ? cell_link(site, cell.id) : "../" + link_to({cell.id, "index.html"});
}

const CellEntry* cell_beside(const ShownFarm& farm, const CellEntry& entry, int axis, int value) {
  if (value < 0 || value >= static_cast<int>(farm.record.axes[axis].values.size())) return nullptr;
  std::vector<int> at = entry.at;
  at[axis] = value;
  return farm.find_cell(at);
}

void write_step(Html& html, const SiteFrame& site, const ShownFarm& farm, const CellEntry& entry,
                int axis, int step) {
  const std::string arrow = step < 0 ? "←" : "→";
  const CellEntry* cell = cell_beside(farm, entry, axis, entry.at[axis] + step);
  if (!cell) return html.element("span", {{"class", "step"}, {"aria-hidden", "true"}}, arrow);
  const std::string words = (step < 0 ? "Previous " : "Next ") + farm.record.axes[axis].name +
                            ": " + farm.record.axes[axis].values[cell->at[axis]].label;
  html.element("a",
               {{"class", "step"},
                {"href", neighbour_link(site, *cell)},
                {"rel", step < 0 ? "prev" : "next"},
                {"aria-label", words},
                {"title", words}},
               arrow);
}

void write_axis(Html& html, const SiteFrame& site, const ShownFarm& farm, const CellEntry& entry,
                int axis) {
  const records::Axis& a = farm.record.axes[axis];
  const int here = entry.at[axis];
  const Tag row(html, "div", {{"class", "axis-row"}});
  html.element("span", {{"class", "axis-name"}}, a.name);
  write_step(html, site, farm, entry, axis, -1);
  write_step(html, site, farm, entry, axis, +1);
  const Tag list(html, "ul");
  const int count = static_cast<int>(a.values.size());
  const int from = std::max(0, here - kShownEachSide),
            to = std::min(count, here + kShownEachSide + 1);
  for (int value = from; value < to; ++value) {
    const Tag item(html, "li");
    const CellEntry* cell = cell_beside(farm, entry, axis, value);
    if (value == here) {
      html.element("span", {{"aria-current", "true"}}, a.values[value].label);
    } else if (cell) {
      html.element("a", {{"href", neighbour_link(site, *cell)}}, a.values[value].label);
    } else {
      html.element("span", {{"class", "absent"}}, a.values[value].label);
    }
  }
}

void write_navigation(Html& html, const SiteFrame& site, const ShownFarm& farm,
                      const CellEntry& entry) {
  const Tag nav(html, "nav", {{"class", "axes"}, {"aria-label", "Neighbouring cells"}});
  for (int axis = 0; axis < static_cast<int>(farm.record.axes.size()); ++axis)
    if (entry.at[axis] >= 0) write_axis(html, site, farm, entry, axis);
}

std::string time_text(const EnginePicture* image) {
  if (image && image->render) return seconds_text(image->render->seconds.total);
  return image && image->reference ? seconds_text(image->reference->seconds.total) : "–";
}

/// The difference of each picture from ours, in the figure that the grid shows too, and its time.
void write_agreement(Html& html, const ShownFarm& farm, const CheckedCell& cell) {
  constexpr char kFigure[] = "max_rel_peak";
  if (cell.comparisons.empty()) return;
  const Tag table(html, "table", {{"class", "agreement"}});
  std::vector<std::string> columns = {"Picture", farm.metrics.info(kFigure).title, "Verdict"};
  if (!farm.is_report) columns.emplace_back("Time");
  write_columns(html, columns);
  const Tag body(html, "tbody");
  for (const CheckedComparison& comparison : cell.comparisons) {
    const Tag row(html, "tr");
    const std::string& other = cell.other_of(comparison);
    html.element("th", {{"scope", "row"}}, farm.engine_title(other));
    const auto worst = comparison.metric(kFigure);
    html.element("td", {{"class", "number"}}, worst ? farm.metrics.text(kFigure, *worst) : "–");
    std::string words = verdict_words(comparison);
    if (const double outliers = comparison.metric("outliers").value_or(0); outliers > 0)
      words += ", " + count_text(outliers) + " px beyond the tolerance";
    html.element("td", words);
    if (!farm.is_report) html.element("td", time_text(cell.find_image(other)));
  }
  if (farm.is_report) return;
  const Tag row(html, "tr");
  html.element("th", {{"scope", "row"}}, farm.engine_title(farm.hub));
  html.element("td", {{"class", "number"}}, "–");
  html.element("td", "ours");
  html.element("td", time_text(cell.find_image(farm.hub)));
}

/// Lists each file that is not as the farm wrote it.
void write_flaws(Html& html, const ShownFarm& farm, const CheckedCell& cell) {
  if (!cell.flaws.empty()) {
    const Tag list(html, "ul", {{"class", "flaws"}});
    for (const Flaw& flaw : cell.flaws) {
      const Tag item(html, "li");
      write_status(html, info(flaw.status));
      html.text(" ");
      html.text(flaw.message);
    }
  }
  for (const std::string& sentence : cell.contradictions) html.element("p", sentence);
  const bool to_be_made_again = is_flaw(cell.status) || cell.status == CellStatus::kUnsealed;
  if (!to_be_made_again || farm.record.command.empty()) return;
  html.element("p",
               "No verdict is shown for what cannot be checked. To make the cell whole again:");
  write_command(html, farm.record.command);
}

/// Why each comparison came out as it did.
void write_stories(Html& html, const ShownFarm& farm, const CheckedCell& cell) {
  if (farm.is_report || cell.comparisons.empty()) return;
  const Tag list(html, "ul", {{"class", "stories"}});
  for (const CheckedComparison& comparison : cell.comparisons) {
    const std::string engine = farm.engine_title(cell.other_of(comparison));
    const std::string story = story_of(comparison, engine);
    if (story.empty()) continue;
    const Tag item(html, "li");
    html.element("strong", engine);
    html.text(" " + story);
  }
}

/// Each highlight's difference in an artist's words, and the limits that are broken.
void write_findings(Html& html, const ShownFarm& farm, const CheckedCell& cell) {
  for (const CheckedComparison& comparison : cell.comparisons) {
    if (!comparison.sentence.empty())
      html.element("p", {{"class", "finding"}}, comparison.sentence + ".");
    if (!farm.is_report) continue;
    for (const std::string& reason : broken_limits(farm, comparison)) html.element("p", reason);
  }
}

/// One line; the section below has the rest.
void write_change(Html& html, const History& history, const CellHistory& past) {
  const Tag line(html, "p");
  const ChangeInfo& change = info(past.change.change);
  {
    const Tag mark(html, "span", {{"class", fmt::format("status {}", change.name)}});
    html.element("span", {{"aria-hidden", "true"}}, change.mark);
  }
  html.text(" " + change_sentence(history, past.change) + " ");
  html.element("a", {{"href", "#changes"}}, "What changed");
}

void write_verdict(Html& html, const ShownFarm& farm, const CheckedCell& cell,
                   const History& history, const std::optional<CellHistory>& past) {
  const Tag box(html, "div", {{"class", "verdict " + std::string(info(cell.status).name)}});
  {
    const Tag line(html, "p");
    write_status(html, farm.words_of(cell.status));
    html.text(" ");
    html.text(farm.words_of(cell.status).meaning);
  }
  if (past) write_change(html, history, *past);
  if (!cell.unreadable.empty()) html.element("p", cell.unreadable);
  write_flaws(html, farm, cell);
  write_findings(html, farm, cell);
  write_agreement(html, farm, cell);
  for (const records::CellProblem& problem : cell.record.problems) {
    const Tag line(html, "p");
    if (!problem.engine.empty()) html.element("strong", farm.engine_title(problem.engine) + ": ");
    html.text(problem.message);
  }
  for (const records::NotComparable& one : cell.record.not_comparable) {
    const Tag line(html, "p");
    html.element("strong", farm.engine_title(one.engine) + ": ");
    html.text("not comparable, because " + one.because + ".");
  }
  if (cell.status == CellStatus::kMissing && !farm.record.command.empty()) {
    html.element("p", "The same command takes the farm up again where it stopped:");
    write_command(html, farm.record.command);
  }
}

void write_highlight(Html& html, const SiteFrame& site, const CheckedCell& cell) {
  if (!cell.record.highlight) return;
  const records::Highlight& highlight = *cell.record.highlight;
  {
    const Tag list(html, "dl", {{"class", "facts"}});
    for (const auto& [name, value] : words_of(highlight)) write_fact(html, name, value);
  }
  // The explorer has no lobes by a formula.
  const std::string explorer(explorer_view.file);
  if (!highlight.formula.empty() || !std::ranges::count(site.pages, explorer, &PageLink::file))
    return;
  const Tag line(html, "p");
  html.element("a",
               {{"href", fmt::format("{}{}#model={}&lobe={}&norm={}&n={}&two=0",
                                     site.is_packed ? "" : "../../", explorer,
                                     link_to({highlight.model}), link_to({highlight.lobe}),
                                     link_to({highlight.normalisation}), highlight.exponent)}},
               "Open in the explorer");
}

}  // namespace

Html cell_main(const SiteFrame& site, const ShownFarm& farm, const CellEntry& entry,
               const CheckedCell& cell, const History& history,
               const std::optional<CellHistory>& past) {
  Html html;
  if (cell.has_record)
    html.element("a", {{"class", "skip"}, {"href", "#pictures"}}, "Skip to the pictures");
  html.element("h1", entry.title());
  {
    // On a phone in this order; on a desktop the pictures are below the rest (style/cell.css).
    const Tag top(html, "div", {{"class", "cell-top"}});
    write_navigation(html, site, farm, entry);
    if (cell.has_record) write_pictures(html, farm, cell);
    {
      const Tag verdict(html, "div", {{"class", "judgement"}});
      write_verdict(html, farm, cell, history, past);
    }
    const Tag why(html, "div", {{"class", "why"}});
    write_highlight(html, site, cell);
    write_stories(html, farm, cell);
  }
  if (past) write_cell_changes(html, farm, history, cell, *past);
  if (cell.has_record) {
    if (!farm.is_report) write_profile(html, site, farm, cell);
    write_numbers(html, farm, cell);
    if (!farm.is_report) write_plan(html, cell);
  }
  write_making(html, site, farm, cell);
  return html;
}

std::string cell_page(const SiteFrame& site, const ShownFarm& farm, const CellEntry& entry,
                      const CheckedCell& cell, const History& history,
                      const std::optional<CellHistory>& past) {
  const std::string folder = link_to({"cells", entry.id}) + "/";
  const EnginePicture* ours = cell.find_image(farm.hub);
  const PageFrame frame{entry.title(),
                        "cell",
                        "../../",
                        folder + "index.html",
                        cell.made_by.empty() ? farm.made_by : cell.made_by,
                        kCellData,
                        ours && ours->png.shown() ? folder + link_to({ours->png.file}) : ""};
  return finish_page(site, frame, cell_main(site, farm, entry, cell, history, past));
}

}  // namespace lobelia::gallery
