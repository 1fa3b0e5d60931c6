#include "core/chart_record.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace lobelia {
namespace {

/// More digits than a drawing shows would only make the record long.
Json rounded(double value) {
  if (!std::isfinite(value)) return number_or_name(value);
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr);
}

Json rounded(const std::vector<double>& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(rounded(value));
  return array;
}

Json axis_record(const ChartAxis& axis) {
  Json json{{"label", axis.label}, {"from", axis.from}, {"to", axis.to}};
  if (axis.logarithmic) json["logarithmic"] = true;
  if (!axis.ticks.empty()) json["ticks"] = axis.ticks;
  return json;
}

}  // namespace

Json chart_record(const Chart& chart) {
  Json json{{"id", chart.id},
            {"title", chart.title},
            {"description", chart.description},
            {"x", axis_record(chart.x)},
            {"y", axis_record(chart.y)},
            {"bands", Json::array()},
            {"series", Json::array()}};
  for (const ChartBand& band : chart.bands)
    json["bands"].push_back({{"title", band.label}, {"from", band.from}, {"to", band.to}});
  for (const ChartSeries& series : chart.series)
    json["series"].push_back({{"name", series.label},
                              {"style", series.style},
                              {"x", rounded(series.x)},
                              {"y", rounded(series.y)}});
  return json;
}

}  // namespace lobelia
