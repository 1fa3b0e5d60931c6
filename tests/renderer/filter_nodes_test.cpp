#include "renderer/filter_nodes.hpp"
#include "tests/test.hpp"

namespace lobelia {
namespace {

double mean_by_nodes(Filter filter, double (*value)(double x, double y)) {
  double sum = 0;
  for (const FilterNode& node : filter_nodes(filter)) sum += node.weight * value(node.x, node.y);
  return sum;
}

/// By the midpoints of many small squares.
double mean_by_sums(Filter filter, double (*value)(double x, double y)) {
  constexpr int kSteps = 400;
  double sum = 0, weights = 0;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const double x = 2 * (i + 0.5) / kSteps - 1, y = 2 * (j + 0.5) / kSteps - 1;
      const double weight = filter_value(filter, x) * filter_value(filter, y);
      sum += weight * value(filter.radius * x, filter.radius * y);
      weights += weight;
    }
  return sum / weights;
}

TEST(FilterNodes, GiveTheMeanOfAHighlightWithEveryFilter) {
  ASSERT_GE(filter_names().size(), 5u);
  for (const std::string_view name : filter_names()) {
    const Filter filter = find_filter(name).value();
    // The flank of a highlight of a half-width of 2.4 pixels, and a polynomial of degree 4.
    const auto flank = [](double x, double y) {
      return std::exp(-((x - 1.3) * (x - 1.3) + (y + 0.7) * (y + 0.7)) / 8);
    };
    const auto polynomial = [](double x, double y) {
      return 1 + x - 2 * y + x * y + 3 * x * x - y * y * y * y + x * x * y * y;
    };
    EXPECT_NEAR(mean_by_nodes(filter, flank), mean_by_sums(filter, flank), 2e-5) << name;
    EXPECT_NEAR(mean_by_nodes(filter, polynomial), mean_by_sums(filter, polynomial), 2e-5) << name;
  }
}

TEST(FilterNodes, AreFewAndSumToOneForEveryFilter) {
  for (const std::string_view name : filter_names())
    for (const double radius : {0.1, 0.5, 2.0, 16.0}) {
      Filter filter = find_filter(name).value();
      filter.radius = radius;
      double sum = 0;
      for (const FilterNode& node : filter_nodes(filter)) {
        sum += node.weight;
        EXPECT_LE(std::max(std::abs(node.x), std::abs(node.y)), radius) << name;
      }
      EXPECT_NEAR(sum, 1, 1e-12) << name;
      EXPECT_LE(filter_nodes(filter).size(), 16u) << name;
    }
}

}  // namespace
}  // namespace lobelia
