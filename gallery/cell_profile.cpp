#include <algorithm>
#include <map>

#include "core/numbers.hpp"
#include "gallery/cell_sections.hpp"
#include "gallery/page.hpp"
#include "gallery/profile_charts.hpp"

namespace lobelia::gallery {
namespace {

void write_curves(Html& html, const FarmData& farm, const ProfileData& profile) {
  if (profile.degrees.empty() || profile.curves.empty()) {
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
  const NamedCurve* analytic = profile.find_curve(kAnalytic);
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

struct FigureTitle {
  std::string title;
  std::string (*text)(double);
};

std::string three_digits(double value) { return number_text(value); }
// Enough to see engines apart that agree to four.
std::string five_digits(double value) { return number_text(value, 5); }
// What float32 tells of an exponent.
std::string seven_digits(double value) { return number_text(value, 7); }
std::string two_digits(double value) { return number_text(value, 2); }
std::string per_cent(double value) { return percent_text(value); }

FigureTitle figure_title(const std::string& id) {
  static const std::map<std::string, FigureTitle> kTitles = {
      {"peak", {"Peak", five_digits}},
      {"peakAngleDegrees", {"At angle", degrees_text}},
      {"halfWidthDegrees", {"Half-width", degrees_text}},
      {"energy", {"Energy", five_digits}},
      {"exponent", {"n as a cosine lobe", seven_digits}},
      {"standardError", {"± of n", two_digits}},
      {"pixels", {"Pixels", count_text}},
      {"maxAbs", {"Largest difference", three_digits}},
      {"rms", {"Root mean square", three_digits}},
      {"maxRelPeak", {"Largest, of the peak", per_cent}}};
  const auto at = kTitles.find(id);
  return at == kTitles.end() ? FigureTitle{id, five_digits} : at->second;
}

struct FigureRow {
  std::vector<std::string> heads;
  NamedNumbers values;
};

/// Rows that may lack some of the columns; a hole is a dash.
void write_figures(Html& html, const std::string& caption, const std::vector<std::string>& head,
                   const std::vector<FigureRow>& rows) {
  std::vector<std::string> columns;
  for (const FigureRow& row : rows) {
    for (const auto& [id, value] : row.values) {
      if (std::find(columns.begin(), columns.end(), id) == columns.end()) columns.push_back(id);
    }
  }
  const Tag wrap(html, "div", {{"class", "table-wrap"}, {"tabindex", "0"}});
  const Tag table(html, "table", {{"class", "figures"}});
  html.element("caption", caption);
  {
    const Tag thead(html, "thead");
    const Tag line(html, "tr");
    for (const std::string& title : head) html.element("th", {{"scope", "col"}}, title);
    for (const std::string& id : columns) {
      html.element("th", {{"scope", "col"}, {"class", "number"}}, figure_title(id).title);
    }
  }
  const Tag tbody(html, "tbody");
  for (const FigureRow& row : rows) {
    const Tag line(html, "tr");
    for (const std::string& words : row.heads) html.element("th", {{"scope", "row"}}, words);
    for (const std::string& id : columns) {
      const auto value = std::find_if(row.values.begin(), row.values.end(),
                                      [&](const auto& v) { return v.first == id; });
      html.element("td", {{"class", "number"}},
                   value == row.values.end() ? "–" : figure_title(id).text(value->second));
    }
  }
}

std::string pair_title(const FarmData& farm, const std::string& pair) {
  const auto dash = pair.find('-');
  if (dash == std::string::npos) return curve_title(farm, pair);
  return curve_title(farm, pair.substr(0, dash)) + " − " + curve_title(farm, pair.substr(dash + 1));
}

}  // namespace

void write_profile(Html& html, const FarmData& farm, const CellData& cell) {
  const ProfileData& profile = cell.profile;
  const Tag section(html, "section", {{"aria-labelledby", "profile"}});
  html.element("h2", {{"id", "profile"}}, "The highlight as a curve");
  if (profile.file.empty()) return write_absence(html, "This cell has no profile.");
  if (!profile.problem.empty()) return write_absence(html, profile.problem);
  write_curves(html, farm, profile);
  const Tag tables(html, "div", {{"class", "side-by-side"}});
  if (!profile.images.empty()) {
    std::vector<FigureRow> rows;
    for (const auto& [name, values] : profile.images) {
      rows.push_back({{curve_title(farm, name)}, values});
    }
    write_figures(html, "Each highlight in figures", {"Picture"}, rows);
  }
  if (!profile.differences.empty()) {
    std::vector<FigureRow> rows;
    for (const auto& [pair, zones] : profile.differences) {
      for (const ZoneDifference& zone : zones) {
        rows.push_back({{pair_title(farm, pair), zone_title(zone.zone)}, zone.values});
      }
    }
    std::string caption = "Differences by zone";
    for (const ProfileZone& zone : profile.zones)
      caption += "; " + zone.title + " " + degrees_text(zone.from) + " to " + degrees_text(zone.to);
    write_figures(html, caption, {"Pictures", "Zone"}, rows);
  }
}

}  // namespace lobelia::gallery
