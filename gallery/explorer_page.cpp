// The page on which a highlight can be chosen and looked at.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/numbers.hpp"
#include "core/svg_chart.hpp"
#include "gallery/highlight_curves.hpp"
#include "gallery/page.hpp"
#include "gallery/record_page.hpp"
#include "gallery/views.hpp"
#include "records/pages.hpp"
#include "records/words.hpp"

namespace lobelia::gallery {
namespace {

using records::HighlightTable, records::HighlightTables, records::LobeTable, records::ModelTable;

constexpr char kRecord[] = "explorer/tables.json";
constexpr char kTitle[] = "Highlights to explore";
constexpr double kShown = 64;  // the exponent that the page has without script
constexpr double kDegree = std::numbers::pi / 180;

/// Of the exponent that is nearest to `n`.
std::size_t nearest(const std::vector<double>& exponents, double n) {
  const auto distance = [n](double a, double b) { return std::abs(a - n) < std::abs(b - n); };
  return std::size_t(std::ranges::min_element(exponents, distance) - exponents.begin());
}

std::vector<double> in_degrees(std::vector<double> radians) {
  for (double& angle : radians) angle /= kDegree;
  return radians;
}

/// Lines are told apart by five styles; of a family of lobes the first and the last tell its range.
constexpr std::size_t kMostLines = 6;

void write_chart(Html& html, const Chart& chart, const std::string& words) {
  const Tag figure(html, "figure", {{"class", "chart-figure"}});
  html.element("h3", chart.title);
  html.raw(draw_chart(chart));
  html.element("figcaption", words);
}

Chart lobe_chart(const HighlightTables& tables, std::size_t at) {
  Chart chart;
  chart.id = "lobes";
  const double n = tables.exponents[at];
  chart.title = "Lobes at n = " + number_text(n, 4);
  chart.description = "The lobes over the angle, of the peak, logarithmic.";
  chart.width = 760;
  chart.height = 400;
  chart.x = {"angle that the lobe sees (degrees)", 0, 60, false};
  chart.y = {"lobe (log)", 1e-5, 10, true};
  for (const LobeTable& lobe : tables.lobes) {
    if (lobe.order > 0 && lobe.order != 2 && lobe.order != 16) continue;
    if (chart.series.size() == kMostLines) break;
    ChartSeries series{
        lobe.title, in_degrees(curve_angles(lobe, at, n)), {}, int(chart.series.size())};
    for (const std::int64_t number : lobe.curves[at]) series.y.push_back(lobe_value(lobe, number));
    chart.series.push_back(std::move(series));
  }
  return chart;
}

Chart albedo_chart(const HighlightTables& tables, std::size_t at, const std::string& lobe) {
  Chart chart;
  chart.id = "albedos";
  const double n = tables.exponents[at];
  chart.title = fmt::format("Energy over incidence, {} at n = {}", lobe, number_text(n, 4));
  chart.description = "What leaves of a beam, over its incidence, for every model.";
  chart.width = 760;
  chart.height = 400;
  chart.x = {"incidence (degrees)", 0, 90, false};
  chart.y = {"share of a beam that leaves", 0, 2, false};
  for (const HighlightTable& highlight : tables.highlights) {
    if (highlight.lobe != lobe || chart.series.size() == kMostLines) continue;
    const auto incidences = incidences_of(tables, n, highlight.seen[at].size());
    const auto model = std::ranges::find(tables.models, highlight.model, &ModelTable::name);
    chart.series.push_back({model == tables.models.end() ? highlight.model : model->title,
                            in_degrees(incidences), beam_of(highlight, at, incidences),
                            int(chart.series.size())});
  }
  return chart;
}

void write_lobes(Html& html, const HighlightTables& tables) {
  const Tag scroll(
      html, "div",
      {{"class", "table-wrap"}, {"tabindex", "0"}, {"role", "region"}, {"aria-label", "Lobes"}});
  const Tag table(html, "table", {{"class", "figures"}});
  html.element("caption", "Half-widths: the angle at which the lobe has fallen to half");
  std::vector<std::size_t> at;
  for (const double n : {16.0, 64.0, 256.0, 1024.0}) {
    const std::size_t index = nearest(tables.exponents, n);
    if (std::ranges::find(at, index) == at.end()) at.push_back(index);
  }
  {
    const Tag head(html, "thead");
    const Tag row(html, "tr");
    html.element("th", {{"scope", "col"}}, "lobe");
    html.element("th", {{"scope", "col"}}, "value, s = 1 − cos");
    for (const std::size_t index : at)
      html.element("th", {{"scope", "col"}}, "n = " + number_text(tables.exponents[index], 4));
  }
  const Tag body(html, "tbody");
  for (const LobeTable& lobe : tables.lobes) {
    const Tag row(html, "tr");
    html.element("th", {{"scope", "row"}}, lobe.title);
    html.element("td", lobe.formula);
    for (const std::size_t index : at)
      html.element("td", {{"class", "number"}}, degrees_text(lobe.half_width[index] / kDegree));
  }
}

void write_highlights(Html& html, const HighlightTables& tables, std::size_t at) {
  const Tag scroll(html, "div",
                   {{"class", "table-wrap"},
                    {"tabindex", "0"},
                    {"role", "region"},
                    {"aria-label", "Highlights"}});
  const Tag table(html, "table", {{"class", "figures"}});
  html.element("caption", fmt::format("Every model with every lobe at n = {}",
                                      number_text(tables.exponents[at], 4)));
  write_columns(html, {"model", "lobe", "coefficient, exact", "as the paper prints it",
                       "energy at normal incidence", "most seen", "most of a beam"});
  const Tag body(html, "tbody");
  for (const HighlightTable& one : tables.highlights) {
    const auto incidences = incidences_of(tables, tables.exponents[at], one.seen[at].size());
    const double most_seen = albedo_of(one, std::ranges::max(one.seen[at]));
    const double most_lit = std::ranges::max(beam_of(one, at, incidences));
    const Tag row(html, "tr");
    html.element("th", {{"scope", "row"}}, one.model);
    html.element("td", one.lobe);
    for (const std::string& text :
         {number_text(one.exact[at], 5), one.paper.empty() ? "–" : number_text(one.paper[at], 5),
          number_text(albedo_of(one, one.seen[at].back()), 4), number_text(most_seen, 4),
          number_text(most_lit, 4)})
      html.element("td", {{"class", "number"}}, text);
  }
}

/// More digits than the tables are good for, shorter than a double's.
void round_all(std::vector<double>& values) {
  for (double& value : values) value = std::strtod(fmt::format("{:.8g}", value).c_str(), nullptr);
}

/// To second differences from exponent to exponent, which are short: the first row, how the second differs from it,
/// and from then on how much this changes.
void take_differences(Rows& rows) {
  for (std::size_t r = rows.size(); r-- > 1;)
    for (std::size_t i = 0; i < rows[r].size(); ++i)
      rows[r][i] -= r == 1 ? rows[0][i] : 2 * rows[r - 1][i] - rows[r - 2][i];
}

records::ExplorerPage page_data(HighlightTables tables) {
  for (LobeTable& lobe : tables.lobes) {
    round_all(lobe.reach);
    round_all(lobe.half_width);
    take_differences(lobe.curves);
  }
  for (HighlightTable& highlight : tables.highlights) {
    round_all(highlight.exact);
    round_all(highlight.paper);
    take_differences(highlight.seen);
    take_differences(highlight.lit);
  }
  return tables;
}

void draw(ViewPage& page, const HighlightTables& tables) {
  require_drawable(tables, kRecord);
  const std::size_t at = nearest(tables.exponents, kShown);
  Html& html = page.main;
  write_lead(
      html, kTitle,
      "A lobe, a model, a normalisation, an exponent: what the highlight looks like, what stands before "
      "it, and how much of the light it reflects. The numbers are those of the renderer's own formulas.");
  html.element("div", {{"id", "explorer"}}, "");
  {
    const Tag section(html, "section", {{"class", "without-script"}});
    const Tag grid(html, "div", {{"class", "figure-grid"}});
    write_chart(html, lobe_chart(tables, at), "Where a line ends, the lobe is 0.");
    if (!tables.lobes.empty())
      write_chart(html, albedo_chart(tables, at, tables.lobes.front().name),
                  "Above 1 more leaves than arrives; towards grazing light an RDF has no bound.");
  }
  {
    const Tag section(html, "section");
    html.element("h2", "At a few exponents");
    write_lobes(html, tables);
    const Tag details(html, "details");
    html.element("summary", fmt::format("All {} highlights", tables.highlights.size()));
    write_highlights(html, tables, at);
  }
  std::string errors;
  for (const auto& [name, error] : numbers_of(tables.error))
    errors += (errors.empty() ? "" : ", ") + name + " " + number_text(error);
  const Tag section(html, "section");
  html.element("h2", "Where the numbers come from");
  html.element(
      "p",
      fmt::format("Tables that the library wrote for {} exponents from {} to {}; between them a "
                  "polynomial through those of an octave, which tests hold to the library: {} "
                  "at most (a curve's of the peak, the others relative).",
                  tables.exponents.size(), number_text(tables.exponents.front()),
                  number_text(tables.exponents.back(), 6), errors));
  write_command(html, "lobelia models --tables tables.json");
  // Megabytes that the page's data says shorter.
  page.files.clear();
  page.data = records::record_line(page_data(tables));
}

/// Of RUN/explorer/tables.json; empty where there is none.
std::optional<ViewPage> explorer_page(const std::filesystem::path& run) {
  return record_page<HighlightTables>(run, kRecord, kTitle, draw);
}

}  // namespace

extern const View explorer_view;
const View explorer_view{"explorer", "Explorer", "explorer.html", explorer_page};

}  // namespace lobelia::gallery
