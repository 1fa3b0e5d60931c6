#include "gallery/cells/cell_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "base/records/words.hpp"
#include "base/words/numbers.hpp"

namespace lobelia::gallery {
namespace {

constexpr std::size_t kMaxReasons = 3;  // per cell; its page has them all

/// "POV-Ray and Blender Cycles"
std::string reference_titles(const ShownFarm& farm) {
  std::vector<std::string> titles;
  for (const records::FarmEngine& engine : farm.record.engines)
    if (engine.name != farm.hub && engine.available) titles.push_back(engine.title);
  if (titles.empty()) return "";
  const std::string last = titles.back();
  titles.pop_back();
  return titles.empty() ? last : fmt::format("{} and {}", fmt::join(titles, ", "), last);
}

void write_counts(Html& html, const ShownFarm& farm, const std::vector<CellSummary>& cells) {
  const Tag list(html, "ul", {{"class", "counts"}});
  const auto write = [&](std::size_t count, const std::string& words) {
    const Tag item(html, "li");
    html.element("strong", count_text(double(count)));
    html.text(" " + words);
  };
  if (farm.is_report) {
    for (const auto& [count, words] : farm.counts) write(count, words);
    return;
  }
  write(cells.size(), fmt::format("{}{}", farm.noun(), cells.size() == 1 ? "" : "s"));
  for (const CellStatus status : kCellStatuses) {
    const auto count = std::ranges::count(cells, status, &CellSummary::status);
    if (count == 0 && status != CellStatus::kPass) continue;
    const Tag item(html, "li");
    html.element("strong", count_text(static_cast<double>(count)));
    html.text(" ");
    write_status(html, info(status));
  }
}

/// Null if no cell has a limit.
const CellSummary* worst_cell(const std::vector<CellSummary>& cells) {
  const auto worst = std::ranges::max_element(
      cells, {}, [](const CellSummary& cell) { return cell.nearest.share(); });
  return worst == cells.end() || worst->nearest.engine.empty() ? nullptr : &*worst;
}

/// That cell's picture beside its difference from the engine.
void write_pair(Html& html, const ShownFarm& farm, const CellSummary* cell) {
  if (farm.is_report || !cell || !cell->picture.shown() || !cell->nearest.picture.shown()) return;
  const std::string engine = farm.engine_title(cell->nearest.engine);
  const Tag pair(html, "div", {{"class", "pair"}});
  const auto write = [&](const Picture& picture, const std::string& alt, const std::string& words) {
    // A thumbnail shows the sphere, too.
    const SmallPicture shown = picture.preview();
    const Tag figure(html, "figure");
    html.empty("img", {{"src", link_to({"cells", cell->entry->id, shown.file})},
                       {"alt", alt},
                       {"width", std::to_string(shown.width)},
                       {"height", std::to_string(shown.height)}});
    html.element("figcaption", words);
  };
  write(cell->picture, "A sphere with its highlight", cell->entry->title());
  write(cell->nearest.picture, "The difference of two pictures",
        fmt::format("Its difference from {}: white is {} of the peak", engine,
                    percent_text(cell->nearest.difference)));
}

/// The result in one sentence.
std::string result_sentence(const ShownFarm& farm, const std::vector<CellSummary>& cells) {
  const auto count = [&](CellStatus status) {
    return std::size_t(std::ranges::count(cells, status, &CellSummary::status));
  };
  const std::size_t pass = count(CellStatus::kPass), differs = count(CellStatus::kDiffers);
  const std::string references = reference_titles(farm);
  if (references.empty() || pass + differs == 0) return "Nothing has been compared yet.";
  if (pass == cells.size())
    return fmt::format("All {} highlights agree with {}, within what number formats allow.", pass,
                       references);
  return fmt::format("{} of {} highlights agree with {}; {} differ{}.", pass, cells.size(),
                     references, differs == 0 ? "none" : std::to_string(differs),
                     differs == 1 ? "s" : "");
}

bool has_formulas(const ShownFarm& farm) {
  return std::ranges::any_of(farm.record.engines, [](const records::FarmEngine& e) {
    return e.name == records::kAnalytic && e.available;
  });
}

void write_introduction(Html& html, const ShownFarm& farm, const std::vector<CellSummary>& cells) {
  const Tag header(html, "header", {{"class", "top"}});
  html.element("h1", farm.record.title);
  if (!farm.record.authors.empty()) html.element("p", {{"class", "authors"}}, farm.record.authors);
  write_counts(html, farm, cells);
  if (farm.is_report) {
    html.element("p", {{"class", "lead"}},
                 fmt::format("{}: each picture was compared with the one of {}.",
                             reference_titles(farm), farm.engine_title(farm.hub)));
    return;
  }
  html.element("p", {{"class", "lead"}}, result_sentence(farm, cells));
  const std::string references = reference_titles(farm);
  html.element("p",
               "Lobelia renders specular highlights straight from their models’ formulas. " +
                   (references.empty() ? "No other renderer was there to compare them with."
                                       : references + " rendered the same scenes, and each pair of "
                                                      "pictures was compared pixel by pixel."));
}

/// The cell that is nearest to its limit, and what the views found.
void write_findings(Html& html, const SiteFrame& site, const ShownFarm& farm,
                    const CellSummary* worst, const std::vector<Finding>& findings) {
  if (!worst && findings.empty()) return;
  const Tag section(html, "section", {{"class", "findings"}, {"aria-labelledby", "findings"}});
  html.element("h2", {{"id", "findings"}}, "What was found");
  const Tag list(html, "ul");
  if (worst) {
    const Tag item(html, "li");
    html.text(worst->nearest.share() > 1 ? "Farthest beyond its limit: "
                                         : "Nearest to its limit: ");
    write_cell_link(html, site, *worst->entry);
    const std::string engine = farm.engine_title(worst->nearest.engine);
    // A report's hub is the reference, which judges the others.
    html.text(fmt::format(
        "{} by {} of the peak; {} may be.",
        farm.is_report ? fmt::format(": {} differs from {}", engine, farm.engine_title(farm.hub))
                       : fmt::format(", which differs from {}", engine),
        percent_text(worst->nearest.difference), percent_text(worst->nearest.limit)));
  }
  for (const Finding& finding : findings) {
    const Tag item(html, "li");
    html.text(finding.sentence + " ");
    html.element("a", {{"href", link_to({finding.page.file})}}, finding.page.title);
  }
}

void write_missing_engines(Html& html, const ShownFarm& farm) {
  for (const records::FarmEngine& engine : farm.record.engines) {
    if (engine.available) continue;
    const Tag box(html, "div", {{"class", "notice"}, {"role", "note"}});
    {
      const Tag line(html, "p");
      html.element("strong", engine.title + " is missing");
      html.text((engine.why.empty() ? "" : ": " + engine.why) + ". The grid was drawn without it.");
    }
    if (engine.install.empty()) continue;
    html.element("p", "To get it, type this and run the farm again; it does only what is missing:");
    write_command(html, engine.install);
  }
}

/// A notice at the top if cells are not as the farm wrote them.
void write_doubts(Html& html, const ShownFarm& farm, const std::vector<CellSummary>& cells) {
  const auto count = std::ranges::count(cells, false, &CellSummary::is_as_written);
  if (count == 0) return;
  const Tag box(html, "div", {{"class", "notice doubts"}, {"role", "note"}});
  {
    const Tag line(html, "p");
    html.element("strong", fmt::format("{} {} not what the farm wrote.", count,
                                       count == 1 ? "cell is" : "cells are"));
    html.text(
        " Every picture and record was compared with its hash when this page was made. "
        "What does not fit has no verdict.");
  }
  if (farm.record.command.empty()) return;
  html.element("p", "To make them whole again:");
  write_command(html, farm.record.command);
}

void write_making(Html& html, const ShownFarm& farm) {
  const Tag section(html, "section", {{"class", "making"}, {"aria-labelledby", "making"}});
  html.element("h2", {{"id", "making"}}, "How it was made");
  if (!farm.record.command.empty()) write_command(html, farm.record.command);
  const Tag list(html, "dl", {{"class", "facts"}});
  for (const records::FarmEngine& engine : farm.record.engines)
    write_fact(html, engine.title,
               !engine.available        ? "missing"
               : engine.version.empty() ? "present"
                                        : engine.version);
  write_fact(html, "Grid", farm.record.grid);
  if (!farm.record.host) return;
  for (const auto& [name, value] : words_of(*farm.record.host)) write_fact(html, name, value);
}

/// Without what BibTeX would take for a command.
std::string in_bibtex(const std::string& text) {
  std::string result;
  for (const char c : text)
    if (c == '{' || c == '}' || c == '\\' || c == '"')
      continue;
    else if (std::string_view("#$%&_").find(c) != std::string_view::npos)
      result += std::string("\\") + c;
    else
      result += c;
  return result;
}

/// How to cite the study, if its grid names the authors.
void write_citation(Html& html, const ShownFarm& farm) {
  const std::string &authors = farm.record.authors, &url = farm.record.url;
  if (authors.empty()) return;
  const Tag section(html, "section", {{"class", "citation"}, {"aria-labelledby", "citation"}});
  html.element("h2", {{"id", "citation"}}, "Cite");
  std::string entry = fmt::format("@misc{{highlights,\n  author = {{{}}},\n  title = {{{}}},\n",
                                  in_bibtex(authors), in_bibtex(farm.record.title));
  if (!url.empty() && url.find_first_of("{}\\") == url.npos)
    entry += fmt::format("  url = {{{}}},\n", url);
  write_command(html,
                entry + fmt::format("  note = {{Made with {}}}\n}}", in_bibtex(farm.made_by)));
}

/// Which models each engine shades by itself, a row a model.
void write_models(Html& html, const ShownFarm& farm) {
  std::vector<const records::FarmEngine*> engines;
  for (const records::FarmEngine& engine : farm.record.engines)
    if (!engine.models.empty()) engines.push_back(&engine);
  if (engines.empty()) return;
  const Tag details(html, "details");
  html.element("summary", "Which models each engine shades");
  html.element("p",
               "A lobe that is named is native, too; what is expressed can have any lobe; a dash "
               "cannot be compared.");
  const Tag wrap(html, "div", {{"class", "table-wrap"}, {"tabindex", "0"}});
  const Tag table(html, "table", {{"class", "figures"}});
  {
    const Tag head(html, "thead");
    const Tag line(html, "tr");
    html.element("th", {{"scope", "col"}}, "model");
    for (const records::FarmEngine* engine : engines)
      html.element("th", {{"scope", "col"}}, engine->title);
  }
  const Tag body(html, "tbody");
  for (const records::EngineModel& model : engines[0]->models) {
    const Tag line(html, "tr");
    html.element("th", {{"scope", "row"}}, model.title);
    for (const records::FarmEngine* engine : engines) {
      const auto same =
          std::ranges::find(engine->models, model.model, &records::EngineModel::model);
      const std::string words = same == engine->models.end() ? "-" : same->in_short();
      html.element("td", words == "-" ? "–" : words == "both" ? "native, expressed" : words);
    }
  }
}

/// Explains the marks that this grid has.
void write_legend(Html& html, const ShownFarm& farm, const std::vector<CellSummary>& cells) {
  const Tag section(html, "section", {{"class", "legend"}, {"aria-labelledby", "legend"}});
  html.element("h2", {{"id", "legend"}}, "How to read the grid");
  {
    const Tag list(html, "dl", {{"class", "marks"}});
    for (const CellStatus status : kCellStatuses) {
      if (std::ranges::count(cells, status, &CellSummary::status) == 0) continue;
      const Tag item(html, "div");
      {
        const Tag term(html, "dt");
        write_status(html, farm.words_of(status));
      }
      html.element("dd", farm.words_of(status).meaning);
    }
    for (const Change change : kChanges) {
      const auto is_it = [&](const CellSummary& cell) {
        return cell.change && cell.change->change == change;
      };
      if (change == Change::kSame || std::ranges::none_of(cells, is_it)) continue;
      const Tag item(html, "div");
      {
        const Tag term(html, "dt");
        write_badge(html, info(change).name, info(change).mark, info(change).word);
      }
      html.element("dd", info(change).meaning);
    }
  }
  if (farm.is_report) {
    html.element(
        "p",
        "The pictures of a pair, from the left: the reference, and each other one followed "
        "by its difference from it, |a − b|, whose largest value is white. The worst pair "
        "is first: the one whose figure is the most times over its limit.");
    return;
  }
  const Tag words(html, "div");
  html.element(
      "p",
      "A thumbnail is our picture at an exposure that brings its brightest value to white, "
      "so that sharp and broad highlights can both be seen; the cell’s page prints the "
      "exposure. Grey is where no surface is, and a small highlight is enlarged in a corner. "
      "Click it for all pictures, differences, curves and numbers.");
  if (!reference_titles(farm).empty()) {
    html.element(
        "p",
        std::string(
            "Native: the engine shades the model itself. Expressed: the model is reimplemented by hand in "
            "the engine’s language, and the picture tests geometry, camera, light, visibility and "
            "arithmetic. Each cell says which.") +
            (has_formulas(farm)
                 ? " Analytic: the formula itself, evaluated for each pixel by separate code."
                 : ""));
    html.element("p",
                 "The small print is the worst difference against each engine: the largest "
                 "|ours − theirs| over all pixels and channels of the linear float pictures, "
                 "divided by the brightest value of theirs. “2 px” after it counts pixels beyond "
                 "the tolerance; a few are allowed on the silhouette and the terminator, where "
                 "rounding decides what a ray hits.");
    write_models(html, farm);
  }
}

void write_attention_list(Html& html, const SiteFrame& site, const ShownFarm& farm,
                          std::span<const CellSummary* const> cells) {
  const Tag list(html, "ul");
  for (const CellSummary* cell : cells) {
    const Tag item(html, "li");
    write_status(html, farm.words_of(cell->status));
    html.text(" ");
    write_cell_link(html, site, *cell->entry);
    for (std::size_t i = 0; i < std::min(cell->reasons.size(), kMaxReasons); ++i)
      html.element("small", cell->reasons[i]);
    if (cell->reasons.size() > kMaxReasons)
      html.element("small", fmt::format("and {} more", cell->reasons.size() - kMaxReasons));
  }
}

void write_attention(Html& html, const SiteFrame& site, const ShownFarm& farm,
                     const std::vector<CellSummary>& cells) {
  std::vector<const CellSummary*> first;
  // In a farm it is not done yet, in a report it is gone.
  for (const CellSummary& cell : cells)
    if (needs_a_look(cell.status) || (farm.is_report && cell.status == CellStatus::kMissing))
      first.push_back(&cell);
  std::ranges::stable_sort(first, {},
                           [](const CellSummary* cell) { return rank_of(cell->status); });
  if (first.empty()) return;
  const Tag section(html, "section", {{"class", "attention"}, {"aria-labelledby", "attention"}});
  html.element("h2", {{"id", "attention"}}, "Look at these first");
  write_folded(html, first, [&](auto some) { write_attention_list(html, site, farm, some); });
}

}  // namespace

void write_cell_link(Html& html, const SiteFrame& site, const CellEntry& entry) {
  html.element("a", {{"href", cell_link(site, entry.id)}}, entry.title());
}

std::string index_page(const SiteFrame& site, const ShownFarm& farm,
                       const std::vector<CellSummary>& cells, const std::vector<Finding>& findings,
                       const History& history) {
  Html html;
  write_introduction(html, farm, cells);
  if (!history.empty()) write_changes(html, site, history, cells);
  write_doubts(html, farm, cells);
  write_missing_engines(html, farm);
  const CellSummary* worst = worst_cell(cells);
  {
    const Tag overview(html, "div", {{"class", "overview"}});
    if (!site.is_packed) write_pair(html, farm, worst);
    write_findings(html, site, farm, worst, findings);
  }
  write_attention(html, site, farm, cells);
  write_grid(html, site, farm, cells);
  write_legend(html, farm, cells);
  write_making(html, farm);
  write_citation(html, farm);
  return finish_page(site, {site.title, "grid", "", "index.html", farm.made_by, kGridData, ""},
                     html);
}

}  // namespace lobelia::gallery
