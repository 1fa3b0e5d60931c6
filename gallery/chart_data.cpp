#include "gallery/chart_data.hpp"

#include <algorithm>
#include <cmath>

namespace lobelia::gallery {
namespace {

// What records say may be anything that a double can hold; axes stay away from its ends.
constexpr double kLargest = 1e250, kSmallest = 1e-250;
constexpr int kLastStyle = 5;

ChartAxis read_axis(const Fields& fields) {
  ChartAxis axis{fields.text("label"), fields.number("from").value_or(0),
                 fields.number("to").value_or(1), fields.flag("logarithmic"),
                 fields.numbers("ticks")};
  const bool drawable = std::abs(axis.from) <= kLargest && std::abs(axis.to) <= kLargest &&
                        axis.from < axis.to && (!axis.logarithmic || axis.from >= kSmallest);
  if (!drawable) fields.fail("to", "must be above 'from', and both finite");
  std::erase_if(axis.ticks, [&](double tick) { return !(tick >= axis.from && tick <= axis.to); });
  return axis;
}

ChartAxis axis_of(const Fields& fields, const char* key) {
  const auto axis = fields.object(key);
  if (!axis) fields.fail(key, "is missing");
  return read_axis(*axis);
}

}  // namespace

Chart read_chart(const Fields& fields, const std::string& id) {
  Chart chart;
  chart.id = id;
  chart.title = fields.text("title");
  chart.description = fields.text("description");
  chart.width = 760;
  chart.height = 400;
  chart.x = axis_of(fields, "x");
  chart.y = axis_of(fields, "y");
  for (const Fields& band : fields.objects("bands"))
    chart.bands.push_back({std::max(chart.x.from, band.number("from").value_or(chart.x.from)),
                           std::min(chart.x.to, band.number("to").value_or(chart.x.to)),
                           band.text("title")});
  std::erase_if(chart.bands, [](const ChartBand& band) { return !(band.from < band.to); });
  for (const Fields& one : fields.objects("series")) {
    ChartSeries series{one.text("name"), one.numbers("x"), one.numbers("y"),
                       int(std::clamp(one.number("style").value_or(1), 0.0, double(kLastStyle)))};
    if (series.x.size() != series.y.size()) one.fail("y", "must be as long as 'x'");
    chart.series.push_back(std::move(series));
  }
  return chart;
}

}  // namespace lobelia::gallery
