#include "base/words/svg_chart.hpp"

#include <cstdio>
#include <pugixml.hpp>
#include <regex>

#include "base/system/files.hpp"
#include "lobelia_paths.hpp"
#include "tests/test.hpp"

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

TEST(SvgChart, LeavesGapsForValuesThatCannotBeDrawn) {
  const std::string path = path_of(chart_of({1, 2, NAN, 2, INFINITY, 3}));
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 3);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'L'), 1);
  Chart logarithmic = chart_of({1, 0, -1, 2});
  logarithmic.y = {"log", 0.1, 10, true};
  const std::string log_path = path_of(logarithmic);
  EXPECT_EQ(std::count(log_path.begin(), log_path.end(), 'M'), 2);
}

TEST(SvgChart, DrawsHigherValuesHigherAndDecadesAsEqualSteps) {
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

TEST(SvgChart, TellsLinesApartWithoutColour) {
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

TEST(SvgChart, MarksItsAxesWhereTheyAreLabelled) {
  Chart chart = chart_of({1, 2, 3});
  chart.x = {"n", 16, 1024, true, {16, 128, 1024}};
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(draw_chart(chart).c_str()));
  EXPECT_EQ(document.select_nodes("//line[@class='tick']").size(), 3u);
  const auto at = [&](const char* label) {
    return document.select_node((std::string("//text[.='") + label + "']").c_str())
        .node()
        .attribute("x")
        .as_double();
  };
  EXPECT_NEAR(at("128") - at("16"), at("1024") - at("128"), 0.02) << "logarithmic";
}

TEST(SvgChart, NamesPointsWhereNoOtherNameIsInTheWay) {
  Chart chart = chart_of({});
  ChartSeries& points = chart.series[0];
  points.markers = true;
  chart.x = {"n", 0, 1000};
  for (int i = 0; i < 9; ++i) {
    points.x.push_back(500);
    points.y.push_back(1);
    points.point_names.push_back("name " + std::to_string(i));
  }
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(draw_chart(chart).c_str()));
  std::set<std::pair<double, double>> places;
  for (const auto& name : document.select_nodes("//text[@class='point-name']"))
    places.emplace(name.node().attribute("x").as_double(), name.node().attribute("y").as_double());
  EXPECT_EQ(places.size(), document.select_nodes("//text[@class='point-name']").size());
  EXPECT_EQ(places.size(), 9u) << "each has a place";
  EXPECT_GE(document.select_nodes("//line[@class='leader']").size(), 3u)
      << "and those far off a line";
  EXPECT_EQ(document.select_nodes("//circle[contains(@class, 'ring')]").size(), 8u)
      << "points that lie on another are told apart";
}

TEST(SvgChart, WritesLongLabelsInLinesAnd0As0) {
  Chart chart = chart_of({1, 2, 3});
  chart.width = 300;
  chart.y = {
      "a label that is much longer than the axis beside which it is written, and no words of it are lost",
      1e-6, 1, true};
  chart.y.starts_at_zero = true;
  chart.series.push_back({"another series with a long name", {}, {}, 2});
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(draw_chart(chart).c_str()));
  EXPECT_GE(document.select_nodes("//text[@class='axis-label']").size(), 3u);
  EXPECT_TRUE(document.select_node("//text[@class='tick-label'][.='0']"));
  EXPECT_FALSE(document.select_node("//text[@class='tick-label'][.='10⁻⁶']"));
  std::set<double> lines;
  for (const auto& entry : document.select_nodes("//text[@class='legend']"))
    lines.insert(entry.node().attribute("y").as_double());
  EXPECT_EQ(lines.size(), 2u);
}

TEST(SvgChart, HasANamespaceATitleAGroundAndASizeAlone) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(draw_chart_file(chart_of({1, 2, 3})).c_str()));
  const pugi::xml_node svg = document.child("svg");
  EXPECT_STREQ(svg.attribute("xmlns").value(), "http://www.w3.org/2000/svg");
  EXPECT_GT(svg.attribute("width").as_double(), 100);
  EXPECT_TRUE(document.select_node("/svg/rect[@class='ground']"));
  EXPECT_STREQ(svg.child("title").text().get(), "Title <&>");
  for (const char* text : {"Title <&>", "angle (degrees)", "radiance"})
    EXPECT_TRUE(document.select_node((std::string("//text[.='") + text + "']").c_str())) << text;
  const std::string style = svg.child("style").text().get();
  EXPECT_NE(style.find("prefers-color-scheme: dark"), std::string::npos);
  EXPECT_EQ(style.find("var("), std::string::npos) << "image viewers do not know variables";
}

/// The colours that a style sheet gives to the lines 1 to 5.
std::set<std::string> series_colours(const std::string& css) {
  static const std::regex pattern("series-[1-5](?: \\{ stroke)?: (#[0-9a-f]{6})");
  std::set<std::string> colours;
  for (std::sregex_iterator it(css.begin(), css.end(), pattern), end; it != end; ++it)
    colours.insert((*it)[1]);
  return colours;
}

TEST(SvgChart, HasTheSameColoursAloneAndInTheGallery) {
  const auto alone =
      series_colours(read_file(LOBELIA_SOURCE_DIR "/base/words/svg_chart.css", 1 << 20));
  EXPECT_EQ(alone.size(), 10u) << "five in the light, five in the dark";
  EXPECT_EQ(alone, series_colours(
                       read_file(LOBELIA_SOURCE_DIR "/gallery/web/src/style/base.css", 1 << 20)));
}

}  // namespace
}  // namespace lobelia
