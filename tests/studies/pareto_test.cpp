#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/studies/tables.hpp"

namespace lobelia::cost {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;

TEST(ParetoFront, GoesFromTheFastestToTheMostAccurate) {
  const Table t = table({variant("exact", 9, 0), variant("cheap", 1, 0.5), variant("bad", 4, 0.6),
                         variant("middle", 3, 0.1), variant("worse", 10, 0.1)});
  const records::CostFront front = pareto_front(t, 0);
  EXPECT_THAT(front.variants, ElementsAre("cheap", "middle", "exact"));
  EXPECT_THAT(front.dominated_by, ElementsAre(Pair("bad", "cheap"), Pair("worse", "middle")));
}

TEST(ParetoFront, HasTheFirstOfVariantsThatAreEqual) {
  EXPECT_THAT(pareto_front(table({variant("a", 1, 1), variant("b", 1, 1)}), 0).variants,
              ElementsAre("a"));
}

TEST(ParetoFront, LeavesOutWhatHasNoError) {
  const records::CostFront front =
      pareto_front(table({variant("a", 1, std::nan("")), variant("b", 2, 1)}), 0);
  EXPECT_THAT(front.variants, ElementsAre("b"));
  EXPECT_THAT(front.dominated_by, IsEmpty());
  EXPECT_THAT(pareto_front(table({}), 0).variants, IsEmpty());
}

TEST(ParetoFront, IsThatOfTheDefinitionForAnyVariants) {
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
  }
}

TEST(FrontSentences, SayWhatMoreAccuracyCosts) {
  const Table t = table(
      {variant("cs16", 1, 0.017), variant("cosine", 1.8, 0.0001), variant("gauss", 2.7, 0.0002)});
  EXPECT_THAT(pareto_front(t, 0).in_words,
              ElementsAre("from cs16 to cosine: 1.8 times the time, 170 times less error",
                          "gauss takes 1.5 times the time of cosine and has 2.0 times its error"));
}

TEST(FrontSentences, SayLargeRatiosInTwoDigits) {
  const Table t = table({variant("float32", 1, 2e-6), variant("float64", 2, 3.1e-15)});
  EXPECT_THAT(pareto_front(t, 0).in_words,
              ElementsAre("from float32 to float64: 2.0 times the time, 6.5e+08 times less error"));
}

TEST(FrontSentences, AreNotUpsetByVariantsWithoutAnyError) {
  const Table t =
      table({variant("cs16", 1, 0.017), variant("exact", 2, 0), variant("other", 4, 0)});
  EXPECT_THAT(
      pareto_front(t, 0).in_words,
      ElementsAre("from cs16 to exact: 2.0 times the time, infinitely many times less error",
                  "other takes 2.0 times the time of exact and has its error"));
}

TEST(ClearlySlower, IsBeyondTheSpreadOfBoth) {
  EXPECT_EQ(clearly_slower(variant("a", 10, 1, 0.05), variant("b", 11.5, 1, 0.05)), 1);
  EXPECT_EQ(clearly_slower(variant("a", 10, 1, 0.05), variant("b", 10.9, 1, 0.05)), 0);
  EXPECT_EQ(clearly_slower(variant("b", 11.5, 1, 0.05), variant("a", 10, 1, 0.05)), -1);
}

}  // namespace
}  // namespace lobelia::cost
