// A chart as numbers.
#pragma once

#include "base/records/struct_type.hpp"

namespace lobelia::records {

struct ChartAxis {
  std::string label;
  double from = 0, to = 0;
  std::optional<bool> logarithmic;
  std::vector<double> ticks;
};

struct ChartBand {
  std::string title;
  double from = 0, to = 0;
};

struct ChartSeries {
  std::string name;
  int style = 0;
  std::vector<double> x, y;
};

void define_chart_tables(Tables& tables);

}  // namespace lobelia::records
