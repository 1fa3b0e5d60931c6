#include <algorithm>

#include "base/words/numbers.hpp"
#include "base/words/svg_chart.hpp"
#include "gallery/cells/cell_page.hpp"

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
              .bands = zone_bands(profile)};
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

/// The texts of a row of figures below their titles; an empty one is a dash. A column without any text is left out.
struct Figures {
  std::vector<std::string> heads, titles;
  std::vector<std::vector<std::string>> rows;  ///< heads, then figures
};

std::string figure(const std::optional<double>& value, int digits) {
  return value ? number_text(*value, digits) : "";
}

void write_figures(Html& html, const std::string& caption, const Figures& figures) {
  const std::size_t heads = figures.heads.size();
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < figures.titles.size(); ++i)
    if (std::ranges::any_of(figures.rows, [&](const auto& row) { return !row[heads + i].empty(); }))
      shown.push_back(i);
  const Tag wrap(html, "div", {{"class", "table-wrap"}, {"tabindex", "0"}});
  const Tag table(html, "table", {{"class", "figures"}});
  html.element("caption", caption);
  {
    const Tag thead(html, "thead");
    const Tag line(html, "tr");
    for (const std::string& title : figures.heads) html.element("th", {{"scope", "col"}}, title);
    for (const std::size_t i : shown)
      html.element("th", {{"scope", "col"}, {"class", "number"}}, figures.titles[i]);
  }
  const Tag tbody(html, "tbody");
  for (const auto& row : figures.rows) {
    const Tag line(html, "tr");
    for (std::size_t i = 0; i < heads; ++i) html.element("th", {{"scope", "row"}}, row[i]);
    for (const std::size_t i : shown)
      html.element("td", {{"class", "number"}}, row[heads + i].empty() ? "–" : row[heads + i]);
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
    Figures figures{{"Picture"},
                    {"Peak", "At angle", "Half-width", "Energy", "n as a cosine lobe", "± of n"},
                    {}};
    // Peak and energy: five digits tell apart engines that agree to four. n: the digits of a float32 exponent.
    for (const auto& [name, shape] : profile.images) {
      const auto lobe = shape.highlight ? shape.highlight->cosine_lobe : records::CosineLobe();
      figures.rows.push_back({curve_title(farm, name), figure(shape.peak, 5),
                              degrees_text(shape.peak_angle_degrees),
                              degrees_text(shape.half_width_degrees), figure(shape.energy, 5),
                              figure(lobe.exponent, 7), figure(lobe.standard_error, 2)});
    }
    write_figures(html, "Each highlight in figures", figures);
  }
  if (!profile.differences.empty()) {
    Figures figures{{"Pictures", "Zone"},
                    {"Pixels", "Largest difference", "Root mean square", "Largest, of the peak"},
                    {}};
    const std::vector<records::ShownZone> titles = zones_of(profile);
    for (const auto& [pair, zones] : profile.differences) {
      const records::ZoneError errors[] = {zones.epicentre, zones.flank, zones.blooming};
      for (std::size_t i = 0; i < titles.size(); ++i)
        figures.rows.push_back({pair_title(farm, pair), titles[i].title,
                                count_text(double(errors[i].pixels)), figure(errors[i].max_abs, 3),
                                figure(errors[i].rms, 3), percent_text(errors[i].max_rel_peak)});
    }
    std::string caption = "Differences by zone";
    for (const records::ShownZone& zone : titles)
      caption += "; " + zone.title + " " + degrees_text(zone.from) + " to " + degrees_text(zone.to);
    write_figures(html, caption, figures);
  }
}

}  // namespace lobelia::gallery
