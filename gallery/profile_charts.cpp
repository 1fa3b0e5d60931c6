#include "gallery/profile_charts.hpp"

#include <algorithm>
#include <cmath>

#include "core/ticks.hpp"

namespace lobelia::gallery {
namespace {

constexpr double kBeyondZones = 1.25;  // how much of the dark around a highlight is drawn
constexpr double kMaxDecades = 10;     // of the logarithmic panel
// What records say may be anything that a double can hold; axes stay away from its ends.
constexpr double kLargest = 1e250, kSmallest = 1e-250;

/// The formula first, because it lies under the others; then the engines as farm.json has them.
std::vector<const NamedCurve*> in_order(const FarmData& farm, const ProfileData& profile) {
  std::vector<const NamedCurve*> result;
  if (const NamedCurve* curve = profile.find_curve(kAnalytic)) result.push_back(curve);
  for (const EngineEntry& engine : farm.engines) {
    if (engine.name == kAnalytic) continue;  // an engine too, and the formula already
    if (const NamedCurve* curve = profile.find_curve(engine.name)) result.push_back(curve);
  }
  return result;
}

int style_of(const FarmData& farm, const std::string& name) {
  if (name == kAnalytic) return 0;
  for (std::size_t i = 0; i < farm.engines.size(); ++i) {
    if (farm.engines[i].name == name) return static_cast<int>(i) + 1;
  }
  return 0;
}

ChartAxis angle_axis(const ProfileData& profile) {
  const bool half = profile.angle.find("half") != std::string::npos;
  ChartAxis axis{half ? "angle between normal and half vector (degrees)"
                      : "angle between light and mirror direction (degrees)",
                 0, 0, false};
  for (const double angle : profile.degrees) {
    if (angle <= 180) axis.to = std::max(axis.to, angle);
  }
  if (!profile.zones.empty() && profile.zones.back().to > 0) {
    axis.to = std::min(axis.to, kBeyondZones * profile.zones.back().to);
  }
  if (!(axis.to > 0)) axis.to = 90;
  return axis;
}

std::vector<ChartBand> zone_bands(const ProfileData& profile) {
  std::vector<ChartBand> bands;
  for (const ProfileZone& zone : profile.zones) bands.push_back({zone.from, zone.to, zone.title});
  return bands;
}

}  // namespace

std::string curve_title(const FarmData& farm, const std::string& name) {
  return name == kAnalytic ? "formula" : farm.engine_title(name);
}

Chart radiance_chart(const FarmData& farm, const ProfileData& profile) {
  Chart chart;
  chart.id = "radiance";
  chart.title = "Radiance over angle";
  chart.description = "The highlight as each engine drew it, over the formula.";
  chart.x = angle_axis(profile);
  chart.bands = zone_bands(profile);
  double top = 0;
  for (const NamedCurve* curve : in_order(farm, profile)) {
    chart.series.push_back({curve_title(farm, curve->name), profile.degrees, curve->values,
                            style_of(farm, curve->name)});
    for (const double value : curve->values) {
      if (value <= kLargest) top = std::max(top, value);
    }
  }
  chart.y = {"radiance (linear)", 0, round_up(top), false};
  return chart;
}

Chart difference_chart(const FarmData& farm, const ProfileData& profile,
                       const NamedCurve& analytic) {
  Chart chart;
  chart.id = "difference";
  chart.title = "Difference from the formula over angle";
  chart.description = "Absolute difference of each engine's curve from the formula, logarithmic.";
  chart.height = 320;
  chart.x = angle_axis(profile);
  chart.bands = zone_bands(profile);
  double low = INFINITY, high = 0;
  for (const NamedCurve* curve : in_order(farm, profile)) {
    if (curve->name == kAnalytic) continue;
    ChartSeries series{curve_title(farm, curve->name) + " − formula",
                       profile.degrees,
                       {},
                       style_of(farm, curve->name)};
    bool any = false;
    for (std::size_t i = 0; i < curve->values.size(); ++i) {
      const double difference = std::abs(curve->values[i] - analytic.values[i]);
      series.y.push_back(difference);
      const bool drawn = difference >= kSmallest && difference <= kLargest;
      if (!drawn || profile.degrees[i] > chart.x.to) continue;
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
