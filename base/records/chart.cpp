#include "base/records/chart.hpp"

namespace lobelia::records {
namespace {

std::string series_contradiction(const ChartSeries& series) {
  return series.x.size() == series.y.size() ? "" : "x and y are not equally long";
}

}  // namespace

void define_chart_tables(Tables& tables) {
  tables.define<ChartAxis>("An axis of a chart.", [](auto& t) {
    t.key("label", "with its unit");
    t.key("ticks", "labelled values").if_any();
  });
  tables.define<ChartBand>("A marked range of the x axis.");
  tables.define<ChartSeries>("A line. A value that is not finite is a gap.", [](auto& t) {
    t.key("style", "0 is a broad pale line, 1 to 5 are dash patterns");
    t.keys({"x", "y"}).may_be_nonfinite();
    t.check(series_contradiction);
  });
}

}  // namespace lobelia::records
