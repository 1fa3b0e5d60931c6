#include "core/svg_chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <pugixml.hpp>
#include <set>

namespace lobelia {
namespace {

Chart chart_of(const std::vector<double>& y) {
  Chart chart;
  chart.id = "c";
  chart.title = "Title <&>";
  chart.x = {"angle (degrees)", 0, 10, false};
  chart.y = {"radiance", 0, 3, false};
  ChartSeries series{"one", {}, y, 1};
  for (std::size_t i = 0; i < y.size(); ++i) series.x.push_back(static_cast<double>(i));
  chart.series.push_back(series);
  return chart;
}

std::string path_of(const Chart& chart) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(draw_chart(chart).c_str()));
  return document.select_node("//path").node().attribute("d").value();
}

TEST(SvgChart, is_well_formed_and_says_what_it_shows) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(draw_chart(chart_of({1, 2, 3})).c_str()));
  EXPECT_STREQ(document.select_node("/svg/title").node().text().get(), "Title <&>");
  EXPECT_TRUE(document.select_node("//text[.='angle (degrees)']"));
  EXPECT_TRUE(document.select_node("//text[.='radiance']"));
}

TEST(SvgChart, values_that_cannot_be_drawn_are_gaps) {
  const std::string path = path_of(chart_of({1, 2, NAN, 2, INFINITY, 3}));
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 3);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'L'), 1);
  Chart logarithmic = chart_of({1, 0, -1, 2});
  logarithmic.y = {"log", 0.1, 10, true};
  const std::string log_path = path_of(logarithmic);
  EXPECT_EQ(std::count(log_path.begin(), log_path.end(), 'M'), 2);
}

TEST(SvgChart, a_higher_value_is_drawn_higher_and_a_decade_is_a_fixed_step) {
  Chart chart = chart_of({0.1, 1, 10});
  chart.y = {"log", 0.1, 10, true};
  double x[3], y[3];
  ASSERT_EQ(std::sscanf(path_of(chart).c_str(), "M%lf %lfL%lf %lfL%lf %lf", &x[0], &y[0], &x[1],
                        &y[1], &x[2], &y[2]),
            6);
  EXPECT_GT(y[0], y[1]);
  EXPECT_NEAR(y[0] - y[1], y[1] - y[2], 0.02);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.02);
}

TEST(SvgChart, lines_can_be_told_apart_without_colour) {
  Chart chart = chart_of({1, 2});
  for (int style = 2; style <= 5; ++style) {
    chart.series.push_back(chart.series.front());
    chart.series.back().style = style;
  }
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(draw_chart(chart).c_str()));
  std::set<std::string> dashes;
  for (const auto& path : document.select_nodes("//path")) {
    dashes.insert(path.node().attribute("stroke-dasharray").value());
  }
  EXPECT_EQ(dashes.size(), 5u);
}

}  // namespace
}  // namespace lobelia
