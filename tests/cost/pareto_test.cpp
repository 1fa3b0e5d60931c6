#include "cost/pareto.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/cost/tables.hpp"

namespace lobelia::cost {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ParetoFront, GoesFromTheFastestToTheMostAccurate) {
  const Table t = table({way("exact", 9, 0), way("cheap", 1, 0.5), way("bad", 4, 0.6),
                         way("middle", 3, 0.1), way("worse", 10, 0.1)});
  const Front front = pareto_front(t, 0);
  EXPECT_THAT(front.ways, ElementsAre(1u, 3u, 0u));
  EXPECT_THAT(front.dominated_by, ElementsAre(kNone, kNone, 1u, kNone, 3u));
}

TEST(ParetoFront, HasTheFirstOfWaysThatAreEqual) {
  EXPECT_THAT(pareto_front(table({way("a", 1, 1), way("b", 1, 1)}), 0).ways, ElementsAre(0u));
}

TEST(ParetoFront, LeavesOutWhatHasNoError) {
  const Front front = pareto_front(table({way("a", 1, std::nan("")), way("b", 2, 1)}), 0);
  EXPECT_THAT(front.ways, ElementsAre(1u));
  EXPECT_EQ(front.dominated_by[0], kNone);
  EXPECT_THAT(pareto_front(table({}), 0).ways, IsEmpty());
}

TEST(ParetoFront, IsThatOfTheDefinitionForAnyWays) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> small(1, 12);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Way> ways;
    for (int i = 0; i < 15; ++i)
      ways.push_back(way(("w" + std::to_string(i)).c_str(), small(random), small(random)));
    const Table t = table(ways);
    const Front front = pareto_front(t, 0);
    const auto dominates = [&](std::size_t i, std::size_t j) {
      const double ti = ways[i].time.median, tj = ways[j].time.median;
      const double ei = ways[i].errors[0], ej = ways[j].errors[0];
      return ti <= tj && ei <= ej && (ti < tj || ei < ej || i < j);
    };
    for (std::size_t j = 0; j < ways.size(); ++j) {
      bool dominated = false;
      for (std::size_t i = 0; i < ways.size(); ++i) dominated |= i != j && dominates(i, j);
      EXPECT_EQ(front.dominated_by[j] != kNone, dominated) << j;
      if (dominated) {
        EXPECT_TRUE(dominates(front.dominated_by[j], j));
      }
    }
  }
}

TEST(FrontSentences, SayWhatMoreAccuracyCosts) {
  const Table t =
      table({way("cs16", 1, 0.017), way("cosine", 1.8, 0.0001), way("gauss", 2.7, 0.0002)});
  EXPECT_THAT(front_sentences(t, 0),
              ElementsAre("from cs16 to cosine: 1.8 times the time, 170 times less error",
                          "gauss takes 1.5 times the time of cosine and has 2.0 times its error"));
}

TEST(FrontSentences, SayLargeRatiosInTwoDigits) {
  const Table t = table({way("float32", 1, 2e-6), way("float64", 2, 3.1e-15)});
  EXPECT_THAT(front_sentences(t, 0),
              ElementsAre("from float32 to float64: 2.0 times the time, 6.5e+08 times less error"));
}

TEST(FrontSentences, AreNotUpsetByWaysWithoutAnyError) {
  const Table t = table({way("cs16", 1, 0.017), way("exact", 2, 0), way("other", 4, 0)});
  EXPECT_THAT(
      front_sentences(t, 0),
      ElementsAre("from cs16 to exact: 2.0 times the time, infinitely many times less error",
                  "other takes 2.0 times the time of exact and has its error"));
}

TEST(ClearlySlower, IsBeyondTheSpreadOfBoth) {
  EXPECT_EQ(clearly_slower(way("a", 10, 1, 0.05), way("b", 11.5, 1, 0.05)), 1);
  EXPECT_EQ(clearly_slower(way("a", 10, 1, 0.05), way("b", 10.9, 1, 0.05)), 0);
  EXPECT_EQ(clearly_slower(way("b", 11.5, 1, 0.05), way("a", 10, 1, 0.05)), -1);
}

}  // namespace
}  // namespace lobelia::cost
