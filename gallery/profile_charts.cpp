#include "gallery/profile_charts.hpp"

#include <algorithm>
#include <cmath>

#include "core/svg_chart.hpp"

namespace lobelia::gallery {
namespace {

constexpr double kBeyondZones = 1.25;  // how much of the dark around a highlight is drawn
constexpr double kMaxDecades = 10;     // of the logarithmic panel

struct Curve {
  std::string name;
  const std::vector<double>& values;
};

/// The formula first, because it lies under the others; then the engines as farm.json has them.
std::vector<Curve> in_order(const ShownFarm& farm, const records::Profile& profile) {
  std::vector<Curve> result;
  const auto add = [&](const std::string& name) {
    if (const auto* values = records::find(profile.curve.radiance, name))
      result.push_back({name, *values});
  };
  add(kAnalytic);
  for (const records::FarmEngine& engine : farm.record.engines)
    if (engine.name != kAnalytic) add(engine.name);  // an engine too, and the formula already
  return result;
}

int style_of(const ShownFarm& farm, const std::string& name) {
  if (name == kAnalytic) return 0;
  for (std::size_t i = 0; i < farm.record.engines.size(); ++i) {
    if (farm.record.engines[i].name == name) return static_cast<int>(i) + 1;
  }
  return 0;
}

ChartAxis angle_axis(const records::Profile& profile) {
  const bool half = profile.angle.find("half") != std::string::npos;
  ChartAxis axis{half ? "angle between normal and half vector (degrees)"
                      : "angle between light and mirror direction (degrees)",
                 0, 0, false};
  for (const double angle : profile.curve.angle_degrees) {
    if (angle <= 180) axis.to = std::max(axis.to, angle);
  }
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

}  // namespace

std::vector<records::ShownZone> zones_of(const records::Profile& profile) {
  const auto& [epicentre, flank, blooming] = profile.zones;
  return {{"epicentre", epicentre[0], epicentre[1]},
          {"flank", flank[0], flank[1]},
          {"blooming zone", blooming[0], blooming[1]}};
}

std::string curve_title(const ShownFarm& farm, const std::string& name) {
  return name == kAnalytic ? "formula" : farm.engine_title(name);
}

Chart radiance_chart(const ShownFarm& farm, const records::Profile& profile) {
  Chart chart;
  chart.id = "radiance";
  chart.title = "Radiance over angle";
  chart.description = "The highlight as each engine drew it, over the formula.";
  chart.x = angle_axis(profile);
  chart.bands = zone_bands(profile);
  double top = 0;
  for (const auto& [name, values] : in_order(farm, profile)) {
    chart.series.push_back(
        {curve_title(farm, name), profile.curve.angle_degrees, values, style_of(farm, name)});
    for (const double value : values) {
      if (value <= kLargestDrawn) top = std::max(top, value);
    }
  }
  chart.y = {"radiance (linear)", 0, round_up(top), false};
  return chart;
}

Chart difference_chart(const ShownFarm& farm, const records::Profile& profile,
                       const std::vector<double>& analytic) {
  Chart chart;
  chart.id = "difference";
  chart.title = "Difference from the formula over angle";
  chart.description = "Absolute difference of each engine's curve from the formula, logarithmic.";
  chart.height = 320;
  chart.x = angle_axis(profile);
  chart.bands = zone_bands(profile);
  double low = INFINITY, high = 0;
  for (const auto& [name, values] : in_order(farm, profile)) {
    if (name == kAnalytic) continue;
    ChartSeries series{curve_title(farm, name) + " − formula",
                       profile.curve.angle_degrees,
                       {},
                       style_of(farm, name)};
    bool any = false;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double difference = std::abs(values[i] - analytic[i]);
      series.y.push_back(difference);
      const bool drawn = difference >= kSmallestDrawn && difference <= kLargestDrawn;
      if (!drawn || profile.curve.angle_degrees[i] > chart.x.to) continue;
      low = std::min(low, difference);
      high = std::max(high, difference);
      any = true;
    }
    if (!any) series.label += " (none)";
    chart.series.push_back(std::move(series));
  }
  if (high == 0) {
    chart.series.clear();
    return chart;
  }
  const double to = std::pow(10, std::ceil(std::log10(high)));
  const double from = std::pow(10, std::floor(std::log10(low)));
  chart.y = {"|difference| (radiance, log)", std::max(from, to * std::pow(10, -kMaxDecades)), to,
             true};
  if (chart.y.from == chart.y.to) chart.y.from /= 10;
  return chart;
}

}  // namespace lobelia::gallery
