// The page on which a reader chooses a highlight and sees its curves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/records/pages.hpp"
#include "base/records/words.hpp"
#include "base/words/numbers.hpp"
#include "base/words/svg_chart.hpp"
#include "gallery/packed/packing.hpp"
#include "gallery/pages/page.hpp"
#include "gallery/pages/page_text.hpp"
#include "gallery/pages/views.hpp"

namespace lobelia::embedded {
extern const std::string_view shader_search;
}
namespace lobelia::gallery::explorer_page {
namespace {

using records::HighlightTable, records::HighlightTables, records::LobeTable, records::ModelTable;

constexpr char kRecord[] = "explorer/tables.json";
constexpr char kTitle[] = "Highlights to explore";
constexpr double kShown = 64;  // the exponent of the page without script
constexpr double kDegree = std::numbers::pi / 180;

/// A row of numbers for each exponent.
using Rows = std::vector<std::vector<std::int64_t>>;

constexpr std::size_t kMaxExponents = 1000, kMaxPoints = 1000;
/// A double holds every whole number up to here.
constexpr std::int64_t kLargestNumber = 1'000'000'000'000'000;

/// The numbers from 0 to `reach` at which the tables have values (docs/records.md).
std::vector<double> spread(double reach, double exponent, std::size_t count) {
  const double a = std::asinh(reach * std::sqrt(exponent));
  std::vector<double> result;
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(reach * std::sinh(a * double(i) / double(count - 1)) / std::sinh(a));
  return result;
}

void require(bool condition, const char* what) {
  if (!condition) throw Error(ExitCode::kInput, "{}: {}", kRecord, what);
}

void require_unit(double unit) {
  require(unit > 0 && unit <= 1, "a unit must be above 0 and at most 1");
}

void require_positive(const std::vector<double>& values, std::size_t exponents) {
  require(values.size() == exponents, "a table must have a number for each exponent");
  for (const double value : values)
    require(value >= kSmallestDrawn && value <= kLargestDrawn,
            "a table has a number that cannot be drawn");
}

void require_rows(const Rows& rows, std::size_t exponents, std::size_t points) {
  require(rows.size() == exponents, "a table must have a row for each exponent");
  require(points >= 2 && points <= kMaxPoints, "a row must have 2 to 1000 numbers");
  for (const auto& row : rows) {
    require(row.size() == points, "all rows of a table must be equally long");
    for (const std::int64_t number : row)
      require(number >= -kLargestNumber && number <= kLargestNumber,
              "a row has a number that cannot be drawn");
  }
}

std::size_t width_of(const Rows& rows) { return rows.empty() ? 0 : rows[0].size(); }

/// Throws Error(kInput) for tables that do not fit together or have a number that cannot be drawn.
void require_drawable(const HighlightTables& tables) {
  const std::size_t count = tables.exponents.size();
  require(count >= 2 && count <= kMaxExponents && std::ranges::is_sorted(tables.exponents) &&
              tables.exponents.front() > 0 && tables.exponents.back() <= kLargestDrawn,
          "exponents must be numbers above 0 that ascend");
  require(tables.per_octave >= 1 && tables.per_octave <= 16 &&
              (count - 1) % std::size_t(tables.per_octave) == 0,
          "perOctave must divide the exponents into octaves");
  require(tables.most_grazing > 0 && tables.most_grazing < 1.5708,
          "mostGrazing must be an angle below a right one");
  for (const ModelTable& model : tables.models)
    require(model.weights.size() == 4 && model.s_max > 0 && model.s_max <= 1,
            "a model must have 4 weights and an sMax of 0 to 1");
  for (const LobeTable& lobe : tables.lobes) {
    require_unit(lobe.unit);
    require_positive(lobe.reach, count);
    require_positive(lobe.half_width, count);
    require_rows(lobe.curves, count, width_of(lobe.curves));
  }
  for (const HighlightTable& highlight : tables.highlights) {
    require_unit(highlight.unit);
    require_positive(highlight.exact, count);
    require_rows(highlight.seen, count, width_of(highlight.seen));
    if (!highlight.paper.empty()) require_positive(highlight.paper, count);
    if (!highlight.lit.empty()) require_rows(highlight.lit, count, width_of(highlight.seen));
    for (const auto* shader : {&highlight.shader, &highlight.paper_shader})
      for (const std::int64_t part : *shader)
        require(part >= 0 && part < std::int64_t(tables.shader_parts.size()),
                "a shader has a part that is not in shaderParts");
  }
}

/// The albedo of an integer in `seen` or `lit`.
double albedo_of(const HighlightTable& highlight, std::int64_t number) {
  return std::exp(double(number) * highlight.unit);
}

/// The incidence of every number of an albedo, in radians, from grazing to normal.
std::vector<double> incidences_of(const HighlightTables& tables, double n, std::size_t count) {
  std::vector<double> result = spread(tables.most_grazing, n, count);
  for (double& incidence : result) incidence = tables.most_grazing - incidence;
  return result;
}

/// The share of a beam that is reflected, at each of the exponent's incidences.
std::vector<double> beam_of(const HighlightTable& highlight, std::size_t exponent,
                            const std::vector<double>& incidences) {
  std::vector<double> result;
  for (std::size_t i = 0; i < incidences.size(); ++i)
    result.push_back(highlight.lit.empty() ? albedo_of(highlight, highlight.seen[exponent][i])
                                           : albedo_of(highlight, highlight.lit[exponent][i]) /
                                                 std::cos(incidences[i]));
  return result;
}

/// The index of the exponent nearest to `n`.
std::size_t nearest(const std::vector<double>& exponents, double n) {
  const auto distance = [n](double a, double b) { return std::abs(a - n) < std::abs(b - n); };
  return std::size_t(std::ranges::min_element(exponents, distance) - exponents.begin());
}

/// The title of a model or a lobe.
template <class T>
std::string title_of(const std::vector<T>& all, const std::string& name) {
  const auto one = std::ranges::find(all, name, &T::name);
  return one == all.end() ? name : one->title;
}

void write_lobes(Html& html, const HighlightTables& tables) {
  const Tag scroll(html, "div", scroll_box("Lobes"));
  const Tag table(html, "table", {{"class", "figures"}});
  html.element("caption", "Half-widths: the angle at which the lobe has fallen to half");
  std::vector<std::size_t> at;
  for (const double n : {16.0, 64.0, 256.0, 1024.0}) {
    const std::size_t index = nearest(tables.exponents, n);
    if (std::ranges::find(at, index) == at.end()) at.push_back(index);
  }
  std::vector<std::string> titles = {"lobe", "value, s = 1 − cos"};
  for (const std::size_t index : at)
    titles.push_back("n = " + number_text(tables.exponents[index], 4));
  write_columns(html, titles);
  const Tag body(html, "tbody");
  for (const LobeTable& lobe : tables.lobes) {
    const Tag row(html, "tr");
    html.element("th", {{"scope", "row"}}, lobe.title);
    math_element(html, "td", lobe.formula);
    for (const std::size_t index : at)
      html.element("td", {{"class", "number"}}, degrees_text(lobe.half_width[index] / kDegree));
  }
}

void write_highlights(Html& html, const HighlightTables& tables, std::size_t at) {
  const Tag scroll(html, "div", scroll_box("Highlights"));
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
    html.element("th", {{"scope", "row"}}, title_of(tables.models, one.model));
    html.element("td", title_of(tables.lobes, one.lobe));
    for (const std::string& text :
         {number_text(one.exact[at], 5), one.paper.empty() ? "–" : number_text(one.paper[at], 5),
          number_text(albedo_of(one, one.seen[at].back()), 4), number_text(most_seen, 4),
          number_text(most_lit, 4)})
      html.element("td", {{"class", "number"}}, text);
  }
}

records::ExplorerPage page_data(HighlightTables tables) {
  for (records::ModelTable& model : tables.models)
    model.normalisation_constant = math_text(model.normalisation_constant), model.angle = math_text(model.angle);
  for (LobeTable& lobe : tables.lobes) lobe.formula = math_text(lobe.formula);
  return {std::move(tables),
          embedded::shader_search.empty() ? "" : packed_bytes(embedded::shader_search)};
}

void write(ViewPage& page, const HighlightTables& tables, const RunFiles&) {
  require_drawable(tables);
  const std::size_t at = nearest(tables.exponents, kShown);
  Html& html = page.main;
  write_lead(
      html, kTitle,
      "Choose a model, a lobe, a normalisation and an exponent. See the highlight on a sphere, its curve, its "
      "coefficient, its cost and how much of the light it reflects, alone or beside another.");
  html.element("div", {{"id", "explorer"}}, "");
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
  // The page's data replaces the record, which has megabytes.
  page.files.clear();
  page.data = records::record_line(page_data(tables));
}

}  // namespace
}  // namespace lobelia::gallery::explorer_page

namespace lobelia::gallery {
extern const View explorer_view{
    "explorer", "Explorer", "explorer.html",
    page_of(explorer_page::kRecord, explorer_page::kTitle, explorer_page::write)};
}
