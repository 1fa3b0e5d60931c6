#include "records/chart.hpp"

namespace lobelia::records {
namespace {

std::string series_contradiction(const ChartSeries& series) {
  return series.x.size() == series.y.size() ? "" : "x and y are not equally long";
}

}  // namespace

const Struct& ChartAxis::type() {
  return define<ChartAxis>("ChartAxis", "An axis of a chart.", [](Struct& t) {
    t.key<&ChartAxis::label>("label", "with its unit");
    t.key<&ChartAxis::from>("from");
    t.key<&ChartAxis::to>("to");
    t.key<&ChartAxis::logarithmic>("logarithmic");
    t.key<&ChartAxis::ticks>("ticks", "labelled values").if_any();
  });
}

const Struct& ChartBand::type() {
  return define<ChartBand>("ChartBand", "A marked range of the x axis.", [](Struct& t) {
    t.key<&ChartBand::title>("title");
    t.key<&ChartBand::from>("from");
    t.key<&ChartBand::to>("to");
  });
}

const Struct& ChartSeries::type() {
  return define<ChartSeries>(
      "ChartSeries", "A line. A value that is not finite is a gap.", [](Struct& t) {
        t.key<&ChartSeries::name>("name");
        t.key<&ChartSeries::style>("style", "0 is a broad pale line, 1 to 5 are dash patterns");
        t.key<&ChartSeries::x>("x").may_be_nonfinite();
        t.key<&ChartSeries::y>("y").may_be_nonfinite();
        t.check<series_contradiction>();
      });
}

}  // namespace lobelia::records
