#include <algorithm>
#include <optional>
#include <span>

#include "core/numbers.hpp"
#include "gallery/cell_sections.hpp"
#include "gallery/page.hpp"
#include "gallery/profile_charts.hpp"

namespace lobelia::gallery {
namespace {

void write_curves(Html& html, const ShownFarm& farm, const records::Profile& profile) {
  if (profile.curve.angle_degrees.empty() || profile.curve.radiance.empty()) {
    write_absence(html,
                  "The profile has no curve: no pixel of the picture lies in this highlight.");
    return;
  }
  {
    const Tag figure(html, "figure", {{"class", "chart-figure"}});
    html.raw(draw_chart(radiance_chart(farm, profile)));
    html.element(
        "figcaption",
        "The highlight as a curve: mean radiance (of red, green and blue) of the pixels at "
        "each angle. Lines that lie on each other show through by their dashes.");
  }
  const std::vector<double>* analytic = records::find(profile.curve.radiance, kAnalytic);
  if (!analytic) {
    write_absence(html, "The profile has no curve of the formula to compare with.");
    return;
  }
  const Chart chart = difference_chart(farm, profile, *analytic);
  if (chart.series.empty()) {
    write_absence(html, "No curve differs from the formula in any digit.");
    return;
  }
  const Tag figure(html, "figure", {{"class", "chart-figure"}});
  html.raw(draw_chart(chart));
  html.element("figcaption",
               "How far each curve is from the formula, subtracted for this drawing, on a "
               "logarithmic axis. A gap is a bin "
               "without any difference.");
}

struct FigureColumn {
  const char* title;
  std::string (*text)(double);
};

std::string three_digits(double value) { return number_text(value); }
// Enough to see engines apart that agree to four.
std::string five_digits(double value) { return number_text(value, 5); }
// What float32 tells of an exponent.
std::string seven_digits(double value) { return number_text(value, 7); }
std::string two_digits(double value) { return number_text(value, 2); }
std::string per_cent(double value) { return percent_text(value); }

constexpr FigureColumn kShapeColumns[] = {
    {"Peak", five_digits},   {"At angle", degrees_text},           {"Half-width", degrees_text},
    {"Energy", five_digits}, {"n as a cosine lobe", seven_digits}, {"± of n", two_digits}};
constexpr FigureColumn kZoneColumns[] = {{"Pixels", count_text},
                                         {"Largest difference", three_digits},
                                         {"Root mean square", three_digits},
                                         {"Largest, of the peak", per_cent}};

struct FigureRow {
  std::vector<std::string> heads;
  std::vector<std::optional<double>> values;  ///< of each column
};

FigureRow row_of(const std::string& head, const records::HighlightShape& shape) {
  FigureRow row{{head},
                {shape.peak, shape.peak_angle_degrees, shape.half_width_degrees, shape.energy,
                 std::nullopt, std::nullopt}};
  if (shape.highlight) {
    row.values[4] = shape.highlight->cosine_lobe.exponent;
    row.values[5] = shape.highlight->cosine_lobe.standard_error;
  }
  return row;
}

FigureRow row_of(const std::string& pair, const std::string& zone, const records::ZoneError& e) {
  return {{pair, zone}, {double(e.pixels), e.max_abs, e.rms, e.max_rel_peak}};
}

/// Rows that may lack some of the columns: a hole is a dash, a column of holes is left out.
void write_figures(Html& html, const std::string& caption, const std::vector<std::string>& head,
                   std::span<const FigureColumn> columns, const std::vector<FigureRow>& rows) {
  const auto is_there = [&](std::size_t column) {
    return std::ranges::any_of(
        rows, [&](const FigureRow& row) { return row.values[column].has_value(); });
  };
  const Tag wrap(html, "div", {{"class", "table-wrap"}, {"tabindex", "0"}});
  const Tag table(html, "table", {{"class", "figures"}});
  html.element("caption", caption);
  {
    const Tag thead(html, "thead");
    const Tag line(html, "tr");
    for (const std::string& title : head) html.element("th", {{"scope", "col"}}, title);
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (is_there(i))
        html.element("th", {{"scope", "col"}, {"class", "number"}}, columns[i].title);
  }
  const Tag tbody(html, "tbody");
  for (const FigureRow& row : rows) {
    const Tag line(html, "tr");
    for (const std::string& words : row.heads) html.element("th", {{"scope", "row"}}, words);
    for (std::size_t i = 0; i < columns.size(); ++i)
      if (is_there(i))
        html.element("td", {{"class", "number"}},
                     row.values[i] ? columns[i].text(*row.values[i]) : "–");
  }
}

std::string pair_title(const ShownFarm& farm, const std::string& pair) {
  const auto dash = pair.find('-');
  if (dash == std::string::npos) return curve_title(farm, pair);
  return curve_title(farm, pair.substr(0, dash)) + " − " + curve_title(farm, pair.substr(dash + 1));
}

}  // namespace

void write_profile(Html& html, const ShownFarm& farm, const CheckedCell& cell) {
  const Tag section(html, "section", {{"aria-labelledby", "profile"}});
  html.element("h2", {{"id", "profile"}}, "The highlight as a curve");
  if (cell.record.profile.empty()) return write_absence(html, "This cell has no profile.");
  if (!cell.profile) return write_absence(html, cell.profile_problem);
  const records::Profile& profile = *cell.profile;
  write_curves(html, farm, profile);
  const Tag tables(html, "div", {{"class", "side-by-side"}});
  if (!profile.images.empty()) {
    std::vector<FigureRow> rows;
    for (const auto& [name, shape] : profile.images)
      rows.push_back(row_of(curve_title(farm, name), shape));
    write_figures(html, "Each highlight in figures", {"Picture"}, kShapeColumns, rows);
  }
  if (!profile.differences.empty()) {
    std::vector<FigureRow> rows;
    const std::vector<records::ShownZone> titles = zones_of(profile);
    for (const auto& [pair, zones] : profile.differences) {
      const records::ZoneError errors[] = {zones.epicentre, zones.flank, zones.blooming};
      for (std::size_t i = 0; i < titles.size(); ++i)
        rows.push_back(row_of(pair_title(farm, pair), titles[i].title, errors[i]));
    }
    std::string caption = "Differences by zone";
    for (const records::ShownZone& zone : titles)
      caption += "; " + zone.title + " " + degrees_text(zone.from) + " to " + degrees_text(zone.to);
    write_figures(html, caption, {"Pictures", "Zone"}, kZoneColumns, rows);
  }
}

}  // namespace lobelia::gallery
