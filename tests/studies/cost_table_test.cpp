// Tables of cost: their fronts, on small ones that can be seen by eye, and how they are shown.
#include "studies/cost/table.hpp"

#include <pugixml.hpp>

#include "base/system/files.hpp"
#include "base/words/error_time_chart.hpp"
#include "tests/test.hpp"

namespace lobelia::cost {
namespace {

Variant variant(const char* name, double seconds, double error, double spread = 0) {
  Variant result{name, {{"lobe", name}}, {{"max", error}}, {}, {}, {}, {}, {}};
  result.seconds = records::MeasuredRounds{seconds, spread, seconds, seconds, 5};
  return result;
}

Table table(std::vector<Variant> variants) {
  Table result{"lobe-n64",          "lobe", "A lobe", "s", "evaluation", {{"max", "largest error"}},
               std::move(variants), {},     {}};
  add_fronts(result);
  return result;
}

/// The same, counted and not timed.
Table counted_table(std::vector<Variant> variants) {
  Table result = table(std::move(variants));
  result.unit = "bit operations";
  for (Variant& variant : result.variants) {
    variant.count = variant.seconds->median;
    variant.seconds.reset();
  }
  result.fronts.clear();
  add_fronts(result);
  return result;
}

TEST(ParetoFront, OmitsVariantsWithoutAnError) {
  const records::CostFront front =
      pareto_front(table({variant("a", 1, std::nan("")), variant("b", 2, 1)}), 0);
  EXPECT_THAT(front.variants, ElementsAre("b"));
  EXPECT_THAT(front.dominated_by, IsEmpty());
  EXPECT_THAT(pareto_front(table({}), 0).variants, IsEmpty());
}

TEST(ParetoFront, MatchesItsDefinitionForAnyVariants) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> small(1, 12);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Variant> variants;
    for (int i = 0; i < 15; ++i)
      variants.push_back(variant(("w" + std::to_string(i)).c_str(), small(random), small(random)));
    const Table t = table(variants);
    const records::CostFront front = pareto_front(t, 0);
    const auto dominates = [&](std::size_t i, std::size_t j) {
      const double ti = cost_of(variants[i]).median, tj = cost_of(variants[j]).median;
      const double ei = variants[i].errors[0].second, ej = variants[j].errors[0].second;
      return ti <= tj && ei <= ej && (ti < tj || ei < ej || i < j);
    };
    for (std::size_t j = 0; j < variants.size(); ++j) {
      bool dominated = false;
      for (std::size_t i = 0; i < variants.size(); ++i) dominated |= i != j && dominates(i, j);
      const std::string* by = records::find(front.dominated_by, variants[j].name);
      EXPECT_EQ(by != nullptr, dominated) << j;
      if (by) {
        const auto better = std::ranges::find(variants, *by, &Variant::name);
        ASSERT_NE(better, variants.end());
        EXPECT_TRUE(dominates(std::size_t(better - variants.begin()), j));
      }
    }
    EXPECT_EQ(front.variants.size() + front.dominated_by.size(), variants.size());
    EXPECT_TRUE(std::ranges::is_sorted(front.variants, {}, [&](const std::string& name) {
      return cost_of(*std::ranges::find(variants, name, &Variant::name)).median;
    }));
  }
}

TEST(FrontSentences, StateTheCostOfMoreAccuracy) {
  const auto in_words = [](std::vector<Variant> variants) {
    return pareto_front(table(std::move(variants)), 0).in_words;
  };
  EXPECT_THAT(in_words({variant("cs16", 1, 0.017), variant("cosine", 1.8, 0.0001),
                        variant("gauss", 2.7, 0.0002)}),
              ElementsAre("from cs16 to cosine: 1.8 times the time, 170 times less error",
                          "gauss takes 1.5 times the time of cosine and has 2.0 times its error"));
  EXPECT_THAT(in_words({variant("float32", 1, 2e-6), variant("float64", 2, 3.1e-15)}),
              ElementsAre("from float32 to float64: 2.0 times the time, 6.5e+08 times less error"));
  EXPECT_THAT(
      in_words({variant("cs16", 1, 0.017), variant("exact", 2, 0), variant("other", 4, 0)}),
      ElementsAre("from cs16 to exact: 2.0 times the time, infinitely many times less error",
                  "other takes 2.0 times the time of exact and has its error"));
}

TEST(ClearlySlower, IsBeyondTheSpreadOfBoth) {
  EXPECT_EQ(clearly_slower(variant("a", 10, 1, 0.05), variant("b", 11.5, 1, 0.05)), 1);
  EXPECT_EQ(clearly_slower(variant("a", 10, 1, 0.05), variant("b", 10.9, 1, 0.05)), 0);
  EXPECT_EQ(clearly_slower(variant("b", 11.5, 1, 0.05), variant("a", 10, 1, 0.05)), -1);
}

records::Cost report() {
  return {{"lobelia", "cost"},
          {"any", 0, "", ""},
          "AVX2",
          {table({variant("cs16", 1e-9, 0.017), variant("cosine", 2e-9, 1e-7),
                  variant("slow, \"but\"", 9e-9, 0.5), variant("exact", 5e-9, 0)})}};
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

TEST(CountedTables, NameTheirCountsInEveryForm) {
  records::Cost counted = report();
  counted.tables = {counted_table({variant("8 bits", 64, 0.1), variant("16 bits", 256, 0.001)})};
  const Table& table = counted.tables[0];
  EXPECT_THAT(cost_csv(counted), HasSubstr(",evaluation,bit operations,256,"));
  EXPECT_THAT(cost_text(counted, true), HasSubstr("4.0 times the bit operations, 100 times less"));
  EXPECT_THAT(cost_text(counted, true), AllOf(Not(HasSubstr("%")), Not(HasSubstr("256 s"))));
  EXPECT_THAT(cost_chart(table, 0), HasSubstr(">bit operations per evaluation<"));
  EXPECT_THAT(cost_chart(table, 0), HasSubstr("16 bits: 256 bit operations, max 0.001"));
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
