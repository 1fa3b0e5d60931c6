#include "studies/cost/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <pugixml.hpp>

#include "core/error_time_chart.hpp"
#include "core/files.hpp"
#include "tests/json.hpp"
#include "tests/studies/tables.hpp"

namespace lobelia::cost {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

records::Cost report() {
  return {{"lobelia", "cost"},
          {"any", 0, "", ""},
          "AVX2",
          {table({variant("cs16", 1e-9, 0.017), variant("cosine", 2e-9, 1e-7),
                  variant("slow, \"but\"", 9e-9, 0.5), variant("exact", 5e-9, 0)})}};
}

TEST(CostRecord, HoldsEveryVariantAndItsFronts) {
  const Json record = as_json(report());
  EXPECT_EQ(record["kind"], "cost");
  const Json& table = record["tables"][0];
  EXPECT_EQ(table["ways"].size(), 4u);
  EXPECT_EQ(table["ways"][0]["seconds"]["median"], 1e-9);
  EXPECT_EQ(table["ways"][0]["errors"]["max"], 0.017);
  EXPECT_EQ(table["fronts"]["max"]["ways"], Json::array({"cs16", "cosine", "exact"}));
  EXPECT_EQ(table["fronts"]["max"]["dominatedBy"]["slow, \"but\""], "cs16");
  EXPECT_THAT(table["fronts"]["max"]["inWords"][0].get<std::string>(),
              HasSubstr("from cs16 to cosine"));
}

TEST(CostCsv, HasALineForEachVariantAndError) {
  const std::string csv = cost_csv(report());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_THAT(csv, HasSubstr("\"slow, \"\"but\"\"\""));
  EXPECT_THAT(csv, HasSubstr(",max,0.5,,no"));
}

TEST(AnErrorThatIsTheLargestOfSome, IsPrintedWithItsBoundWhereTheDigitsDiffer) {
  records::Cost bracketed = report();
  std::vector<Variant>& variants = bracketed.tables[0].variants;
  variants[0].errors_at_most = {{"max", 0.0170001}};
  variants[1].errors_at_most = {{"max", 3e-7}};
  const std::string text = cost_text(bracketed, true);
  EXPECT_THAT(text, AllOf(HasSubstr(" 0.017  max"), HasSubstr(" 1e-07..3e-07  max")));
  const Json table = as_json(bracketed)["tables"][0];
  EXPECT_EQ(table["ways"][1]["errorsAtMost"]["max"], 3e-7);
  EXPECT_FALSE(table["ways"][2].contains("errorsAtMost"));
  EXPECT_FALSE(table["ways"][3].contains("errorsAtMost"));
  EXPECT_THAT(cost_csv(bracketed), HasSubstr(",max,1e-07,,yes,3e-07\r\n"));
}

TEST(CostText, ShowsTheFrontAndWithAllEverything) {
  EXPECT_THAT(cost_text(report(), false), Not(HasSubstr("slow")));
  EXPECT_THAT(cost_text(report(), true), HasSubstr("slow"));
  EXPECT_THAT(cost_text(report(), false), HasSubstr("from cs16 to cosine: 2.0 times the time"));
}

TEST(CostChart, IsXmlWithAPointForEachVariantEvenWhereItHasNoError) {
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(cost_chart(report().tables[0], 0).c_str()));
  auto points = document.select_nodes("//g[@class='point']");
  points.sort();
  EXPECT_EQ(points.size(), 4u);
  EXPECT_THAT(points[0].node().child("title").text().as_string(), HasSubstr("slow, \"but\""));
}

TEST(CountedTables, SayWhatTheyCountInEveryForm) {
  records::Cost counted = report();
  counted.tables = {counted_table({variant("8 bits", 64, 0.1), variant("16 bits", 256, 0.001)})};
  const Table& table = counted.tables[0];
  const Json record = as_json(counted);
  EXPECT_EQ(record["tables"][0]["unit"], "bit operations");
  EXPECT_EQ(record["tables"][0]["ways"][1]["count"], 256);
  EXPECT_FALSE(record["tables"][0]["ways"][1].contains("seconds"));
  EXPECT_THAT(cost_csv(counted), HasSubstr(",evaluation,bit operations,256,"));
  EXPECT_THAT(cost_text(counted, true), HasSubstr("4.0 times the bit operations, 100 times less"));
  EXPECT_THAT(cost_text(counted, true), AllOf(Not(HasSubstr("%")), Not(HasSubstr("256 s"))));
  EXPECT_THAT(cost_chart(table, 0), HasSubstr(">bit operations per evaluation<"));
  EXPECT_THAT(cost_chart(table, 0), HasSubstr("16 bits: 256 bit operations, max 0.001"));
}

TEST(CountedTables, SayHowFarADrawnErrorIsToBeTrusted) {
  records::Cost counted = report();
  counted.tables = {counted_table({variant("8 bits", 64, 0.1), variant("16 bits", 256, 0.001)})};
  counted.tables[0].variants[0].error_spreads = {{"max", 1e-5}};
  counted.tables[0].variants[1].error_spreads = {{"max", 0.002}};
  const std::string text = cost_text(counted, true);
  EXPECT_THAT(text, AllOf(HasSubstr(" 0.1  max"), HasSubstr(" 0.001+-0.002  max")));
}

TEST(TimedTables, SayThatTheyAreOfSeconds) {
  EXPECT_EQ(as_json(report())["tables"][0]["unit"], "s");
  EXPECT_THAT(cost_csv(report()), HasSubstr(",evaluation,s,1e-09,"));
  EXPECT_THAT(cost_chart(report().tables[0], 0), HasSubstr(">ns per evaluation<"));
}

TEST(CostChart, CanBeDrawnOfNothing) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(cost_chart(table({}), 0).c_str()));
  EXPECT_TRUE(document.load_string(cost_chart(table({variant("a", 1, std::nan(""))}), 0).c_str()));
}

TEST(WritingCosts, LeavesTheRecordTheTableAndAChartForEachError) {
  const TemporaryDirectory directory;
  write_cost(report(), directory.path() / "deep" / "cost");
  for (const char* file : {"cost.json", "cost.csv", "lobe-n64-max.svg"})
    EXPECT_TRUE(std::filesystem::exists(directory.path() / "deep" / "cost" / file)) << file;
}

TEST(SecondsText, HasThreeDigitsAndAUnit) {
  EXPECT_EQ(short_time_text(3.14159e-9), "3.14 ns");
  EXPECT_EQ(short_time_text(2.5e-5), "25.0 µs");
  EXPECT_EQ(short_time_text(0.3), "300 ms");
  EXPECT_EQ(short_time_text(1.5), "1.50 s");
}

}  // namespace
}  // namespace lobelia::cost
