#include <algorithm>
#include <span>

#include "core/numbers.hpp"
#include "core/svg_chart.hpp"
#include "gallery/cell_page.hpp"

namespace lobelia::gallery {
namespace {

constexpr double kBeyondZones = 1.25;  // the angle axis ends at this multiple of the outermost zone

struct Curve {
  std::string name;
  const std::vector<double>& values;
};

/// The formula first, because it is drawn under the others; then the engines in the order of farm.json.
std::vector<Curve> in_order(const ShownFarm& farm, const records::Profile& profile) {
  std::vector<Curve> result;
  const auto add = [&](const std::string& name) {
    if (const auto* values = records::find(profile.curve.radiance, name))
      result.push_back({name, *values});
  };
  add(kAnalytic);
  for (const records::FarmEngine& engine : farm.record.engines)
    if (engine.name != kAnalytic) add(engine.name);
  return result;
}

int style_of(const ShownFarm& farm, const std::string& name) {
  if (name == kAnalytic) return 0;
  const auto at = std::ranges::find(farm.record.engines, name, &records::FarmEngine::name);
  return at == farm.record.engines.end() ? 0 : int(at - farm.record.engines.begin()) + 1;
}

ChartAxis angle_axis(const records::Profile& profile) {
  const bool half = profile.angle.find("half") != std::string::npos;
  ChartAxis axis{half ? "angle between normal and half vector (degrees)"
                      : "angle between light and mirror direction (degrees)",
                 0, 0, false};
  for (const double angle : profile.curve.angle_degrees)
    if (angle <= 180) axis.to = std::max(axis.to, angle);
  const double zones_end = profile.zones.blooming_degrees[1];
  if (zones_end > 0) axis.to = std::min(axis.to, kBeyondZones * zones_end);
  if (!(axis.to > 0)) axis.to = 90;
  return axis;
}

std::vector<ChartBand> zone_bands(const records::Profile& profile) {
  std::vector<ChartBand> bands;
  for (const records::ShownZone& zone : zones_of(profile))
    bands.push_back({zone.from, zone.to, zone.title});
  return bands;
}

/// "formula", or the engine's title.
std::string curve_title(const ShownFarm& farm, const std::string& name) {
  return name == kAnalytic ? "formula" : farm.engine_title(name);
}

/// Radiance over angle, linear: the formula broad and pale, the engines' lines over it.
Chart radiance_chart(const ShownFarm& farm, const records::Profile& profile) {
  Chart chart{.id = "radiance",
              .title = "Radiance over angle",
              .description = "The highlight as each engine drew it, over the formula.",
              .x = angle_axis(profile),
              .y = {},
              .bands = zone_bands(profile),
              .series = {}};
  double top = 0;
  for (const auto& [name, values] : in_order(farm, profile)) {
    chart.series.push_back(
        {curve_title(farm, name), profile.curve.angle_degrees, values, style_of(farm, name)});
    for (const double value : values)
      if (value <= kLargestDrawn) top = std::max(top, value);
  }
  chart.y = {"radiance (linear)", 0, round_up(top), false};
  return chart;
}

void write_curves(Html& html, const ShownFarm& farm, const records::Profile& profile) {
  if (profile.curve.angle_degrees.empty() || profile.curve.radiance.empty())
    return write_absence(
        html, "The profile has no curve: no pixel of the picture lies in this highlight.");
  const Tag figure(html, "figure", {{"class", "chart-figure"}});
  html.raw(draw_chart(radiance_chart(farm, profile)));
  html.element("figcaption",
               "The highlight as a curve: mean radiance (of red, green and blue) of the pixels at "
               "each angle. Lines that lie on each other show through by their dashes.");
}

struct FigureColumn {
  const char* title;
  std::string (*text)(double);
};

template <int kDigits>
std::string with_digits(double value) {
  return number_text(value, kDigits);
}
std::string per_cent(double value) { return percent_text(value); }

// Peak and energy: five digits tell apart engines that agree to four. n: the digits of a float32 exponent.
constexpr FigureColumn kShapeColumns[] = {{"Peak", with_digits<5>},
                                          {"At angle", degrees_text},
                                          {"Half-width", degrees_text},
                                          {"Energy", with_digits<5>},
                                          {"n as a cosine lobe", with_digits<7>},
                                          {"± of n", with_digits<2>}};
constexpr FigureColumn kZoneColumns[] = {{"Pixels", count_text},
                                         {"Largest difference", with_digits<3>},
                                         {"Root mean square", with_digits<3>},
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

/// A missing value is a dash; a column without any value is left out.
void write_figures(Html& html, const std::string& caption, const std::vector<std::string>& head,
                   std::span<const FigureColumn> columns, const std::vector<FigureRow>& rows) {
  const auto is_there = [&](std::size_t column) {
    return std::ranges::any_of(rows,
                               [&](const FigureRow& row) { return bool(row.values[column]); });
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

std::vector<records::ShownZone> zones_of(const records::Profile& profile) {
  const auto& [epicentre, flank, blooming] = profile.zones;
  return {{"epicentre", epicentre[0], epicentre[1]},
          {"flank", flank[0], flank[1]},
          {"blooming zone", blooming[0], blooming[1]}};
}

void write_profile(Html& html, const SiteFrame& site, const ShownFarm& farm,
                   const CheckedCell& cell) {
  const Tag section(html, "section", {{"aria-labelledby", "profile"}});
  html.element("h2", {{"id", "profile"}}, "The highlight as a curve");
  if (cell.record.profile.empty()) return write_absence(html, "This cell has no profile.");
  if (!cell.profile) return write_absence(html, cell.profile_problem);
  const records::Profile& profile = *cell.profile;
  // A page that needs its script has the curves by it.
  const bool has_curves = !profile.curve.angle_degrees.empty() && !profile.curve.radiance.empty();
  if (!site.is_packed || !has_curves) write_curves(html, farm, profile);
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
